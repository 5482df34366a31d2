// SPDX-License-Identifier: BSD-3-Clause
import { BufferAttribute, BufferGeometry, Color, DoubleSide, Mesh, ShaderMaterial, ShapeUtils, Vector2 } from "three";
import type { MapObject } from "../api/types";

const vertex = `varying vec2 at_m; void main() { at_m = position.xy; gl_Position = projectionMatrix * viewMatrix * vec4(position, 1.0); }`;
const fragment = /* glsl */ `
  uniform vec3 dark;
  uniform vec3 stripe;
  varying vec2 at_m;
  void main() {
    float along = (at_m.x + at_m.y) * 4.0;
    float width = clamp(fwidth(along), 0.001, 1.0);
    float line = smoothstep(0.16 + width, 0.16, abs(fract(along) - 0.5)) * (1.0 - smoothstep(0.4, 1.0, width));
    gl_FragColor = vec4(mix(dark, stripe, line), 1.0);
    #include <colorspace_fragment>
  }`;

/** Where nobody has seen a floor: dark and hatched below the map, so that it never looks like one. */
export class UnseenGround {
  readonly mesh = new Mesh(
    new BufferGeometry(),
    new ShaderMaterial({
      uniforms: { dark: { value: new Color() }, stripe: { value: new Color() } },
      vertexShader: vertex,
      fragmentShader: fragment,
      side: DoubleSide,
    }),
  );
  private shown = "";

  constructor() {
    this.mesh.frustumCulled = false;
  }

  setColours(dark: string, stripe: string): void {
    (this.mesh.material.uniforms["dark"]!.value as Color).set(dark);
    (this.mesh.material.uniforms["stripe"]!.value as Color).set(stripe);
  }

  /** Under the background of the largest outline. */
  show(objects: Iterable<MapObject>): void {
    const widest = widestBackground(objects);
    const key = widest
      ? `${widest.footprint_m.map((at) => at.toFixed(1)).join(",")} ${bottomOf(widest).toFixed(1)}`
      : "";
    if (key === this.shown) return;
    this.shown = key;
    this.mesh.geometry.dispose();
    this.mesh.geometry = new BufferGeometry();
    this.mesh.visible = widest !== null;
    if (!widest) return;
    const outline = outlineOf(widest);
    const z = bottomOf(widest) - 0.05;
    this.mesh.geometry.setAttribute(
      "position",
      new BufferAttribute(new Float32Array(outline.flatMap(({ x, y }) => [x, y, z])), 3),
    );
    this.mesh.geometry.setIndex(ShapeUtils.triangulateShape(outline, []).flat());
  }
}

/** The background of the largest outline: what one stands on, or what stands around it. */
function widestBackground(objects: Iterable<MapObject>): MapObject | null {
  let widest: MapObject | null = null;
  let most = 0;
  for (const object of objects) {
    if (object.kind !== "stuff") continue;
    const area = Math.abs(ShapeUtils.area(outlineOf(object)));
    if (area > most) [widest, most] = [object, area];
  }
  return widest;
}

/** About where the floor is; 0 if there is nothing yet. */
export function floorOf_m(objects: Iterable<MapObject>): number {
  const widest = widestBackground(objects);
  return widest ? bottomOf(widest) : 0;
}

const outlineOf = ({ footprint_m }: MapObject): Vector2[] =>
  footprint_m.flatMap((x, i) => (i % 2 === 0 ? [new Vector2(x, footprint_m[i + 1] ?? 0)] : []));

const bottomOf = ({ box }: MapObject): number => (box ? box.pose.translation_m.z - box.size_m.z / 2 : 0);

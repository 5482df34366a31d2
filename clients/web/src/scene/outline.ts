// SPDX-License-Identifier: BSD-3-Clause
import {
  Color,
  Plane,
  Vector3,
  Mesh,
  MeshBasicMaterial,
  OrthographicCamera,
  PlaneGeometry,
  Scene,
  ShaderMaterial,
  UnsignedByteType,
  Vector2,
  WebGLRenderTarget,
  type Camera,
  type Box3,
  type WebGLRenderer,
} from "three";
import type { ObjectMesh } from "./object_mesh";

const vertex = `varying vec2 at; void main() { at = uv; gl_Position = vec4(position.xy, 0.0, 1.0); }`;
const fragment = /* glsl */ `
  uniform sampler2D mask;
  uniform vec2 step_;
  uniform vec3 selected;
  uniform vec3 hovered;
  varying vec2 at;
  void main() {
    vec2 here = texture2D(mask, at).rg;
    vec2 around = vec2(0.0);
    for (int i = 0; i < 8; ++i) {
      float angle = 0.7853981 * float(i);
      around = max(around, texture2D(mask, at + step_ * vec2(cos(angle), sin(angle))).rg);
    }
    vec2 edge = clamp(around - here, 0.0, 1.0);
    vec3 shown = mix(hovered, selected, step(edge.g, edge.r));
    float cover = max(edge.r, 0.75 * edge.g);
    // A breath of colour inside says which it is where its edge is hidden.
    float inside = here.r * 0.10;
    gl_FragColor = vec4(mix(selected, shown, step(0.001, cover)), max(cover, inside));
  }`;

/** Draws a line around what is selected and around what is under the cursor, also where something hides it. */
export class Outline {
  private readonly target = new WebGLRenderTarget(1, 1, { type: UnsignedByteType, depthBuffer: false });
  private readonly scene = new Scene();
  private readonly screen = new Scene();
  private readonly flat = new OrthographicCamera(-1, 1, 1, -1, 0, 1);
  private readonly red = new MeshBasicMaterial({ color: new Color(1, 0, 0), depthTest: false });
  private readonly green = new MeshBasicMaterial({ color: new Color(0, 1, 0), depthTest: false });
  private readonly material = new ShaderMaterial({
    uniforms: {
      mask: { value: this.target.texture },
      step_: { value: new Vector2() },
      selected: { value: new Color("#4C9AFF") },
      hovered: { value: new Color("#E6E9EF") },
    },
    vertexShader: vertex,
    fragmentShader: fragment + "\n",
    transparent: true,
    depthTest: false,
    depthWrite: false,
  });

  constructor() {
    const quad = new Mesh(new PlaneGeometry(2, 2), this.material);
    quad.frustumCulled = false;
    this.screen.add(quad);
  }

  /** What is beyond the box has no outline. */
  setClip(box: Box3 | null): void {
    const planes = box && [0, 1, 2].flatMap((axis) => {
      const normal = new Vector3().setComponent(axis, 1);
      return [
        new Plane(normal, -box.min.getComponent(axis)),
        new Plane(normal.clone().negate(), box.max.getComponent(axis)),
      ];
    });
    for (const material of [this.red, this.green]) {
      material.clippingPlanes = planes;
      material.needsUpdate = true;
    }
  }

  setHoverColour(css: string): void {
    (this.material.uniforms["hovered"]!.value as Color).set(css);
  }

  setSelectionColour(css: string): void {
    (this.material.uniforms["selected"]!.value as Color).set(css);
  }

  /** After the scene itself. Nothing to show: nothing is drawn. */
  draw(renderer: WebGLRenderer, camera: Camera, selected: ObjectMesh | null, hovered: ObjectMesh | null): void {
    this.scene.clear();
    if (hovered && hovered !== selected) this.add(hovered, this.green);
    if (selected) this.add(selected, this.red);
    if (this.scene.children.length === 0) return;
    const size = renderer.getDrawingBufferSize(new Vector2());
    this.target.setSize(size.x, size.y);
    const width = Math.max(1.2, 1.6 * renderer.getPixelRatio());
    (this.material.uniforms["step_"]!.value as Vector2).set(width / size.x, width / size.y);
    const before = renderer.getClearAlpha();
    renderer.setRenderTarget(this.target);
    renderer.setClearAlpha(0);
    renderer.clear();
    renderer.render(this.scene, camera);
    renderer.setClearAlpha(before);
    renderer.setRenderTarget(null);
    renderer.render(this.screen, this.flat);
  }

  private add(object: ObjectMesh, material: MeshBasicMaterial): void {
    const copy = new Mesh(object.mesh.geometry, material);
    copy.matrixAutoUpdate = false;
    copy.matrix.copy(object.mesh.matrix);
    this.scene.add(copy);
  }
}

// SPDX-License-Identifier: BSD-3-Clause
import { BufferAttribute, BufferGeometry, LineBasicMaterial, LineSegments, Matrix4, Vector3 } from "three";
import type { MapObject } from "../api/types";
import type { Rgb } from "./colours";
import { matrixOfPose } from "./object_mesh";

/** The 12 edges of a box of half sides 1 as pairs of corners. */
const edges: readonly (readonly [number, number, number])[] = (() => {
  const points: [number, number, number][] = [];
  for (let axis = 0; axis < 3; ++axis) {
    for (const a of [-1, 1]) {
      for (const b of [-1, 1]) {
        for (const end of [-1, 1]) {
          const point: [number, number, number] = [0, 0, 0];
          point[axis] = end;
          point[(axis + 1) % 3] = a;
          point[(axis + 2) % 3] = b;
          points.push(point);
        }
      }
    }
  }
  return points;
})();

export interface Box {
  readonly object: MapObject;
  readonly colour: Rgb;
  readonly T_moved: Matrix4 | null;
}

/** The boxes of objects, all in one draw call. */
export class Boxes {
  readonly lines = new LineSegments(
    new BufferGeometry(),
    new LineBasicMaterial({ vertexColors: true, transparent: true, opacity: 0.85 }),
  );

  constructor() {
    this.lines.frustumCulled = false;
  }

  show(boxes: readonly Box[]): void {
    const positions: number[] = [];
    const colours: number[] = [];
    for (const { object, colour, T_moved } of boxes) {
      if (!object.box) continue;
      const matrix = matrixOfPose(object.box.pose);
      if (T_moved) matrix.premultiply(T_moved);
      const { x, y, z } = object.box.size_m;
      for (const [ex, ey, ez] of edges) {
        const point = new Vector3(0.5 * ex * x, 0.5 * ey * y, 0.5 * ez * z).applyMatrix4(matrix);
        positions.push(point.x, point.y, point.z);
        colours.push(...colour);
      }
    }
    this.lines.geometry.dispose();
    this.lines.geometry = new BufferGeometry();
    this.lines.geometry.setAttribute("position", new BufferAttribute(new Float32Array(positions), 3));
    this.lines.geometry.setAttribute("color", new BufferAttribute(new Float32Array(colours), 3));
    this.lines.visible = positions.length > 0;
  }
}

// SPDX-License-Identifier: BSD-3-Clause
import { BufferAttribute, BufferGeometry, LineBasicMaterial, LineSegments } from "three";
import type { AxisBox } from "../api/types";

/** The edges of boxes along the axes, all in one draw call. */
export class BoxLines {
  readonly lines: LineSegments<BufferGeometry, LineBasicMaterial>;

  constructor(colour: string, isInFront: boolean) {
    this.lines = new LineSegments(new BufferGeometry(), new LineBasicMaterial({ color: colour, depthTest: !isInFront }));
    this.lines.frustumCulled = false;
  }

  show(boxes: readonly AxisBox[]): void {
    const positions = boxes.flatMap(({ min_m, max_m }) => {
      const [a, b] = [[min_m.x, min_m.y, min_m.z] as const, [max_m.x, max_m.y, max_m.z] as const];
      const corner = (bits: number) => [0, 1, 2].map((axis) => (bits & (1 << axis) ? b[axis]! : a[axis]!));
      const pairs = [0, 1, 2].flatMap((axis) =>
        [0, 1, 2, 3, 4, 5, 6, 7].filter((bits) => !(bits & (1 << axis))).map((bits) => [bits, bits | (1 << axis)]),
      );
      return pairs.flatMap(([from, to]) => [...corner(from!), ...corner(to!)]);
    });
    this.lines.geometry.dispose();
    this.lines.geometry = new BufferGeometry();
    this.lines.geometry.setAttribute("position", new BufferAttribute(new Float32Array(positions), 3));
    this.lines.visible = positions.length > 0;
  }
}

// SPDX-License-Identifier: BSD-3-Clause
import {
  BufferAttribute,
  BufferGeometry,
  DoubleSide,
  Group,
  Line,
  LineBasicMaterial,
  LineSegments,
  Mesh,
  MeshBasicMaterial,
} from "three";
import type { Robot } from "../api/types";
import { matrixOfPose } from "./object_mesh";

/** Of a camera that looks along z, y down: what it sees at this distance. */
const [depth_m, halfWidth_m, halfHeight_m] = [0.32, 0.2, 0.15];
const corners = [
  [-halfWidth_m, -halfHeight_m, depth_m],
  [halfWidth_m, -halfHeight_m, depth_m],
  [halfWidth_m, halfHeight_m, depth_m],
  [-halfWidth_m, halfHeight_m, depth_m],
] as const;

/** Each robot as the frame that its sensor sees, and the way that it has come. */
export class RobotMarks {
  readonly group = new Group();
  private readonly path = new LineBasicMaterial({ color: "#E6E9EF", transparent: true, opacity: 0.7 });
  private readonly frame = new LineBasicMaterial({ color: "#E6E9EF" });
  private readonly away = new LineBasicMaterial({ color: "#8B93A3" });
  private readonly face = new MeshBasicMaterial({
    color: "#E6E9EF",
    transparent: true,
    opacity: 0.18,
    side: DoubleSide,
    depthWrite: false,
  });

  show(robots: readonly Robot[]): void {
    for (const part of [...this.group.children]) {
      part.removeFromParent();
      (part as Mesh).geometry.dispose();
    }
    for (const { pose, path_m, isFeeding } of robots) {
      const way = new Line(geometryOf(path_m.flatMap(({ x, y, z }) => [x, y, z])), this.path);
      way.frustumCulled = false;
      const rays = corners.flatMap((corner, i) => [0, 0, 0, ...corner, ...corner, ...corners[(i + 1) % 4]!]);
      const sight = new LineSegments(geometryOf(rays), isFeeding ? this.frame : this.away);
      const [a, b, c, d] = corners;
      const glass = new Mesh(geometryOf([...a, ...b, ...c, ...a, ...c, ...d]), this.face);
      for (const part of [sight, glass]) {
        part.matrixAutoUpdate = false;
        part.matrix.copy(matrixOfPose(pose));
      }
      this.group.add(way, sight, glass);
    }
  }
}

function geometryOf(numbers: readonly number[]): BufferGeometry {
  const geometry = new BufferGeometry();
  geometry.setAttribute("position", new BufferAttribute(new Float32Array(numbers), 3));
  return geometry;
}

// SPDX-License-Identifier: BSD-3-Clause
import {
  CircleGeometry,
  DoubleSide,
  Group,
  Mesh,
  MeshBasicMaterial,
  PlaneGeometry,
  SphereGeometry,
  Vector3,
  type BufferGeometry,
} from "three";
import type { PathAnswer } from "../api/types";
import type { Ball } from "../state/robot";

const above_m = 0.03;
const plain = "#E6E9EF";
const red = "#FF5A5F";

const materialOf = (color: string, opacity: number) =>
  new MeshBasicMaterial({ color, opacity, transparent: true, side: DoubleSide, depthTest: false, depthWrite: false });

/** The strip of floor that a robot takes on its way, and the robot where it touches something, or where it arrives. */
export class PathShape {
  readonly group = new Group();
  private readonly free = materialOf(plain, 0.45);
  private readonly beyond = materialOf(red, 0.45);
  private readonly line = materialOf(plain, 0.95);
  private readonly robot = materialOf(plain, 0.22);
  private readonly touching = materialOf(red, 0.4);

  show(points: readonly Vector3[], robot: readonly Ball[], answer: PathAnswer | null): void {
    this.clear();
    const width_m = 2 * (robot[0]?.radius_m ?? 0);
    const contact = answer?.contact ?? null;
    const end = contact ? contact.waypoint + contact.fraction : Infinity;
    points.forEach((at, i) => {
      this.disc(at, width_m / 2, i <= end ? this.free : this.beyond);
      this.disc(at, Math.min(0.05, width_m / 4), this.line);
      const to = points[i + 1];
      if (!to) return;
      const middle = at.clone().lerp(to, Math.min(1, Math.max(0, end - i)));
      this.strip(at, middle, width_m, this.free);
      this.strip(middle, to, width_m, this.beyond);
      this.strip(at, to, 0.02, this.line);
    });
    const last = points.at(-1);
    if (!last) return;
    const from = points[Math.min(points.length - 1, Math.floor(end))] ?? last;
    const to = points[Math.min(points.length - 1, Math.floor(end) + 1)] ?? last;
    const place = contact ? from.clone().lerp(to, contact.fraction) : last;
    for (const ball of robot) this.ball(place, ball, contact ? this.touching : this.robot);
  }

  clear(): void {
    for (const part of [...this.group.children]) {
      part.removeFromParent();
      ((part as Mesh).geometry as BufferGeometry).dispose();
    }
  }

  private add(geometry: BufferGeometry, material: MeshBasicMaterial): Mesh {
    const mesh = new Mesh(geometry, material);
    this.group.add(mesh);
    return mesh;
  }

  private disc(at: Vector3, radius_m: number, material: MeshBasicMaterial): void {
    this.add(new CircleGeometry(radius_m, 32), material).position.copy(at).setZ(at.z + above_m);
  }

  private strip(from: Vector3, to: Vector3, width_m: number, material: MeshBasicMaterial): void {
    const along = to.clone().sub(from);
    const length = Math.hypot(along.x, along.y);
    if (length < 1e-4) return;
    const mesh = this.add(new PlaneGeometry(length, width_m), material);
    mesh.position.copy(from).addScaledVector(along, 0.5).setZ((from.z + to.z) / 2 + above_m);
    mesh.rotation.z = Math.atan2(along.y, along.x);
  }

  private ball(at: Vector3, { center_m, radius_m }: Ball, material: MeshBasicMaterial): void {
    const mesh = this.add(new SphereGeometry(radius_m, 20, 14), material);
    mesh.position.set(at.x + center_m.x, at.y + center_m.y, at.z + center_m.z);
  }
}

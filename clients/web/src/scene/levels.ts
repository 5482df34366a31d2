// SPDX-License-Identifier: BSD-3-Clause
// Which level each object is drawn in: the finest that fits into so many triangles, and nothing finer than is seen.
import { Sphere, type PerspectiveCamera } from "three";
import { numLevels, type ObjectMesh } from "./object_mesh";

/** What one does not see, in pixels; then what is tried in turn. */
const tolerances_px = [0.7, 1.4, 2, 2.8, 4, 5.6, 8, 11, 16, 22, 32, 45, 64] as const;

interface Seen {
  readonly object: ObjectMesh;
  readonly pixelsPerMetre: number;
}

const levelWithin = ({ object, pixelsPerMetre }: Seen, tolerance_px: number): number => {
  let level = 0;
  while (level + 1 < numLevels && object.errorOf_m(level + 1) * pixelsPerMetre <= tolerance_px) ++level;
  return level;
};

/** The levels within one tolerance; what then is left of the triangles goes to the small ones: those are looked at. */
function levelsFor(seen: readonly Seen[], mostTriangles: number): readonly number[] {
  const within = (tolerance: number): number[] => seen.map((each) => levelWithin(each, tolerance));
  const costOf = (levels: readonly number[]) =>
    seen.reduce((sum, { object }, i) => sum + object.trianglesOf(levels[i] ?? 0), 0);
  const levels = tolerances_px.map(within).find((each) => costOf(each) <= mostTriangles) ?? within(Infinity);
  let left = mostTriangles - costOf(levels);
  if (!Number.isFinite(left)) return levels;
  const bySize = seen.map((_, i) => i).sort((a, b) => seen[a]!.object.numTriangles - seen[b]!.object.numTriangles);
  for (const i of bySize) {
    const { object } = seen[i]!;
    for (let level = levels[i] ?? 0; level > 0; levels[i] = --level) {
      const more = object.trianglesOf(level - 1) - object.trianglesOf(level);
      if (more > left || object.errorOf_m(level) * seen[i]!.pixelsPerMetre <= tolerances_px[0]!) break;
      left -= more;
    }
  }
  return levels;
}

/** Shows each visible object in its level, until showWhole() is called. */
export function showLevels(
  objects: Iterable<ObjectMesh>,
  camera: PerspectiveCamera,
  height_px: number,
  mostTriangles: number,
): void {
  const pixelsAtOne_m = height_px / (2 * Math.tan((camera.fov * Math.PI) / 360));
  const seen: Seen[] = [];
  for (const object of objects) {
    if (!object.mesh.visible) continue;
    object.mesh.updateMatrixWorld();
    const sphere = new Sphere().copy(object.mesh.geometry.boundingSphere!).applyMatrix4(object.mesh.matrixWorld);
    const nearest_m = Math.max(0.5, sphere.center.distanceTo(camera.position) - 0.7 * sphere.radius);
    seen.push({ object, pixelsPerMetre: pixelsAtOne_m / nearest_m });
  }
  const levels = levelsFor(seen, mostTriangles);
  seen.forEach(({ object }, i) => (object.mesh.geometry = object.geometryOf(levels[i] ?? 0)));
}

/** What is picked and outlined is the surface itself. */
export function showWhole(objects: Iterable<ObjectMesh>): void {
  for (const object of objects) object.mesh.geometry = object.geometryOf(0);
}

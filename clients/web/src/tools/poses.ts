// SPDX-License-Identifier: BSD-3-Clause
import { Matrix4, Quaternion, Vector3 } from "three";
import type { MapObject, Pose } from "../api/types";
import { matrixOfPose } from "../scene/object_mesh";

export const poseOfMatrix = (matrix: Matrix4): Pose => {
  const t = new Vector3();
  const r = new Quaternion();
  matrix.decompose(t, r, new Vector3());
  return { translation_m: { x: t.x, y: t.y, z: t.z }, rotation: { x: r.x, y: r.y, z: r.z, w: r.w } };
};

/** The middle of the object's box, or of its sphere: what it is dragged and turned by, wherever its frame is. */
export function pivotOf(object: MapObject): Vector3 {
  const middle = object.box?.pose.translation_m ?? object.sphere?.center ?? object.pose.translation_m;
  return new Vector3(middle.x, middle.y, middle.z);
}

/** The object's pose after a move in the map frame. */
export const shifted = (pose: Pose, by_m: Vector3): Pose =>
  poseOfMatrix(new Matrix4().makeTranslation(by_m).multiply(matrixOfPose(pose)));

/** The object's pose after a turn about the vertical through `pivot`, counterclockwise from above. */
export function turned(pose: Pose, pivot: Vector3, angle_rad: number): Pose {
  const turn = new Matrix4()
    .makeTranslation(pivot)
    .multiply(new Matrix4().makeRotationZ(angle_rad))
    .multiply(new Matrix4().makeTranslation(pivot.clone().negate()));
  return poseOfMatrix(turn.multiply(matrixOfPose(pose)));
}

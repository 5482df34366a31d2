// SPDX-License-Identifier: BSD-3-Clause
#include "server/ingest/pose_conversion.h"

namespace dhpmap {

Result<Transform> TransformFromProto(const v1::Pose& pose, std::string_view field) {
  const v1::Vector3& t = pose.translation_m();
  Eigen::Vector4d xyzw(0, 0, 0, 1);
  if (pose.has_rotation()) {
    xyzw = {pose.rotation().x(), pose.rotation().y(), pose.rotation().z(), pose.rotation().w()};
  }
  return TransformFromQuaternion({t.x(), t.y(), t.z()}, xyzw, field);
}

v1::Pose ToProto(const Transform& T) {
  v1::Pose pose;
  pose.mutable_translation_m()->set_x(T.translation().x());
  pose.mutable_translation_m()->set_y(T.translation().y());
  pose.mutable_translation_m()->set_z(T.translation().z());
  const Eigen::Quaterniond q(T.linear());
  pose.mutable_rotation()->set_x(q.x());
  pose.mutable_rotation()->set_y(q.y());
  pose.mutable_rotation()->set_z(q.z());
  pose.mutable_rotation()->set_w(q.w());
  return pose;
}

}  // namespace dhpmap

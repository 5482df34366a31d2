// SPDX-License-Identifier: BSD-3-Clause
#include "proto/types/pose_conversion.h"

namespace dhpmap {

Eigen::Vector3d VectorFromProto(const v1::Vector3& v) { return {v.x(), v.y(), v.z()}; }

v1::Vector3 ToProto(const Eigen::Vector3d& v) {
  v1::Vector3 proto;
  proto.set_x(v.x());
  proto.set_y(v.y());
  proto.set_z(v.z());
  return proto;
}

Result<Transform> TransformFromProto(const v1::Pose& pose, std::string_view field) {
  Eigen::Vector4d xyzw(0, 0, 0, 1);
  if (pose.has_rotation()) {
    xyzw = {pose.rotation().x(), pose.rotation().y(), pose.rotation().z(), pose.rotation().w()};
  }
  return TransformFromQuaternion(VectorFromProto(pose.translation_m()), xyzw, field);
}

v1::Pose ToProto(const Transform& T) {
  v1::Pose pose;
  *pose.mutable_translation_m() = ToProto(Eigen::Vector3d(T.translation()));
  const Eigen::Quaterniond q(T.linear());
  pose.mutable_rotation()->set_x(q.x());
  pose.mutable_rotation()->set_y(q.y());
  pose.mutable_rotation()->set_z(q.z());
  pose.mutable_rotation()->set_w(q.w());
  return pose;
}

}  // namespace dhpmap

// SPDX-License-Identifier: BSD-3-Clause
#include "clients/cpp/src/convert/geometry.h"

#include <charconv>

namespace dhpmap::client {

v1::Vector3 ToProto(const Vector3& v) {
  v1::Vector3 out;
  out.set_x(v.x);
  out.set_y(v.y);
  out.set_z(v.z);
  return out;
}

v1::Pose ToProto(const Pose& pose) {
  v1::Pose out;
  *out.mutable_translation_m() = ToProto(pose.translation_m);
  out.mutable_rotation()->set_x(pose.rotation_xyzw[0]);
  out.mutable_rotation()->set_y(pose.rotation_xyzw[1]);
  out.mutable_rotation()->set_z(pose.rotation_xyzw[2]);
  out.mutable_rotation()->set_w(pose.rotation_xyzw[3]);
  return out;
}

v1::Sphere ToProto(const Sphere& sphere) {
  v1::Sphere out;
  *out.mutable_center_m() = ToProto(sphere.center_m);
  out.set_radius_m(sphere.radius_m);
  return out;
}

v1::AxisAlignedBox ToProto(const Box& box) {
  v1::AxisAlignedBox out;
  *out.mutable_min_m() = ToProto(box.min_m);
  *out.mutable_max_m() = ToProto(box.max_m);
  return out;
}

v1::Body ToProto(const Body& body) {
  v1::Body out;
  if (const auto* sphere = std::get_if<Sphere>(&body)) {
    *out.mutable_sphere() = ToProto(*sphere);
  } else if (const auto* box = std::get_if<OrientedBox>(&body)) {
    *out.mutable_box()->mutable_pose() = ToProto(box->T_map_box);
    *out.mutable_box()->mutable_size_m() = ToProto(box->size_m);
  } else if (const auto* capsule = std::get_if<Capsule>(&body)) {
    *out.mutable_capsule()->mutable_a_m() = ToProto(capsule->a_m);
    *out.mutable_capsule()->mutable_b_m() = ToProto(capsule->b_m);
    out.mutable_capsule()->set_radius_m(capsule->radius_m);
  }
  return out;
}

Vector3 FromProto(const v1::Vector3& v) { return {v.x(), v.y(), v.z()}; }

Pose FromProto(const v1::Pose& pose) {
  Pose out{FromProto(pose.translation_m())};
  if (pose.has_rotation()) {
    const v1::Quaternion& q = pose.rotation();
    out.rotation_xyzw = {q.x(), q.y(), q.z(), q.w()};
  }
  return out;
}

Sphere FromProto(const v1::Sphere& sphere) { return {FromProto(sphere.center_m()), sphere.radius_m()}; }

Box FromProto(const v1::AxisAlignedBox& box) { return {FromProto(box.min_m()), FromProto(box.max_m())}; }

std::string SubmapName(const std::string& map, std::int64_t id) { return map + "/submaps/" + std::to_string(id); }

std::int64_t IdOfName(const std::string& name) {
  const std::size_t begin = name.rfind('/') + 1;  // 0 if there is no slash
  std::int64_t id = -1;
  std::from_chars(name.data() + begin, name.data() + name.size(), id);
  return id;
}

}  // namespace dhpmap::client

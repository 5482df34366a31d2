// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>

#include "dhpmap/geometry.h"
#include "dhpmap/v1/collision.pb.h"
#include "dhpmap/v1/types.pb.h"

namespace dhpmap::client {

v1::Vector3 ToProto(const Vector3& v);
v1::Pose ToProto(const Pose& pose);
v1::Sphere ToProto(const Sphere& sphere);
v1::AxisAlignedBox ToProto(const Box& box);
v1::Body ToProto(const Body& body);

Vector3 FromProto(const v1::Vector3& v);
Pose FromProto(const v1::Pose& pose);
Sphere FromProto(const v1::Sphere& sphere);
Box FromProto(const v1::AxisAlignedBox& box);

/// Sets the region of a message that has `box` and `sphere`.
template <typename Message>
void SetRegion(const Region& region, Message& message) {
  if (const Box* box = std::get_if<Box>(&region)) *message.mutable_box() = ToProto(*box);
  else *message.mutable_sphere() = ToProto(std::get<Sphere>(region));
}

/// maps/{map}/submaps/{id}.
std::string SubmapName(const std::string& map, std::int64_t id);
/// The number after the last slash; -1 if there is none.
std::int64_t IdOfName(const std::string& name);

}  // namespace dhpmap::client

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string_view>

#include "dhpmap/v1/types.pb.h"
#include "mapping/base/transform.h"

namespace dhpmap {

Eigen::Vector3d VectorFromProto(const v1::Vector3& v);
v1::Vector3 ToProto(const Eigen::Vector3d& v);

/// INVALID_ARGUMENT, with `field` in the violation, for a pose that is not finite or whose rotation has no norm. A
/// missing translation is zero, a missing rotation the identity.
Result<Transform> TransformFromProto(const v1::Pose& pose, std::string_view field);

v1::Pose ToProto(const Transform& T);

}  // namespace dhpmap

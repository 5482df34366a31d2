// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <string_view>

#include "mapping/base/result.h"

namespace dhpmap {

/// Rigid transform. `T_a_b` takes coordinates of frame b to frame a: p_a = T_a_b * p_b.
using Transform = Eigen::Isometry3d;

/// Builds a transform from a row-major 4x4 matrix, or says why it is not rigid: non-finite entries, last row other than
/// 0 0 0 1, rotation off orthonormal by more than 1e-3, or a mirror. Small errors are projected out.
Result<Transform> TransformFromMatrix(const Eigen::Matrix4d& matrix, std::string_view name);

/// Builds a transform from a translation (m) and a quaternion (x, y, z, w) that need not be normalised; refuses
/// non-finite values and a quaternion of norm below 1e-6 or above 1e6.
Result<Transform> TransformFromQuaternion(const Eigen::Vector3d& translation_m, const Eigen::Vector4d& xyzw,
                                          std::string_view name);

/// True if every coordinate is finite.
bool IsFinite(const Transform& T);

/// True if T differs from the identity by no more than `tolerance` in every matrix entry.
bool IsIdentity(const Transform& T, double tolerance = 1e-12);

}  // namespace dhpmap

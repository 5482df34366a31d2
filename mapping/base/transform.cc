// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/base/transform.h"

#include <Eigen/SVD>
#include <string>

namespace dhpmap {
namespace {

constexpr double kMaxOrthonormalError = 1e-3;
constexpr double kMinQuaternionNorm = 1e-6, kMaxQuaternionNorm = 1e6;

Status BadTransform(std::string_view name, const char* what) {
  return InvalidArgument(std::string(name) + " " + what)
      .WithReason("BAD_TRANSFORM")
      .WithViolation(std::string(name), what);
}

}  // namespace

Result<Transform> TransformFromMatrix(const Eigen::Matrix4d& matrix, std::string_view name) {
  if (!matrix.allFinite()) return BadTransform(name, "has a NaN or infinite entry");
  if ((matrix.row(3) - Eigen::RowVector4d(0, 0, 0, 1)).cwiseAbs().maxCoeff() > kMaxOrthonormalError) {
    return BadTransform(name, "has a last row other than 0 0 0 1");
  }
  const Eigen::Matrix3d rotation = matrix.topLeftCorner<3, 3>();
  const Eigen::Matrix3d gram = rotation.transpose() * rotation - Eigen::Matrix3d::Identity();
  if (gram.cwiseAbs().maxCoeff() > kMaxOrthonormalError) return BadTransform(name, "is not a rigid transform");
  if (rotation.determinant() < 0) return BadTransform(name, "is a mirror, not a rotation");

  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(rotation, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Transform T = Transform::Identity();
  T.linear() = svd.matrixU() * svd.matrixV().transpose();
  T.translation() = matrix.topRightCorner<3, 1>();
  return T;
}

Result<Transform> TransformFromQuaternion(const Eigen::Vector3d& translation_m, const Eigen::Vector4d& xyzw,
                                          std::string_view name) {
  if (!translation_m.allFinite() || !xyzw.allFinite()) return BadTransform(name, "has a NaN or infinite entry");
  if (xyzw.norm() < kMinQuaternionNorm) return BadTransform(name, "has a zero quaternion");
  if (!(xyzw.norm() <= kMaxQuaternionNorm)) return BadTransform(name, "has a quaternion of a norm above 1e6");
  const Eigen::Quaterniond q(xyzw[3], xyzw[0], xyzw[1], xyzw[2]);
  Transform T = Transform::Identity();
  T.linear() = q.normalized().toRotationMatrix();
  T.translation() = translation_m;
  return T;
}

bool IsFinite(const Transform& T) { return T.matrix().allFinite(); }

bool IsIdentity(const Transform& T, double tolerance) {
  return ((T.matrix() - Eigen::Matrix4d::Identity()).cwiseAbs().array() <= tolerance).all();  // false for NaN
}

}  // namespace dhpmap

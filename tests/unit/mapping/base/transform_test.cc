// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/base/transform.h"

#include <gtest/gtest.h>

#include <limits>

namespace dhpmap {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

Transform Sample() {
  Transform T = Transform::Identity();
  T.linear() = Eigen::AngleAxisd(1.2, Eigen::Vector3d(1, -2, 0.5).normalized()).toRotationMatrix();
  T.translation() = Eigen::Vector3d(10, -20, 3);
  return T;
}

void ExpectRefused(const Eigen::Matrix4d& matrix) {
  const auto result = TransformFromMatrix(matrix, "pose");
  ASSERT_FALSE(result.ok()) << matrix;
  EXPECT_EQ(result.status().code(), StatusCode::kInvalidArgument);
  EXPECT_EQ(result.status().reason(), Reason("BAD_TRANSFORM"));
  ASSERT_EQ(result.status().violations().size(), 1u);
  EXPECT_EQ(result.status().violations()[0].field, "pose");
}

TEST(TransformFromMatrix, KeepsARigidTransform) {
  const auto T = TransformFromMatrix(Sample().matrix(), "pose");
  ASSERT_TRUE(T.ok());
  EXPECT_TRUE(IsIdentity(*T * Sample().inverse(), 1e-12));
}

TEST(TransformFromMatrix, ProjectsSmallErrorsOut) {
  Eigen::Matrix4d matrix = Sample().matrix();
  matrix.topLeftCorner<3, 3>() *= 1.0002;  // as after printing with few digits
  matrix(0, 1) += 1e-4;
  const auto T = TransformFromMatrix(matrix, "pose");
  ASSERT_TRUE(T.ok());
  EXPECT_TRUE((T->linear() * T->linear().transpose()).isIdentity(1e-12));
  EXPECT_NEAR(T->linear().determinant(), 1.0, 1e-12);
  EXPECT_TRUE(IsIdentity(*T * Sample().inverse(), 0.02));
}

TEST(TransformFromMatrix, RefusesWhatIsNotRigid) {
  Eigen::Matrix4d matrix = Sample().matrix();
  matrix(1, 3) = kNan;
  ExpectRefused(matrix);
  matrix = Sample().matrix();
  matrix(2, 2) = std::numeric_limits<double>::infinity();
  ExpectRefused(matrix);
  matrix = Sample().matrix();
  matrix.topLeftCorner<3, 3>() *= 1.1;
  ExpectRefused(matrix);
  matrix = Sample().matrix();
  matrix.col(0) *= -1;  // a mirror
  ExpectRefused(matrix);
  matrix = Sample().matrix();
  matrix(3, 3) = 2;
  ExpectRefused(matrix);
  matrix = Sample().matrix();
  matrix(3, 0) = 0.5;
  ExpectRefused(matrix);
  ExpectRefused(Eigen::Matrix4d::Zero());
}

TEST(TransformFromQuaternion, NormalisesAndAgreesWithTheMatrix) {
  const Eigen::Quaterniond q(Sample().linear());
  const Eigen::Vector4d xyzw = 7.0 * q.coeffs();
  const auto T = TransformFromQuaternion(Sample().translation(), xyzw, "pose");
  ASSERT_TRUE(T.ok());
  EXPECT_TRUE(IsIdentity(*T * Sample().inverse(), 1e-12));
}

TEST(TransformFromQuaternion, RefusesZeroAndNonFiniteValues) {
  EXPECT_FALSE(TransformFromQuaternion({0, 0, 0}, {0, 0, 0, 0}, "pose").ok());
  EXPECT_FALSE(TransformFromQuaternion({0, 0, 0}, {0, 0, 0, kNan}, "pose").ok());
  EXPECT_FALSE(TransformFromQuaternion({0, kNan, 0}, {0, 0, 0, 1}, "pose").ok());
}

TEST(TransformFromQuaternion, RefusesOneTooLargeToBeNormalised) {
  const auto T = TransformFromQuaternion({0, 0, 0}, {1e200, 0, 0, 1e200}, "pose");
  ASSERT_FALSE(T.ok()) << "a quarter turn became the identity";
  EXPECT_EQ(T.status().violations().at(0).field, "pose");
  EXPECT_FALSE(TransformFromQuaternion({0, 0, 0}, {0, 0, 2e6, 0}, "pose").ok());
  EXPECT_TRUE(TransformFromQuaternion({0, 0, 0}, {0, 0, 9e5, 0}, "pose").ok());
}

TEST(Transform, FiniteAndIdentityTests) {
  Transform T = Transform::Identity();
  EXPECT_TRUE(IsFinite(T));
  EXPECT_TRUE(IsIdentity(T));
  T.translation().x() = 1e-9;
  EXPECT_FALSE(IsIdentity(T));
  EXPECT_TRUE(IsIdentity(T, 1e-8));
  T.translation().x() = kNan;
  EXPECT_FALSE(IsFinite(T));
  EXPECT_FALSE(IsIdentity(T));
}

}  // namespace
}  // namespace dhpmap

// SPDX-License-Identifier: BSD-3-Clause
#include "proto/types/pose_conversion.h"

#include <gtest/gtest.h>

#include <cmath>

namespace dhpmap {
namespace {

TEST(PoseConversion, APoseComesBackAsItWas) {
  Transform T = Transform::Identity();
  T.translation() = Eigen::Vector3d(1, -2, 3);
  T.linear() = Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 2, -1).normalized()).toRotationMatrix();
  const auto back = TransformFromProto(ToProto(T), "pose");
  ASSERT_TRUE(back.ok());
  EXPECT_TRUE(IsIdentity(back->inverse() * T, 1e-12));
}

TEST(PoseConversion, WhatIsMissingIsTheIdentity) { EXPECT_TRUE(IsIdentity(*TransformFromProto({}, "pose"), 0)); }

TEST(PoseConversion, AnUnusablePoseIsNamedByItsField) {
  v1::Pose pose;
  pose.mutable_rotation();
  EXPECT_EQ(TransformFromProto(pose, "a.b").status().violations().at(0).field, "a.b");
  pose.clear_rotation();
  pose.mutable_translation_m()->set_z(std::nan(""));
  EXPECT_EQ(TransformFromProto(pose, "a.b").status().reason(), Reason("BAD_TRANSFORM"));
}

}  // namespace
}  // namespace dhpmap

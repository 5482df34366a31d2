// SPDX-License-Identifier: BSD-3-Clause
#include "server/wire/submap_conversion.h"

#include <gtest/gtest.h>

#include <optional>
#include <string>
#include <vector>

namespace dhpmap {
namespace {

TEST(PatchFromProto, AnUpdateMaskMayNameOnlyWritableFields) {
  v1::UpdateSubmapRequest request;
  for (const char* path : {"display_name", "class_id", "map_from_submap.rotation.w", "etag", "name"}) {
    request.mutable_update_mask()->add_paths(path);
  }
  EXPECT_TRUE(PatchFromProto(request).ok());
  for (const char* path : {"voxel_size_m", "nope", "map_from_submap.nope"})
    request.mutable_update_mask()->add_paths(path);
  EXPECT_EQ(PatchFromProto(request).status().reason(), Reason("BAD_UPDATE_MASK"));
  EXPECT_EQ(PatchFromProto(request).status().violations().size(), 3u);
}

TEST(PatchFromProto, WithoutAMaskUsesTheSetFields) {
  v1::UpdateSubmapRequest request;
  EXPECT_FALSE(PatchFromProto(request)->T_map_submap || PatchFromProto(request)->pose_change);
  request.mutable_submap()->set_display_name("red chair");
  request.mutable_submap()->set_class_id(7);
  request.mutable_submap()->mutable_map_from_submap()->mutable_translation_m()->set_x(2);
  const auto patch = PatchFromProto(request);
  ASSERT_TRUE(patch.ok());
  EXPECT_EQ(patch->display_name, "red chair");
  EXPECT_EQ(patch->class_id, ClassId(7));
  ASSERT_TRUE(patch->T_map_submap.has_value());
  EXPECT_EQ(patch->T_map_submap->translation(), Eigen::Vector3d(2, 0, 0));
  EXPECT_TRUE(IsIdentity(Transform(patch->T_map_submap->linear()), 1e-12)) << "a missing rotation is the identity";
}

TEST(PatchFromProto, AMaskSetsOrClearsItsFields) {
  v1::UpdateSubmapRequest request;
  request.mutable_submap()->set_class_id(7);
  request.mutable_update_mask()->add_paths("display_name");
  const auto patch = PatchFromProto(request);
  ASSERT_TRUE(patch.ok());
  EXPECT_EQ(patch->display_name, "");
  EXPECT_FALSE(patch->class_id.has_value());
}

TEST(PatchFromProto, AStarSetsAllWritableFields) {
  v1::UpdateSubmapRequest request;
  request.mutable_submap()->set_class_id(7);
  request.mutable_submap()->mutable_map_from_submap()->mutable_translation_m()->set_x(2);
  request.mutable_update_mask()->add_paths("*");
  const auto patch = PatchFromProto(request);
  ASSERT_TRUE(patch.ok());
  EXPECT_EQ(patch->class_id, ClassId(7));
  EXPECT_EQ(patch->display_name, "") << "what is not there, too";
  EXPECT_EQ(patch->is_locked, false);
  ASSERT_TRUE(patch->T_map_submap.has_value());
  EXPECT_EQ(patch->T_map_submap->translation(), Eigen::Vector3d(2, 0, 0));
}

using Numbers = std::vector<std::optional<double>>;
Numbers ChangeOf(const std::vector<std::string>& paths, bool with_rotation) {
  v1::UpdateSubmapRequest request;
  v1::Pose& pose = *request.mutable_submap()->mutable_map_from_submap();
  pose.mutable_translation_m()->set_y(3);
  if (with_rotation) pose.mutable_rotation()->set_z(1);
  for (const std::string& path : paths) request.mutable_update_mask()->add_paths("map_from_submap." + path);
  const auto patch = PatchFromProto(request);
  EXPECT_TRUE(patch.ok() && patch->pose_change && !patch->T_map_submap);
  Numbers numbers(patch->pose_change->translation_m.begin(), patch->pose_change->translation_m.end());
  numbers.insert(numbers.end(), patch->pose_change->rotation_xyzw.begin(), patch->pose_change->rotation_xyzw.end());
  return numbers;
}

TEST(PatchFromProto, APartialPoseIsASetOfComponents) {
  constexpr auto kKept = std::nullopt;
  EXPECT_EQ(ChangeOf({"translation_m"}, false), (Numbers{0, 3, 0, kKept, kKept, kKept, kKept}));
  EXPECT_EQ(ChangeOf({"translation_m.y"}, false), (Numbers{kKept, 3, kKept, kKept, kKept, kKept, kKept}));
  EXPECT_EQ(ChangeOf({"rotation"}, true), (Numbers{kKept, kKept, kKept, 0, 0, 1, 0}));
  EXPECT_EQ(ChangeOf({"rotation"}, false), (Numbers{kKept, kKept, kKept, 0, 0, 0, 1})) << "missing: the identity";
  EXPECT_EQ(ChangeOf({"rotation.w", "translation_m.x"}, true), (Numbers{0, kKept, kKept, kKept, kKept, kKept, 0}));
}

TEST(PatchFromProto, NamesEveryBadValue) {
  v1::UpdateSubmapRequest request;
  request.mutable_submap()->set_class_id(-1);
  request.mutable_submap()->mutable_map_from_submap()->mutable_rotation();
  const Status status = PatchFromProto(request).status();
  EXPECT_EQ(status.reason(), Reason("BAD_EDIT"));
  ASSERT_EQ(status.violations().size(), 2u);
  EXPECT_EQ(status.violations()[0].field, "class_id");
  EXPECT_EQ(status.violations()[1].field, "map_from_submap");
}

}  // namespace
}  // namespace dhpmap

// SPDX-License-Identifier: BSD-3-Clause
#include "server/app/edits/submap_edits.h"

#include <gtest/gtest.h>

#include <limits>

#include "server/app/maps/map_stats.h"
#include "server/app/queries/submap_filter.h"
#include "server/app/states/etag.h"
#include "tests/support/scenes.h"

namespace dhpmap {
namespace {

class SubmapEditsTest : public ::testing::Test {
 protected:
  SubmapEditsTest() : map(Info()) {
    SubmapInfo info;
    info.panoptic = Panoptic::kThing;
    info.class_id = ClassId(1);
    info.voxel_size_m = 0.1;
    Submap& submap = map.Create(info);
    submap.MutableTsdf({0, 0, 0}).weight.fill(1);
    submap.UpdateBoundingSphere();
    thing = submap.id();
    snapshot = map.Publish(0);
  }
  static MapInfo Info() {
    MapInfo info;
    info.label_set = testing::MakeLabelSet(2, 1);
    return info;
  }
  const SubmapInfo& ThingInfo() { return map.Find(thing)->info(); }

  Map map;
  SubmapId thing;
  std::shared_ptr<const MapSnapshot> snapshot;
};

TEST_F(SubmapEditsTest, AMergedSubmapIsNotFoundAndNamesItsSuccessor) {
  map.mutable_info().name = "m";
  map.mutable_info().merged.Add(SubmapId(7), thing);
  const Status status = DeleteSubmap(map, SubmapId(7), "");
  EXPECT_EQ(status.code(), StatusCode::kNotFound);
  EXPECT_EQ(status.reason(), Reason("MERGED_INTO"));
  EXPECT_EQ(status.metadata(), (std::vector<std::pair<std::string, std::string>>{{"merged_into", "maps/m/submaps/1"}}));
  EXPECT_EQ(DeleteSubmap(map, SubmapId(8), "").reason(), Reason("SUBMAP_NOT_FOUND"));
}

TEST_F(SubmapEditsTest, ARefusedEditMakesNoRevision) {
  SubmapPatch bad_pose{.T_map_submap = Transform::Identity()};
  bad_pose.T_map_submap->translation().x() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(PatchSubmap(map, thing, "", bad_pose).code(), StatusCode::kInvalidArgument);
  EXPECT_EQ(PatchSubmap(map, thing, "", {.class_id = ClassId(3)}).code(), StatusCode::kInvalidArgument);
  EXPECT_EQ(PatchSubmap(map, thing, "r99", {.display_name = "x"}).code(), StatusCode::kAborted);
  EXPECT_EQ(PatchSubmap(map, kUnknownSubmap, "", {.display_name = "x"}).code(), StatusCode::kFailedPrecondition);
  EXPECT_EQ(PatchSubmap(map, SubmapId(9), "", {.display_name = "x"}).code(), StatusCode::kNotFound);
  EXPECT_EQ(DeleteSubmap(map, kUnknownSubmap, "").code(), StatusCode::kFailedPrecondition);
  EXPECT_EQ(CloneSubmap(map, thing, "r99", {}).status().code(), StatusCode::kAborted);
  EXPECT_TRUE(PatchSubmap(map, thing, "", {}).ok());  // nothing to change
  EXPECT_EQ(map.Publish(1), snapshot);
}

TEST_F(SubmapEditsTest, APoseBeyondTheGridIsRefusedWithTheLimitAndWhatToDo) {
  for (const double x_m : {1e308, -1e10}) {
    SubmapPatch patch{.T_map_submap = Transform::Identity()};
    patch.T_map_submap->translation().x() = x_m;
    const Status status = PatchSubmap(map, thing, "", patch);
    EXPECT_EQ(status.code(), StatusCode::kInvalidArgument);
    ASSERT_EQ(status.violations().size(), 1u);
    EXPECT_EQ(status.violations()[0].field, "map_from_submap");
    EXPECT_NE(status.violations()[0].description.find("53687091.2 m"), std::string::npos) << status.ToString();
    EXPECT_NE(status.violations()[0].description.find("local frame"), std::string::npos);
    EXPECT_EQ(CloneSubmap(map, thing, "", patch).status().code(), StatusCode::kInvalidArgument);
  }
  EXPECT_EQ(map.Publish(1), snapshot);
}

TEST_F(SubmapEditsTest, SingleComponentsOfAPoseChangeThePresentOne) {
  Transform T = Transform::Identity();
  T.translation() = Eigen::Vector3d(1, 2, 3);
  T.linear() = Eigen::AngleAxisd(0.5, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  ASSERT_TRUE(PatchSubmap(map, thing, "", {.T_map_submap = T}).ok());
  PoseChange up;
  up.translation_m[2] = 9;
  ASSERT_TRUE(PatchSubmap(map, thing, "", {.pose_change = up}).ok());
  EXPECT_EQ(ThingInfo().T_map_submap.translation(), Eigen::Vector3d(1, 2, 9));
  EXPECT_TRUE(ThingInfo().T_map_submap.linear().isApprox(T.linear(), 1e-12));
  PoseChange upright{.rotation_xyzw = {0, 0, 0, 2}};
  ASSERT_TRUE(PatchSubmap(map, thing, "", {.pose_change = upright}).ok());
  EXPECT_TRUE(ThingInfo().T_map_submap.linear().isIdentity(1e-12));
  const auto before = map.Publish(1);
  PoseChange nothing_left{.rotation_xyzw = {std::nullopt, std::nullopt, std::nullopt, 0}};
  EXPECT_EQ(PatchSubmap(map, thing, "", {.pose_change = nothing_left}).violations().at(0).field, "map_from_submap");
  PoseChange far_off;
  far_off.translation_m[0] = 1e10;
  EXPECT_EQ(PatchSubmap(map, thing, "", {.pose_change = far_off}).violations().at(0).field, "map_from_submap");
  EXPECT_EQ(map.Publish(2), before);
}

TEST_F(SubmapEditsTest, ACopyIsConfirmedEvenIfTheOriginalIsNot) {
  map.FindMutable(thing)->mutable_info().is_confirmed = false;
  const auto copy = CloneSubmap(map, thing, "", {});
  ASSERT_TRUE(copy.ok());
  EXPECT_TRUE(map.Find(*copy)->info().is_confirmed);
  EXPECT_FALSE(ThingInfo().is_confirmed);
}

TEST_F(SubmapEditsTest, ARelabelledClassIsFixed) {
  ASSERT_TRUE(PatchSubmap(map, thing, EtagOf(*map.Find(thing), map.info()), {.class_id = ClassId(2)}).ok());
  EXPECT_EQ(ThingInfo().class_id, ClassId(2));
  EXPECT_TRUE(ThingInfo().class_is_fixed);
  map.Publish(1);
  EXPECT_NE(EtagOf(*map.Find(thing), map.info()), EtagOf(*snapshot->Find(thing), snapshot->info()));
}

TEST_F(SubmapEditsTest, AnEditWithoutEffectMakesNoRevision) {
  Transform T = Transform::Identity();
  T.translation() = Eigen::Vector3d(1, 2, 3);
  T.linear() = Eigen::AngleAxisd(0.5, Eigen::Vector3d(1, 2, 3).normalized()).toRotationMatrix();
  const SubmapPatch patch{
      .T_map_submap = T, .class_id = ClassId(2), .display_name = std::string("lamp"), .is_locked = true};
  ASSERT_TRUE(PatchSubmap(map, thing, "", patch).ok());
  const auto before = map.Publish(1);
  SubmapPatch answered = patch;  // the pose as a client reads it
  const Eigen::Quaterniond q(ThingInfo().T_map_submap.linear());
  answered.T_map_submap = TransformFromQuaternion(T.translation(), q.coeffs(), "").value();
  PoseChange same;
  same.translation_m[1] = 2;
  for (const SubmapPatch& again : {patch, answered, SubmapPatch{.pose_change = same}}) {
    const auto is_changed = PatchSubmap(map, thing, again);
    ASSERT_TRUE(is_changed.ok());
    EXPECT_FALSE(*is_changed);
    EXPECT_EQ(map.Publish(2), before);
  }
  SubmapPatch one_differs = patch;
  one_differs.is_locked = false;
  EXPECT_TRUE(PatchSubmap(map, thing, one_differs).value());
  EXPECT_EQ(map.Publish(3)->revision(), before->revision() + 1);
  EXPECT_EQ(ThingInfo().edited_revision, before->revision() + 1);
}

TEST_F(SubmapEditsTest, SettingADefaultExplicitlyIsAChangeOnce) {
  const SubmapPatch patches[] = {{.class_id = ClassId(1)},
                                 {.T_map_submap = Transform::Identity()},
                                 {.display_name = DisplayNameOf(ThingInfo(), *map.info().label_set)}};
  for (const SubmapPatch& patch : patches) {
    EXPECT_TRUE(PatchSubmap(map, thing, patch).value());
    EXPECT_FALSE(PatchSubmap(map, thing, patch).value());
  }
  EXPECT_TRUE(ThingInfo().class_is_fixed);
  EXPECT_TRUE(ThingInfo().is_placed);
  EXPECT_FALSE(ThingInfo().display_name.empty());
  EXPECT_EQ(map.Publish(1)->revision(), snapshot->revision() + 1);
}

TEST_F(SubmapEditsTest, MovingAnAbsentOrPartlyGoneObjectToItsPlaceRestoresIt) {
  const SubmapPatch stay{.T_map_submap = Transform::Identity()};
  ASSERT_TRUE(PatchSubmap(map, thing, stay).value());
  map.FindMutable(thing)->mutable_info().presence = Presence::kAbsent;
  EXPECT_TRUE(PatchSubmap(map, thing, stay).value());
  EXPECT_EQ(ThingInfo().presence, Presence::kPresent);
  map.FindMutable(thing)->MutableGone({0, 0, 0}).Set(3, 2);
  EXPECT_TRUE(PatchSubmap(map, thing, stay).value());
  EXPECT_FALSE(HasGone(*map.Find(thing)));
  EXPECT_FALSE(PatchSubmap(map, thing, stay).value());
}

TEST_F(SubmapEditsTest, AnEtagIsValidThroughFramesUntilTheNextEdit) {
  const std::string read = EtagOf(*map.Find(thing), map.info());
  map.FindMutable(thing)->MutableTsdf({0, 0, 0}).weight[0] = 9;  // as a frame does
  map.Publish(1);
  EXPECT_NE(EtagOf(*map.Find(thing), map.info()), read);
  ASSERT_TRUE(PatchSubmap(map, thing, read, {.display_name = "lamp"}).ok());
  map.Publish(2);
  EXPECT_EQ(PatchSubmap(map, thing, read, {.display_name = "sofa"}).reason(), Reason("ETAG_MISMATCH"));
  EXPECT_EQ(CloneSubmap(map, thing, read, {}).status().reason(), Reason("ETAG_MISMATCH"));
  EXPECT_EQ(DeleteSubmap(map, thing, read).reason(), Reason("ETAG_MISMATCH"));
  EXPECT_TRUE(DeleteSubmap(map, thing, EtagOf(*map.Find(thing), map.info())).ok());
}

TEST_F(SubmapEditsTest, AnEtagBelongsToOneObjectAndACopyKeepsTheOriginals) {
  const auto copy = CloneSubmap(map, thing, "", {});
  ASSERT_TRUE(copy.ok());
  ASSERT_TRUE(PatchSubmap(map, thing, "", {.display_name = "lamp"}).ok());
  map.Publish(1);
  const std::string of_thing = EtagOf(*map.Find(thing), map.info()), of_copy = EtagOf(*map.Find(*copy), map.info());
  ASSERT_EQ(ThingInfo().revision, map.Find(*copy)->info().revision);
  EXPECT_EQ(DeleteSubmap(map, thing, of_copy).reason(), Reason("ETAG_MISMATCH"));
  ASSERT_TRUE(CloneSubmap(map, thing, of_thing, {}).ok());
  map.Publish(2);
  EXPECT_EQ(EtagOf(*map.Find(thing), map.info()), of_thing);
  EXPECT_TRUE(DeleteSubmap(map, thing, of_thing).ok());
}

TEST_F(SubmapEditsTest, AnEtagOfALostStateIsRefused) {
  const LostRevisions lost = {{ThingInfo().revision, ThingInfo().revision}};
  const std::string read = EtagOf(*map.Find(thing), map.info());
  map.FindMutable(thing)->MutableTsdf({0, 0, 0}).weight[0] = 9;
  map.Publish(1);
  EXPECT_EQ(PatchSubmap(map, thing, read, {.display_name = "x"}, lost).reason(), Reason("ETAG_MISMATCH"));
  EXPECT_EQ(CloneSubmap(map, thing, read, {}, lost).status().reason(), Reason("ETAG_MISMATCH"));
  EXPECT_EQ(DeleteSubmap(map, thing, read, lost).reason(), Reason("ETAG_MISMATCH"));
  EXPECT_TRUE(DeleteSubmap(map, thing, EtagOf(*map.Find(thing), map.info()), lost).ok());
}

TEST_F(SubmapEditsTest, AMoveDoesNotChangeVoxels) {
  SubmapPatch move{.T_map_submap = Transform::Identity()};
  move.T_map_submap->translation() = Eigen::Vector3d(3, 0, 0);
  ASSERT_TRUE(PatchSubmap(map, thing, "", move).ok());
  const auto moved = map.Publish(1);
  EXPECT_EQ(moved->Find(thing)->blocks().Find({0, 0, 0})->tsdf, snapshot->Find(thing)->blocks().Find({0, 0, 0})->tsdf);
  EXPECT_NEAR(moved->Find(thing)->BoundingSphereInMap().center_m.x(), 3.4, 1e-12);
}

TEST_F(SubmapEditsTest, FiltersSelectByClassKindAndPlace) {
  EXPECT_EQ(SelectSubmaps(*snapshot, {}).size(), 2u);
  EXPECT_EQ(SelectSubmaps(*snapshot, {.classes = std::vector{ClassId(1)}}).size(), 1u);
  EXPECT_EQ(SelectSubmaps(*snapshot, {.classes = std::vector{ClassId(0)}}).size(), 0u);  // unknown has no class
  EXPECT_EQ(SelectSubmaps(*snapshot, {.panoptic = Panoptic::kStuff}).size(), 0u);
  const auto box = [](double x) { return SubmapFilter::Box{{x, 0, 0}, {x + 1, 1, 1}}; };
  EXPECT_EQ(SelectSubmaps(*snapshot, {.region = box(0.2)}).size(), 1u);
  EXPECT_EQ(SelectSubmaps(*snapshot, {.region = box(1.05)}).size(), 1u);  // the sphere, radius 0.69, touches it
  EXPECT_EQ(SelectSubmaps(*snapshot, {.region = box(1.2)}).size(), 0u);
  EXPECT_EQ(SelectSubmaps(*snapshot, {.near = BoundingSphere{{2, 0.4, 0.4}, 1.0}}).size(), 1u);
  EXPECT_EQ(SelectSubmaps(*snapshot, {.near = BoundingSphere{{2, 0.4, 0.4}, 0.5}}).size(), 0u);
}

TEST_F(SubmapEditsTest, StatsCountTheContent) {
  const MapStats stats = ComputeStats(*snapshot, true);
  EXPECT_EQ(stats.num_submaps, 2);
  EXPECT_EQ(stats.num_things, 1);
  EXPECT_EQ(stats.num_active, 1);
  EXPECT_EQ(stats.num_tsdf_blocks, 1);
  EXPECT_EQ(stats.num_label_blocks, 0);
  EXPECT_EQ(stats.num_observed_voxels, kBlockVoxels);
  EXPECT_GT(stats.memory_bytes, kBlockVoxels * 11);
}

}  // namespace
}  // namespace dhpmap

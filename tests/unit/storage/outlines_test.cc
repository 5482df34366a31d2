// SPDX-License-Identifier: BSD-3-Clause
// Outlines of objects in their rows: there without a look at a voxel, and never of other voxels.
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <memory>

#include "mapping/paging/tile_page.h"
#include "mapping/submap/submap_outline.h"
#include "storage/rows/value.h"
#include "tests/unit/mapping/query/surface_scene.h"
#include "tests/unit/storage/any_store_fixture.h"

namespace dhpmap {
namespace {

void Observe(Submap& thing, const Eigen::Vector3d& center_m) {
  testing::ObserveBand(thing, testing::Block(center_m, {0.3, 0.2, 0.25}), testing::CubeAt(center_m, 0.6));
}

std::shared_ptr<const LevelOutline> KeptOf(const Submap& submap) {
  return submap.kept_outline().Find(submap.info().T_map_submap);
}

class OutlinesTest : public testing::AnyStoreTest {
 protected:
  OutlinesTest() : map_(testing::SceneInfo()) {
    Submap& thing = testing::AddThing(map_);
    Observe(thing, {0.1, 0.2, 0.3});
    thing.mutable_info().activity = Activity::kInactive;
    id_ = thing.id();
  }
  void Create() { ASSERT_TRUE(store_->CreateMap(*map_.Publish(1)).ok()); }
  void Commit() {
    const auto before = map_.published();
    ASSERT_TRUE(store_->Commit(*before, *map_.Publish(2), Durability::kNormal).ok());
  }
  /// As another process has it, with all voxels on the disk.
  std::shared_ptr<const MapSnapshot> Reopened() {
    Open();
    return store_->LoadMap(testing::SceneInfo().name).value();
  }
  /// In bytes; 0: not known.
  std::int64_t StoredSize() { return Query("SELECT length(outline) FROM submaps WHERE submap_id = 1"); }

  Map map_;
  SubmapId id_;
};
INSTANTIATE_TEST_SUITE_P(Stores, OutlinesTest, ::testing::ValuesIn(testing::StoresThatPage()), testing::NameOfKind);

TEST_P(OutlinesTest, OfASettledThingAreToldWithoutALookAtItsVoxels) {
  Create();
  const auto expected = FindOutline(*map_.Find(id_), Eigen::Matrix3d::Identity());
  const auto state = Reopened();
  const std::uint64_t before = CountPages().num_reads;
  const auto kept = KeptOf(*state->Find(id_));
  ASSERT_TRUE(expected && kept && kept->outline);
  EXPECT_EQ(kept->outline->box.center_m, expected->box.center_m);
  EXPECT_EQ(kept->outline->box.size_m, expected->box.size_m);
  EXPECT_EQ(kept->outline->box.yaw_rad, expected->box.yaw_rad);
  EXPECT_EQ(kept->outline->footprint_m, expected->footprint_m);
  EXPECT_EQ(kept->outline->support_height_m, expected->support_height_m);
  EXPECT_EQ(CountPages().num_reads, before);
  const auto anew = FindOutline(*state->Find(id_), Eigen::Matrix3d::Identity());
  EXPECT_GT(CountPages().num_reads, before);
  EXPECT_EQ(anew->footprint_m, kept->outline->footprint_m) << "as whoever reads the voxels finds it";
}

TEST_P(OutlinesTest, OfWhatIsStillBeingMappedAreStoredOnceItIsSettled) {
  Create();
  Observe(*map_.FindMutable(id_), {0.1, 0.7, 0.3});
  map_.FindMutable(id_)->mutable_info().activity = Activity::kActive;
  Commit();
  EXPECT_EQ(StoredSize(), 0) << "that of before is of other voxels";
  map_.FindMutable(id_)->mutable_info().activity = Activity::kInactive;
  Commit();
  const auto kept = KeptOf(*Reopened()->Find(id_));
  const auto expected = FindOutline(*map_.Find(id_), Eigen::Matrix3d::Identity());
  ASSERT_TRUE(kept && kept->outline && expected);
  EXPECT_EQ(kept->outline->footprint_m, expected->footprint_m);
}

TEST_P(OutlinesTest, StayWhereTheRowAloneIsWritten) {
  Create();
  const std::int64_t size = StoredSize();
  EXPECT_GT(size, 0);
  Map reopened(Reopened());
  const auto before = reopened.published();
  reopened.FindMutable(id_)->mutable_info().display_name = "crate";
  ASSERT_TRUE(store_->Commit(*before, *reopened.Publish(3), Durability::kNormal).ok());
  EXPECT_EQ(StoredSize(), size);
}

TEST_P(OutlinesTest, ThatDoNotMatchTheRowsChecksumAreDamage) {
  Create();
  Tamper("UPDATE submaps SET outline = x'' WHERE submap_id = 1");
  Open();
  EXPECT_EQ(store_->LoadMap(testing::SceneInfo().name).status().code(), StatusCode::kDataLoss);
}

TEST(OutlineValue, ComesBackToTheBitAndRefusesWhatIsNone) {
  const auto round = [](const std::shared_ptr<const LevelOutline>& outline) {
    std::shared_ptr<const LevelOutline> back;
    EXPECT_TRUE(FromBytes(ToBytes(outline), back));
    return back;
  };
  EXPECT_EQ(round(nullptr), nullptr);
  LevelOutline outline{.up = {0.1, -0.0, 0.9}};
  EXPECT_FALSE(round(std::make_shared<const LevelOutline>(outline))->outline);
  outline.outline = {.box = {.center_m = {1, 2, 3}, .yaw_rad = 0.5, .size_m = {4, 3, 2}},
                     .footprint_m = {{0, 0}, {1, 0}, {0, 1}},
                     .support_height_m = 0.7};
  const auto whole = std::make_shared<const LevelOutline>(outline);
  EXPECT_EQ(ToBytes(round(whole)), ToBytes(whole));
  Bytes bytes = ToBytes(whole);
  std::shared_ptr<const LevelOutline> back;
  bytes.pop_back();
  EXPECT_FALSE(FromBytes(bytes, back)) << "too short";
  bytes = ToBytes(whole);
  bytes.push_back(0);
  EXPECT_FALSE(FromBytes(bytes, back)) << "too long";
  bytes = ToBytes(whole);
  std::fill(bytes.end() - sizeof(double), bytes.end(), 0xff);
  EXPECT_FALSE(FromBytes(bytes, back)) << "not finite";
}

TEST(OutlineValue, IsWrittenAsNoneIfItIsNotFinite) {
  LevelOutline outline{.up = {0, 0, 1}, .outline = SubmapOutline{}};
  outline.outline->footprint_m = {{0, 0}, {std::numeric_limits<double>::quiet_NaN(), 0}, {0, 1}};
  EXPECT_TRUE(ToBytes(std::make_shared<const LevelOutline>(outline)).empty());
}

}  // namespace
}  // namespace dhpmap

// SPDX-License-Identifier: BSD-3-Clause
#include "server/app/states/outline_cache.h"

#include <gtest/gtest.h>

#include "mapping/base/status_error.h"
#include "mapping/paging/tile_page.h"
#include "server/app/states/map_view.h"
#include "tests/unit/mapping/query/surface_scene.h"

namespace dhpmap {
namespace {

using Reading = OutlineCache::Reading;

class OutlineCacheTest : public ::testing::Test {
 protected:
  SubmapId AddBlock(const Eigen::Vector3d& center_m) {
    Submap& submap = testing::AddThing(map_);
    testing::ObserveBand(submap, testing::Block(center_m, {0.3, 0.2, 0.25}), testing::CubeAt(center_m, 0.6));
    return submap.id();
  }
  static void ExpectAlike(const std::optional<SubmapOutline>& a, const std::optional<SubmapOutline>& b) {
    ASSERT_TRUE(a && b);
    EXPECT_TRUE(a->box.center_m.isApprox(b->box.center_m, 1e-9));
    EXPECT_TRUE(a->box.size_m.isApprox(b->box.size_m, 1e-9));
    EXPECT_NEAR(a->box.yaw_rad, b->box.yaw_rad, 1e-9);
    EXPECT_EQ(a->footprint_m.size(), b->footprint_m.size());
  }

  Map map_{testing::SceneInfo()};
  OutlineCache cache_;
};

TEST_F(OutlineCacheTest, ReusesOutlinesOfMovedTurnedRenamedAndClonedObjects) {
  const SubmapId id = AddBlock({0.1, 0.2, 0.3});
  const auto before = map_.Publish(0);
  ExpectAlike(cache_.Find(*before->Find(id), Reading::kAllowed), OutlineInMap(*before->Find(id)));
  EXPECT_EQ(cache_.size(), 1u);
  const Transform motion(Eigen::Translation3d(1, 2, 3) * Eigen::AngleAxisd(0.4, Eigen::Vector3d::UnitZ()));
  map_.FindMutable(id)->mutable_info().T_map_submap = motion;
  map_.FindMutable(id)->mutable_info().display_name = "crate";
  const SubmapId copy = map_.Clone(id)->id();
  const auto after = map_.Publish(1);
  for (const SubmapId moved : {id, copy}) {
    ExpectAlike(cache_.Find(*after->Find(moved), Reading::kAllowed), OutlineInMap(*after->Find(moved)));
  }
  EXPECT_EQ(cache_.size(), 1u);
}

TEST_F(OutlineCacheTest, RecomputesOutlinesOfWrittenOrTiltedObjects) {
  const SubmapId id = AddBlock({0.1, 0.2, 0.3});
  const auto before = map_.Publish(0);
  (void)cache_.Find(*before->Find(id), Reading::kAllowed);
  const Eigen::Vector3d beside(0.1, 0.6, 0.3);
  testing::ObserveBand(*map_.FindMutable(id), testing::Block(beside, {0.3, 0.2, 0.25}), testing::CubeAt(beside, 0.4));
  const auto written = map_.Publish(1);
  ExpectAlike(cache_.Find(*written->Find(id), Reading::kAllowed), OutlineInMap(*written->Find(id)));
  EXPECT_EQ(cache_.size(), 2u);
  map_.FindMutable(id)->mutable_info().T_map_submap = Transform(Eigen::AngleAxisd(0.5, Eigen::Vector3d::UnitX()));
  const auto tilted = map_.Publish(2);
  ExpectAlike(cache_.Find(*tilted->Find(id), Reading::kAllowed), OutlineInMap(*tilted->Find(id)));
  EXPECT_EQ(cache_.size(), 3u);
  ExpectAlike(cache_.Find(*before->Find(id), Reading::kAllowed), OutlineInMap(*before->Find(id)));
  EXPECT_EQ(cache_.size(), 3u);
}

TEST_F(OutlineCacheTest, KeepsTheMostRecentlyUsed) {
  OutlineCache small(2);
  std::vector<SubmapId> ids;
  for (int i = 0; i < 3; ++i) ids.push_back(AddBlock({1.0 * i, 0, 0}));
  const auto state = map_.Publish(0);
  for (const SubmapId id : ids) (void)small.Find(*state->Find(id), Reading::kAllowed);
  EXPECT_EQ(small.size(), 2u);
  ExpectAlike(small.Find(*state->Find(ids[0]), Reading::kAllowed), OutlineInMap(*state->Find(ids[0])));
  EXPECT_EQ(small.size(), 2u);
}

TEST_F(OutlineCacheTest, IsSharedByAllViewsOfAMap) {
  const SubmapId id = AddBlock({0.1, 0.2, 0.3});
  const MapView first(map_.Publish(0));
  (void)first.OutlineInMap(*first.snapshot().Find(id), Reading::kAllowed);
  map_.FindMutable(id)->mutable_info().display_name = "crate";
  const MapView second(map_.Publish(1), &first);
  ExpectAlike(second.OutlineInMap(*second.snapshot().Find(id), Reading::kNever),
              first.OutlineInMap(*first.snapshot().Find(id), Reading::kNever));
}

/// Blocks on a disk; reading them fails.
class UnreadableSource final : public TileSource {
 public:
  Result<std::vector<BlockEntry>> Read(const TileOnDisk&) override { return DataLoss("was read"); }
};

TEST_F(OutlineCacheTest, NeverReadsForbiddenTiles) {
  Submap submap({.id = SubmapId(1), .panoptic = Panoptic::kThing, .voxel_size_m = 0.05}, 1);
  const TileOnDisk there{.index = {0, 0, 0}, .cells = {1, 0, 0}, .keys = {1, 0, 0}};
  submap.PutTile({0, 0, 0}, std::make_shared<BlockTile>(
                                std::make_shared<const TilePage>(there, std::make_shared<UnreadableSource>())));
  EXPECT_FALSE(cache_.Find(submap, Reading::kNever));
  EXPECT_EQ(cache_.size(), 0u);
  EXPECT_THROW((void)cache_.Find(submap, Reading::kAllowed), StatusError);
}

TEST_F(OutlineCacheTest, ReturnsStoredExtentsOfObjectsOnDisk) {
  const SubmapId id = AddBlock({0.1, 0.2, 0.3});
  const auto known = FindLevelOutline(*map_.Find(id));
  Submap submap({.id = SubmapId(1), .panoptic = Panoptic::kThing, .voxel_size_m = 0.05}, 1);
  const TileOnDisk there{.index = {0, 0, 0}, .cells = {1, 0, 0}, .keys = {1, 0, 0}};
  submap.PutTile({0, 0, 0}, std::make_shared<BlockTile>(
                                std::make_shared<const TilePage>(there, std::make_shared<UnreadableSource>())));
  submap.kept_outline().Keep(known);
  ExpectAlike(cache_.Find(submap, Reading::kNever), known->outline);
}

}  // namespace
}  // namespace dhpmap

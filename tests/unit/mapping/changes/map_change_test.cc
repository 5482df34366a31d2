// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/changes/map_change.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <numbers>
#include <random>
#include <set>

#include "mapping/submap/observed_sphere.h"
#include "tests/unit/mapping/query/surface_scene.h"

namespace dhpmap {
namespace {

/// A map with one object.
class MapChangeTest : public ::testing::Test {
 protected:
  MapChangeTest() {
    SubmapInfo info;
    info.voxel_size_m = 0.1;
    info.truncation_m = 0.2;
    id_ = map_.Create(info).id();
    Write({0, 0, 0});
    map_.Publish(1);
  }
  void Write(BlockIndex index) { map_.FindMutable(id_)->MutableTsdf(index).weight[0] = 1; }
  SubmapEvent EventOf(const std::function<void()>& write) {
    const auto before = map_.published();
    write();
    const auto after = map_.Publish(2);
    const MapChange change = DescribeChange(*before, *after, DiffTiles(*before, *after));
    EXPECT_EQ(change.submaps.size(), 1u);
    return change.submaps.empty() ? SubmapEvent() : change.submaps[0];
  }

  Map map_{MapInfo()};
  SubmapId id_;
};

TEST_F(MapChangeTest, TilesInARowAreOneBox) {
  const SubmapEvent event = EventOf([this] {
    for (int x = -9; x < 13; ++x) Write({x, 1, 2});
    Write({0, 40, 0});
  });
  EXPECT_EQ(event.tiles, (std::vector<TileBox>{{{-3, 0, 0}, {3, 0, 0}}, {{0, 10, 0}, {0, 10, 0}}}));
  EXPECT_TRUE(event.parts.Has(SubmapPart::kGeometry));
}

TEST_F(MapChangeTest, BoxesHoldEveryTileThatChangedAndTooManyBecomeOne) {
  std::mt19937 random(5);
  for (const int count : {1, 10, 31, 200}) {
    std::set<TileIndex> written;
    const SubmapEvent event = EventOf([&] {
      for (int n = 0; n < count; ++n) {
        const auto at = [&] { return static_cast<int>(random() % 200) - 100; };
        const BlockIndex index{at(), at(), at()};
        Write(index);
        written.insert(TileOf(index));
      }
    });
    for (const TileIndex& tile : written) {
      EXPECT_TRUE(std::any_of(event.tiles.begin(), event.tiles.end(), [&](const TileBox& box) {
        return box.low.x <= tile.x && tile.x <= box.high.x && box.low.y <= tile.y && tile.y <= box.high.y &&
               box.low.z <= tile.z && tile.z <= box.high.z;
      }));
    }
    EXPECT_LE(event.tiles.size(), count > 100 ? 1u : written.size());
  }
}

TEST_F(MapChangeTest, SaysHowTheSubmapIsNowAndWhereItWas) {
  const auto before = map_.Find(id_)->BoundingSphereInMap();
  const SubmapEvent event = EventOf([this] {
    Submap& submap = *map_.FindMutable(id_);
    submap.mutable_info().T_map_submap.translation() = Eigen::Vector3d(5, 0, 0);
    submap.MutableTsdf({3, 0, 0}).weight[7] = 2;
    submap.UpdateBoundingSphere();
  });
  EXPECT_EQ(event.num_blocks, 2);
  EXPECT_EQ(event.observed.center_m, SphereOfObservedInMap(*map_.Find(id_)).center_m);
  EXPECT_EQ(event.info.revision, map_.published()->revision());
  ASSERT_TRUE(event.before.has_value());
  EXPECT_EQ(event.before->sphere.center_m, before.center_m);
  EXPECT_EQ(event.parts, SubmapParts({SubmapPart::kPose, SubmapPart::kGeometry}));
}

TEST_F(MapChangeTest, AMoveTellsTheBoxesBeforeAndAfterAndOtherEventsNone) {
  const Eigen::Vector3d center(3, 1, 2);
  const testing::SolidDistance block = testing::Block(center, {0.4, 0.2, 0.3});
  EXPECT_FALSE(EventOf([&] {
                 Submap& submap = *map_.FindMutable(id_);
                 submap.EraseBlock({0, 0, 0});
                 submap.mutable_info().voxel_size_m = testing::kSceneVoxel_m;
                 testing::ObserveBand(submap, block, testing::CubeAt(center, 0.7));
               }).pose_boxes);
  const SubmapEvent event = EventOf([this] {
    map_.FindMutable(id_)->mutable_info().T_map_submap =
        Transform(Eigen::Translation3d(10, 0, 0.5) * Eigen::AngleAxisd(std::numbers::pi / 2, Eigen::Vector3d::UnitZ()));
  });
  ASSERT_TRUE(event.pose_boxes);
  EXPECT_LT((event.pose_boxes->before_m.center() - center).norm(), 0.03);
  EXPECT_LT((event.pose_boxes->before_m.sizes() - Eigen::Vector3d(0.8, 0.4, 0.6)).cwiseAbs().maxCoeff(), 0.05);
  EXPECT_LT((event.pose_boxes->after_m.center() - Eigen::Vector3d(9, 3, 2.5)).norm(), 0.03);
  EXPECT_LT((event.pose_boxes->after_m.sizes() - Eigen::Vector3d(0.4, 0.8, 0.6)).cwiseAbs().maxCoeff(), 0.05);
  EXPECT_FALSE(EventOf([this] { map_.FindMutable(id_)->mutable_info().display_name = "crate"; }).pose_boxes);
}

}  // namespace
}  // namespace dhpmap

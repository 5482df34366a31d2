// SPDX-License-Identifier: BSD-3-Clause
#include "server/app/map_view.h"

#include <gtest/gtest.h>

#include <memory>
#include <thread>
#include <vector>

namespace dhpmap {
namespace {

MapInfo RoomInfo() {
  MapInfo info;
  info.name = "room";
  return info;
}

/// Some submaps of a few voxels each, one of them empty.
std::shared_ptr<const MapSnapshot> Made() {
  Map map(RoomInfo());
  for (int i = 0; i < 5; ++i) {
    SubmapInfo info;
    info.voxel_size_m = 0.1;
    info.T_map_submap.translation() = Eigen::Vector3d(i, 0, 0);
    Submap& submap = map.Create(info);
    for (int voxel = 0; voxel < 3 * i; ++voxel) submap.MutableTsdf({voxel, i, 0}).weight[7 * voxel] = 1;
  }
  return map.Publish(0);
}

TEST(MapView, KeepsTheSpheresThatItWasAskedForWhoeverAsks) {
  const MapView view(Made());
  const auto expect_all = [&view] {
    for (int round = 0; round < 3; ++round) {
      for (const auto& submap : view.snapshot().submaps()) {
        const BoundingSphere seen = view.ObservedSphereInMap(*submap), expected = SphereOfObservedInMap(*submap);
        EXPECT_EQ(seen.IsEmpty(), expected.IsEmpty());
        EXPECT_EQ(seen.center_m, expected.center_m);
        EXPECT_EQ(seen.radius_m, expected.radius_m);
      }
    }
  };
  std::vector<std::thread> threads;
  for (int i = 0; i < 4; ++i) threads.emplace_back(expect_all);
  for (std::thread& thread : threads) thread.join();
}

TEST(MapView, GoesOnWithTheIndexOfTheViewBefore) {
  Map map(RoomInfo());
  for (int i = 0; i < 12; ++i) {
    SubmapInfo info;
    info.voxel_size_m = 0.1;
    info.T_map_submap.translation() = Eigen::Vector3d(i, 0, 0);
    map.Create(info).MutableTsdf({0, 0, 0}).weight[0] = 1;
    map.FindMutable(map.submaps().back()->id())->UpdateBoundingSphere();
  }
  auto before = std::make_unique<const MapView>(map.Publish(0));
  const SubmapId moved = map.submaps().back()->id();
  EXPECT_EQ(before->lookup().At({11.05, 0.05, 0.05}).submap, moved);
  map.FindMutable(moved)->mutable_info().T_map_submap.translation().y() = 2;
  const MapView not_asked(map.Publish(1), before.get());
  before.reset();
  map.FindMutable(moved)->mutable_info().T_map_submap.translation().y() = 3;
  const MapView after(map.Publish(2), &not_asked), fresh(after.shared_snapshot());
  EXPECT_EQ(after.lookup().index().num_replaced(), 1u) << "though nobody asked the view between";
  EXPECT_EQ(fresh.lookup().index().num_replaced(), 0u);
  for (const MapView* view : {&after, &fresh}) {
    EXPECT_EQ(view->lookup().At({11.05, 3.05, 0.05}).submap, moved);
    EXPECT_FALSE(view->lookup().At({11.05, 0.05, 0.05}).is_observed);
    EXPECT_TRUE(view->lookup().At({5.05, 0.05, 0.05}).is_observed);
  }
}

}  // namespace
}  // namespace dhpmap

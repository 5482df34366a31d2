// SPDX-License-Identifier: BSD-3-Clause
#include "server/app/map_view.h"

#include <gtest/gtest.h>

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

}  // namespace
}  // namespace dhpmap

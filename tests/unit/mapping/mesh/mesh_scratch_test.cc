// SPDX-License-Identifier: BSD-3-Clause
// What meshes are made with is counted, and given back.
#include <gtest/gtest.h>

#include <cstddef>
#include <memory>
#include <stop_token>
#include <thread>
#include <utility>
#include <vector>

#include "mapping/base/memory_count.h"
#include "mapping/mesh/map_mesh.h"
#include "mapping/mesh/mesh_stream.h"
#include "mapping/mesh/surface_extractor.h"
#include "mapping/mesh/surface_field.h"
#include "mapping/mesh/tile_surface.h"
#include "tests/unit/mapping/mesh/solid_submap.h"

namespace dhpmap {
namespace {

constexpr std::size_t kBlocksOfOne = 4 * 4 * 4;

std::size_t MeshingNow() { return CountOf(MemoryKind::kMeshing).now_bytes(); }

std::shared_ptr<const Submap> Ball(std::uint32_t id) {
  Submap ball = testing::SolidSubmap(testing::Sphere({0.01, 0.02, 0.03}, 0.6), {-2, -2, -2}, {1, 1, 1});
  ball.mutable_info().id = SubmapId(id);
  return std::make_shared<const Submap>(std::move(ball));
}

/// The same ball so many times, in the same place.
std::shared_ptr<const MapSnapshot> MapOfBalls(std::uint32_t count) {
  MapInfo info;
  info.name = "map";
  info.config.voxel_size_m = testing::kVoxel_m;
  std::vector<std::shared_ptr<const Submap>> balls;
  for (std::uint32_t id = 1; id <= count; ++id) balls.push_back(Ball(id));
  return std::make_shared<const MapSnapshot>(std::move(info), std::move(balls));
}

TEST(MeshScratch, IsCountedWhileAStreamIsReadAndZeroAfterwards) {
  ASSERT_EQ(MeshingNow(), 0u);
  {
    MeshStream stream(MapOfBalls(1), nullptr, MeshColoring::kClass);
    const std::size_t counted = MeshingNow();
    EXPECT_GE(counted, kBlocksOfOne * (sizeof(BlockEntry) + sizeof(BlockHolder)));
    EXPECT_LE(counted, kBlocksOfOne * std::size_t{4096}) << "no voxels are copied";
    MeshStream moved(std::move(stream));
    EXPECT_EQ(MeshingNow(), counted);
    Mesh piece;
    while (moved.NextVertices(piece)) {
      EXPECT_EQ(MeshingNow(), counted);
    }
    EXPECT_EQ(MeshingNow(), counted);
  }
  EXPECT_EQ(MeshingNow(), 0u);
  EXPECT_GT(CountOf(MemoryKind::kMeshing).most_bytes(), 0u);
}

TEST(MeshScratch, CopiesOfBlocksThatSeveralHaveAreInIt) {
  std::size_t of_one = 0;
  {
    const MeshStream stream(MapOfBalls(1), nullptr, MeshColoring::kClass);
    of_one = MeshingNow();
  }
  const MeshStream stream(MapOfBalls(2), nullptr, MeshColoring::kClass);
  EXPECT_GE(MeshingNow(), of_one + kBlocksOfOne * (sizeof(TsdfBlock) + kBlockVoxels * sizeof(std::uint16_t)));
}

TEST(MeshScratch, IsZeroAfterAWholeMesh) {
  for (const int num_threads : {1, 3}) {
    ThreadPool pool(num_threads);
    EXPECT_FALSE(ExtractMapMesh(*MapOfBalls(2), MeshColoring::kSensor, pool).triangles.empty());
    EXPECT_EQ(MeshingNow(), 0u);
  }
}

TEST(MeshScratch, IsZeroWhereItIsStoppedInTheMiddle) {
  std::stop_source stop;
  stop.request_stop();
  const auto map = MapOfBalls(2);
  const std::vector<const Submap*> submaps = {map->submaps()[0].get(), map->submaps()[1].get()};
  const LabelSet no_labels;
  ThreadPool pool(2);
  {
    const SurfaceField field(submaps, pool);
    const std::size_t of_field = MeshingNow();
    EXPECT_GT(of_field, 0u);
    {
      const SurfaceExtractor surface(field, no_labels, MeshColoring::kClass, pool, stop.get_token());
      EXPECT_GT(MeshingNow(), of_field);
    }
    EXPECT_EQ(MeshingNow(), of_field);
  }
  EXPECT_EQ(MeshingNow(), 0u);
  const MeshStream stream(map, nullptr, MeshColoring::kClass, stop.get_token());
  EXPECT_EQ(MeshingNow(), 0u) << "of a mesh that nobody waits for nothing is kept";
}

TEST(MeshScratch, RoomForTilesIsTheThreadsAndGoesWithIt) {
  const std::size_t before = CountOf(MemoryKind::kTileRooms).now_bytes();
  std::size_t meanwhile = 0;
  const auto ball = Ball(1);
  std::thread thread([&] {
    const TileIndex tile = ball->blocks().tiles()[0].index;
    const TileBlocks blocks = FindBlocks(FindNeighbourhood(ball->blocks(), tile), tile);
    (void)ExtractTileSurface(blocks, testing::kVoxel_m);
    meanwhile = CountOf(MemoryKind::kTileRooms).now_bytes();
  });
  thread.join();
  constexpr std::size_t kVoxels = std::size_t{34} * 34 * 34;
  EXPECT_GE(meanwhile, before + kVoxels * sizeof(float));
  EXPECT_EQ(CountOf(MemoryKind::kTileRooms).now_bytes(), before);
}

}  // namespace
}  // namespace dhpmap

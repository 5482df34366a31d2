// SPDX-License-Identifier: BSD-3-Clause
#include "server/app/queries/mesh_export.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <memory>
#include <optional>
#include <stop_token>
#include <string>
#include <utility>
#include <vector>

#include "mapping/base/memory_count.h"
#include "mapping/io/pcd.h"
#include "mapping/io/ply.h"
#include "mapping/mesh/map_mesh.h"
#include "tests/unit/mapping/mesh/solid_submap.h"

namespace dhpmap {
namespace {

/// A plane in one block; submap `id` owns the columns x in [begin, end).
std::shared_ptr<const Submap> Strip(std::uint32_t id, int begin, int end) {
  Submap submap = testing::SolidSubmap([](const Eigen::Vector3d& p) { return p.z() - 0.2; }, {0, 0, 0}, {0, 0, 0});
  submap.mutable_info().id = SubmapId(id);
  TsdfBlock& tsdf = submap.MutableTsdf({0, 0, 0});
  for (int i = 0; i < kBlockVoxels; ++i) {
    const int x = VoxelIn({0, 0, 0}, i).x;
    if (x < begin || x >= end) tsdf.weight[static_cast<std::size_t>(i)] = 0;
  }
  return std::make_shared<const Submap>(std::move(submap));
}

std::shared_ptr<const MapSnapshot> MapOfTwoStrips() {
  MapInfo info;
  info.config.voxel_size_m = testing::kVoxel_m;
  return std::make_shared<const MapSnapshot>(
      info, std::vector<std::shared_ptr<const Submap>>{Strip(1, 0, 4), Strip(2, 4, 8)});
}

/// The whole file; checks its announced size.
std::string ReadAll(Result<MeshFile> file) {
  EXPECT_TRUE(file.ok());
  std::string bytes, piece;
  while (file->Next(piece)) bytes += piece;
  EXPECT_EQ(bytes.size(), file->num_bytes());
  return bytes;
}

/// Faces of the PLY file; -1 after an error.
int NumFaces(std::optional<SubmapId> submap) {
  auto file = ExportMesh(MapOfTwoStrips(), {.submap = submap, .coloring = MeshColoring::kClass});
  if (!file.ok()) return -1;
  const std::string bytes = ReadAll(std::move(file));
  const std::string key = "element face ";
  const std::size_t at = bytes.find(key);
  return at == std::string::npos ? -1 : std::stoi(bytes.substr(at + key.size()));
}

TEST(ExportMesh, WholeMapHasNoGapBetweenSubmaps) { EXPECT_EQ(NumFaces(std::nullopt), 2 * 7 * 7); }

TEST(ExportMesh, OneSubmapIsMeshedByItself) {
  EXPECT_EQ(NumFaces(SubmapId(1)), 2 * 3 * 7);
  EXPECT_EQ(NumFaces(SubmapId(2)), 2 * 3 * 7);
  EXPECT_EQ(NumFaces(SubmapId(3)), -1);
}

TEST(ExportMesh, WritesTheRequestedFormat) {
  EXPECT_EQ(ReadAll(ExportMesh(MapOfTwoStrips(), {.format = MeshFormat::kPly})).substr(0, 4), "ply\n");
  auto pcd = ExportMesh(MapOfTwoStrips(), {.format = MeshFormat::kPcd});
  ASSERT_TRUE(pcd.ok());
  EXPECT_EQ(pcd->format(), MeshFormat::kPcd);
  EXPECT_NE(ReadAll(std::move(pcd)).find("VERSION"), std::string::npos);
  EXPECT_EQ(ExportMesh(MapOfTwoStrips(), {.submap = SubmapId(3)}).status().reason(), Reason("SUBMAP_NOT_FOUND"));
}

TEST(ExportMesh, EqualsTheFileOfTheWholeMesh) {
  const auto map = MapOfTwoStrips();
  ThreadPool here(1);
  const Mesh mesh = ExtractMapMesh(*map, MeshColoring::kInstance, here);
  const MeshRequest as_ply{.coloring = MeshColoring::kInstance};
  const MeshRequest as_pcd{.coloring = MeshColoring::kInstance, .format = MeshFormat::kPcd};
  EXPECT_TRUE(ReadAll(ExportMesh(map, as_ply)) == WritePly(mesh));
  EXPECT_TRUE(ReadAll(ExportMesh(map, as_pcd)) == *WritePcd(mesh));
}

TEST(ExportMesh, EndsWhenCancelled) {
  std::stop_source stop;
  stop.request_stop();
  EXPECT_EQ(ExportMesh(MapOfTwoStrips(), {}, stop.get_token()).status().code(), StatusCode::kCancelled);
}

TEST(BytesOfExport, GrowsWithTheMeshedBlocks) {
  const auto map = MapOfTwoStrips();
  const std::size_t one = BytesOfExport(*map, {.submap = SubmapId(1)});
  EXPECT_GT(one, sizeof(TsdfBlock) / 10);
  EXPECT_EQ(one, BytesOfExport(*map, {.submap = SubmapId(2)}));
  EXPECT_GE(BytesOfExport(*map, {}), 2 * one + sizeof(TsdfBlock)) << "with a merged copy of the block that both have";
  EXPECT_EQ(BytesOfExport(*map, {.submap = SubmapId(3)}), 0u);
}

TEST(ExportMesh, MemoryOfAFileIsCountedOnceAcrossBothCounts) {
  const auto meshing = [] { return CountOf(MemoryKind::kMeshing).now_bytes(); };
  const auto reserved = [] { return CountOf(MemoryKind::kReserved).now_bytes(); };
  const auto map = MapOfTwoStrips();
  ASSERT_EQ(meshing(), 0u);
  {
    auto file = ExportMesh(map, {});
    ASSERT_TRUE(file.ok());
    EXPECT_EQ(reserved(), BytesOfExport(*map, {}));
    const std::size_t before_piece = meshing();
    EXPECT_GT(before_piece, 0u);
    EXPECT_LE(before_piece, BytesOfExport(*map, {})) << "more than its room";
    std::string piece;
    ASSERT_TRUE(file->Next(piece));  // the head
    ASSERT_TRUE(file->Next(piece));
    EXPECT_GE(meshing(), before_piece + std::size_t{64} * sizeof(Eigen::Vector3f)) << "the vertices in hand";
  }
  EXPECT_EQ(meshing(), 0u);
  EXPECT_EQ(reserved(), 0u);
  std::stop_source stop;
  stop.request_stop();
  EXPECT_EQ(ExportMesh(map, {}, stop.get_token()).status().code(), StatusCode::kCancelled);
  EXPECT_EQ(meshing() + reserved(), 0u);
}

}  // namespace
}  // namespace dhpmap

// SPDX-License-Identifier: BSD-3-Clause
#include "server/grpc/submap_chunks.h"

#include <gtest/gtest.h>

#include <string>

#include "tests/unit/mapping/mesh/solid_submap.h"

namespace dhpmap {
namespace {

/// One level of a plane in one block, of which submap `id` owns the columns x in [begin, end).
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

MapSnapshot MapOfTwoStrips() {
  MapInfo info;
  info.config.voxel_size_m = testing::kVoxel_m;
  return MapSnapshot(info, {Strip(1, 0, 4), Strip(2, 4, 8)});
}

/// Of the PLY file; -1 if it cannot be had.
int NumFaces(std::optional<SubmapId> submap) {
  auto next = StreamMesh(MapOfTwoStrips(), submap, v1::PLY, v1::BY_CLASS);
  std::string file;
  if (!next.ok()) return -1;
  for (v1::GetSubmapMeshResponse part; (*next)(part); part.Clear()) file += part.data();
  const std::string key = "element face ";
  const std::size_t at = file.find(key);
  return at == std::string::npos ? -1 : std::stoi(file.substr(at + key.size()));
}

TEST(StreamMesh, WholeMapHasNoGapBetweenSubmaps) { EXPECT_EQ(NumFaces(std::nullopt), 2 * 7 * 7); }

TEST(StreamMesh, OneSubmapIsMeshedByItself) {
  EXPECT_EQ(NumFaces(SubmapId(1)), 2 * 3 * 7);
  EXPECT_EQ(NumFaces(SubmapId(2)), 2 * 3 * 7);
  EXPECT_EQ(NumFaces(SubmapId(3)), -1);
}

}  // namespace
}  // namespace dhpmap

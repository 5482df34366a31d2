// SPDX-License-Identifier: BSD-3-Clause
#include "server/wire/bulk_chunks.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <memory>
#include <string>

#include "tests/unit/mapping/mesh/solid_submap.h"

namespace dhpmap {
namespace {

constexpr std::size_t kMaxMessageBytes = 256 * 1024;

/// Submap 1 holds a plane over 8 x 8 x 4 blocks, submap 2 nothing.
std::shared_ptr<const MapSnapshot> Slab() {
  Submap slab = testing::SolidSubmap([](const Eigen::Vector3d& p) { return p.z() - 0.2; }, {0, 0, 0}, {7, 7, 3});
  slab.mutable_info().id = SubmapId(1);
  SubmapInfo info;
  info.id = SubmapId(2);
  info.voxel_size_m = testing::kVoxel_m;
  MapInfo map;
  map.config.voxel_size_m = testing::kVoxel_m;
  map.revision = 7;
  return std::make_shared<const MapSnapshot>(
      map, std::vector<std::shared_ptr<const Submap>>{std::make_shared<const Submap>(std::move(slab)),
                                                      std::make_shared<const Submap>(info, 1)});
}

std::int64_t NumObserved(const Submap& submap, double limit_m) {
  std::int64_t count = 0;
  for (const BlockEntry& entry : submap.blocks().entries()) {
    for (int i = 0; i < kBlockVoxels; ++i) {
      if (!entry.tsdf->IsObserved(i)) continue;
      count += limit_m == 0 || std::abs(entry.tsdf->distance_m[static_cast<std::size_t>(i)]) <= limit_m ? 1 : 0;
    }
  }
  return count;
}

TEST(VoxelChunks, ContainEveryVoxelWithinTheLimitInMessagesOfBoundedSize) {
  const auto snapshot = Slab();
  for (const double limit_m : {0.0, testing::kVoxel_m}) {
    auto walk = VoxelWalk::Begin(snapshot, SubmapId(1), limit_m);
    ASSERT_TRUE(walk.ok());
    VoxelChunks chunks(std::move(*walk));
    std::int64_t num_voxels = 0;
    int num_messages = 0;
    for (v1::StreamSubmapVoxelsResponse message; chunks.Next(message); message.Clear()) {
      ++num_messages;
      EXPECT_LE(message.ByteSizeLong(), kMaxMessageBytes);
      EXPECT_EQ(message.revision(), 7);
      EXPECT_EQ(message.xyz_m_size(), 3 * message.tsdf_m_size());
      EXPECT_EQ(message.rgb().size(), 3 * static_cast<std::size_t>(message.tsdf_m_size()));
      num_voxels += message.tsdf_m_size();
    }
    EXPECT_EQ(num_voxels, NumObserved(*snapshot->Find(SubmapId(1)), limit_m));
    EXPECT_GT(num_messages, limit_m == 0 ? 1 : 0);
  }
}

TEST(VoxelChunks, OfAnEmptySubmapAreOneMessageWithTheRevision) {
  auto walk = VoxelWalk::Begin(Slab(), SubmapId(2), 0);
  ASSERT_TRUE(walk.ok());
  VoxelChunks chunks(std::move(*walk));
  v1::StreamSubmapVoxelsResponse message;
  EXPECT_TRUE(chunks.Next(message));
  EXPECT_EQ(message.revision(), 7);
  EXPECT_EQ(message.tsdf_m_size(), 0);
  EXPECT_FALSE(chunks.Next(message));
}

TEST(VoxelWalk, RefusesInvalidRequests) {
  EXPECT_EQ(VoxelWalk::Begin(Slab(), SubmapId(3), 0).status().reason(), Reason("SUBMAP_NOT_FOUND"));
  for (const double limit_m : {-1.0, std::nan(""), std::numeric_limits<double>::infinity()}) {
    EXPECT_EQ(VoxelWalk::Begin(Slab(), SubmapId(1), limit_m).status().reason(), Reason("BAD_DISTANCE")) << limit_m;
  }
}

TEST(MeshChunks, JoinedAreTheFile) {
  const MeshRequest pcd{.submap = SubmapId(1), .format = MeshFormat::kPcd};
  std::string bytes, piece;
  auto file = ExportMesh(Slab(), pcd);
  ASSERT_TRUE(file.ok());
  while (file->Next(piece)) bytes += piece;
  ASSERT_EQ(bytes.size(), file->num_bytes());
  MeshChunks chunks(std::move(*ExportMesh(Slab(), pcd)));
  std::string received;
  int num_messages = 0;
  for (v1::GetSubmapMeshResponse message; chunks.Next(message); message.Clear()) {
    EXPECT_LE(message.ByteSizeLong(), kMaxMessageBytes);
    EXPECT_EQ(message.revision(), 7);
    EXPECT_EQ(message.content_type(), num_messages == 0 ? "application/x-pcd" : "");
    EXPECT_EQ(message.total_bytes(), num_messages == 0 ? static_cast<std::int64_t>(bytes.size()) : 0);
    received += message.data();
    ++num_messages;
  }
  EXPECT_GE(num_messages, 2);
  EXPECT_TRUE(received == bytes);
}

TEST(MeshChunks, OfAnEmptySubmapAreTheHeaderOfAFile) {
  MeshChunks none(std::move(*ExportMesh(Slab(), {.submap = SubmapId(2)})));
  v1::GetSubmapMeshResponse message;
  EXPECT_TRUE(none.Next(message));
  EXPECT_EQ(message.content_type(), "application/x-ply");
  EXPECT_FALSE(none.Next(message));
}

TEST(MeshRequestFromProto, AcceptsKnownValuesAndNamesOthers) {
  v1::GetSubmapMeshRequest request;
  const auto plain = MeshRequestFromProto(request, SubmapId(4));
  ASSERT_TRUE(plain.ok());
  EXPECT_EQ(plain->submap, SubmapId(4));
  EXPECT_EQ(plain->format, MeshFormat::kPly);
  EXPECT_EQ(plain->coloring, MeshColoring::kSensor);
  request.set_format(v1::GetSubmapMeshRequest::PCD);
  request.set_coloring(v1::GetSubmapMeshRequest::BY_INSTANCE);
  EXPECT_EQ(MeshRequestFromProto(request, std::nullopt)->format, MeshFormat::kPcd);
  EXPECT_EQ(MeshRequestFromProto(request, std::nullopt)->coloring, MeshColoring::kInstance);
  request.set_coloring(static_cast<v1::GetSubmapMeshRequest::Coloring>(9));
  EXPECT_EQ(MeshRequestFromProto(request, std::nullopt).status().violations().at(0).field, "coloring");
  request.set_format(static_cast<v1::GetSubmapMeshRequest::Format>(9));
  EXPECT_EQ(MeshRequestFromProto(request, std::nullopt).status().violations().at(0).field, "format");
}

}  // namespace
}  // namespace dhpmap

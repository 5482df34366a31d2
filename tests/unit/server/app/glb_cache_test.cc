// SPDX-License-Identifier: BSD-3-Clause
#include "server/app/queries/glb_cache.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "server/app/queries/mesh_export.h"
#include "tests/unit/mapping/mesh/solid_submap.h"

namespace dhpmap {
namespace {

std::shared_ptr<const GlbFile> FileOf(std::size_t num_bytes) {
  return std::make_shared<const GlbFile>(GlbFile{std::string(num_bytes, 'x'), "g"});
}

TEST(GlbCache, EvictsTheLeastRecentlyUsedBeyondItsLimit) {
  GlbCache cache(100);
  const std::size_t before = CountOf(MemoryKind::kMeshing).now_bytes();
  for (const std::uint64_t name : {1u, 2u, 3u}) cache.Put(name, FileOf(30));
  EXPECT_NE(cache.Find(1), nullptr);
  cache.Put(4, FileOf(30));
  EXPECT_EQ(cache.Find(2), nullptr);
  for (const std::uint64_t name : {1u, 3u, 4u}) EXPECT_NE(cache.Find(name), nullptr) << name;
  EXPECT_EQ(cache.bytes(), 90u);
  EXPECT_EQ(CountOf(MemoryKind::kMeshing).now_bytes() - before, 90u);
}

TEST(GlbCache, CachesNeitherHugeFilesNorDuplicates) {
  GlbCache cache(100);
  cache.Put(1, FileOf(51));
  EXPECT_EQ(cache.Find(1), nullptr);
  const auto first = FileOf(50);
  cache.Put(2, first);
  cache.Put(2, FileOf(50));
  EXPECT_EQ(cache.Find(2), first);
  EXPECT_EQ(cache.bytes(), 50u);
}

/// Two distant balls, and a room that records its use.
class KeptGlb : public ::testing::Test {
 protected:
  static Submap Ball(std::uint32_t id, double x_m) {
    const int block = static_cast<int>(x_m / (kBlockSide * testing::kVoxel_m));
    Submap ball = testing::SolidSubmap(testing::Sphere({x_m, 0, 0}, 0.3), {block - 2, -2, -2}, {block + 2, 1, 1});
    ball.mutable_info().id = SubmapId(id);
    ball.UpdateBoundingSphere();
    return ball;
  }
  static std::shared_ptr<const MapSnapshot> MapOf(std::vector<Submap> submaps) {
    MapInfo info;
    info.name = "map";
    info.config.voxel_size_m = testing::kVoxel_m;
    std::vector<std::shared_ptr<const Submap>> shared;
    for (Submap& submap : submaps) shared.push_back(std::make_shared<const Submap>(std::move(submap)));
    return std::make_shared<const MapSnapshot>(info, std::move(shared));
  }
  /// The file's etag; counts in num_made_ if the file had to be made.
  std::string EtagOfOne(const std::shared_ptr<const MapSnapshot>& map, std::uint32_t id) {
    const MeshRequest request{.submap = SubmapId(id), .format = MeshFormat::kGlb};
    auto file = ExportGlb(map, request, cache_, [this](std::size_t num_bytes) {
      EXPECT_GT(num_bytes, 0u);
      ++num_made_;
      return Status::Ok();
    });
    EXPECT_TRUE(file.ok());
    std::string piece;
    bytes_.clear();
    while (file->Next(piece)) bytes_ += piece;
    EXPECT_EQ(bytes_.size(), file->num_bytes());
    EXPECT_EQ(bytes_.substr(0, 4), "glTF");
    return file->etag();
  }

  /// Object 1, requested from a newly started server by a client with files of these etags.
  Result<MeshFile> ExportWith(const std::shared_ptr<const MapSnapshot>& map, std::string held_etags) {
    GlbCache none(0);
    const MeshRequest request{.submap = SubmapId(1), .format = MeshFormat::kGlb, .held_etags = std::move(held_etags)};
    return ExportGlb(map, request, none, [this](std::size_t) {
      ++num_made_;
      return Status::Ok();
    });
  }

  GlbCache cache_{1u << 20};
  int num_made_ = 0;
  std::string bytes_;  // of the file that came last
};

TEST_F(KeptGlb, OfTheSameStateIsReused) {
  const auto map = MapOf({Ball(1, 0), Ball(2, 20)});
  const std::string etag = EtagOfOne(map, 1);
  EXPECT_EQ(EtagOfOne(map, 1), etag);
  EXPECT_EQ(num_made_, 1);
  EXPECT_NE(EtagOfOne(map, 2), etag);
  EXPECT_EQ(num_made_, 2);
  // A later state that shares both and has a new object: only files near it are made again.
  std::vector<std::shared_ptr<const Submap>> submaps(map->submaps().begin(), map->submaps().end());
  submaps.push_back(std::make_shared<const Submap>(Ball(3, 20.2)));
  const auto later = std::make_shared<const MapSnapshot>(map->info(), std::move(submaps));
  EXPECT_EQ(EtagOfOne(later, 1), etag);
  EXPECT_EQ(num_made_, 2);
  (void)EtagOfOne(later, 2);
  EXPECT_EQ(num_made_, 3);
}

/// The extras of the node of the file's only object.
std::string ExtrasIn(const std::string& bytes) {
  const std::size_t begin = bytes.find(R"("extras":)") + 9;
  return bytes.substr(begin, bytes.find('}', begin) + 1 - begin);
}

TEST_F(KeptGlb, DescribesTheObjectAndChangesWithItsDescription) {
  const auto map_with = [](const std::string& class_name, std::uint64_t num_seen) {
    Submap ball = Ball(1, 0);
    ball.mutable_info().panoptic = Panoptic::kThing;
    ball.mutable_info().class_id = ClassId(8);
    ball.mutable_info().class_counts = {{ClassId(8), num_seen}, {ClassId(9), 10}};
    MapInfo info = MapOf({})->info();
    info.label_set = std::make_shared<LabelSet>(LabelSet::Create({{.id = ClassId(8), .name = class_name}}).value());
    return std::make_shared<const MapSnapshot>(info, std::vector{std::make_shared<const Submap>(std::move(ball))});
  };
  const std::string sofa = EtagOfOne(map_with("sofa", 30), 1);
  EXPECT_EQ(ExtrasIn(bytes_), R"({"instance_id":1,"class_id":8,"class_name":"sofa","class_confidence":0.75})");
  EXPECT_NE(EtagOfOne(map_with("sofa", 40), 1), sofa);
  EXPECT_NE(EtagOfOne(map_with(R"(so"fa)", 30), 1), sofa);
  EXPECT_EQ(ExtrasIn(bytes_), R"({"instance_id":1,"class_id":8,"class_name":"so\"fa","class_confidence":0.75})");
  std::vector<Submap> nobody;
  nobody.push_back(Ball(1, 0));
  nobody[0].mutable_info().panoptic = Panoptic::kUnknown;
  EXPECT_NE(EtagOfOne(MapOf(std::move(nobody)), 1), sofa);
  EXPECT_EQ(ExtrasIn(bytes_), R"({"instance_id":1})") << "unknown";
}

TEST_F(KeptGlb, OfAnUnchangedStateIsNotModifiedWithoutMakingTheFile) {
  const std::string etag = EtagOfOne(MapOf({Ball(1, 0), Ball(2, 3)}), 1);
  const auto held = ExportWith(MapOf({Ball(1, 0), Ball(2, 3)}), "gaaaabbbb," + etag);
  ASSERT_TRUE(held.ok());
  EXPECT_TRUE(held->is_held());
  EXPECT_EQ(held->etag(), etag);
  EXPECT_EQ(num_made_, 1);
}

TEST_F(KeptGlb, OfAPossiblyChangedStateIsMadeAndComparedByItsBytes) {
  const std::string etag = EtagOfOne(MapOf({Ball(1, 0)}), 1);
  Submap renamed = Ball(1, 0);
  ++renamed.mutable_info().revision;
  const auto same = ExportWith(MapOf({std::move(renamed)}), etag);
  ASSERT_TRUE(same.ok());
  EXPECT_TRUE(same->is_held());
  EXPECT_EQ(same->etag(), etag);
  EXPECT_EQ(num_made_, 2);
  Submap grown = Ball(1, 0.15);
  ++grown.mutable_info().revision;
  const auto other = ExportWith(MapOf({std::move(grown)}), etag);
  ASSERT_TRUE(other.ok());
  EXPECT_FALSE(other->is_held());
  EXPECT_GT(other->num_bytes(), 0u);
  EXPECT_NE(other->etag(), etag);
}

TEST_F(KeptGlb, OfChangedSurroundingsIsMadeAgain) {
  const std::string etag = EtagOfOne(MapOf({Ball(1, 0), Ball(2, 0.9)}), 1);
  Submap near = Ball(2, 0.9);
  ++near.mutable_info().revision;
  (void)ExportWith(MapOf({Ball(1, 0), std::move(near)}), etag);
  EXPECT_EQ(num_made_, 2);
}

TEST_F(KeptGlb, OfAMissingSubmapOrWithoutMemoryIsAnErrorAndCachesNothing) {
  const MeshRequest none{.submap = SubmapId(7), .format = MeshFormat::kGlb};
  const auto room_for = [](std::size_t) { return Status::Ok(); };
  EXPECT_EQ(ExportGlb(MapOf({Ball(1, 0)}), none, cache_, room_for).status().reason(), Reason("SUBMAP_NOT_FOUND"));
  const MeshRequest one{.submap = SubmapId(1), .format = MeshFormat::kGlb};
  const auto no_room = [](std::size_t) { return Status(ResourceExhausted("full")); };
  EXPECT_EQ(ExportGlb(MapOf({Ball(1, 0)}), one, cache_, no_room).status().code(), StatusCode::kResourceExhausted);
  EXPECT_EQ(cache_.bytes(), 0u);
}

}  // namespace
}  // namespace dhpmap

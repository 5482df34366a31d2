// SPDX-License-Identifier: BSD-3-Clause
// Tiles that no store has as they are, left on the disk: what comes back is the same, to the bit.
#include "storage/paging/spill_file.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "mapping/base/status_error.h"
#include "mapping/changes/state_marks.h"
#include "mapping/paging/tile_page.h"
#include "mapping/paging/tile_spill.h"
#include "tests/support/diff_snapshots.h"
#include "tests/unit/storage/sqlite_fixture.h"

namespace dhpmap {
namespace {

using testing::MapGenerator;

bool IsSameToTheBit(const std::array<float, kBlockVoxels>& a, const std::array<float, kBlockVoxels>& b) {
  return std::ranges::equal(
      a, b, [](float x, float y) { return std::bit_cast<std::uint32_t>(x) == std::bit_cast<std::uint32_t>(y); });
}

void ExpectSameBlocks(const BlockTable& expected, const BlockTable& actual) {
  ASSERT_EQ(expected.size(), actual.size());
  for (const BlockEntry& entry : expected.entries()) {
    const BlockEntry* found = actual.Find(entry.index);
    ASSERT_NE(found, nullptr);
    ASSERT_EQ(entry.tsdf == nullptr, found->tsdf == nullptr);
    ASSERT_EQ(entry.labels == nullptr, found->labels == nullptr);
    ASSERT_EQ(entry.gone == nullptr, found->gone == nullptr);
    if (entry.tsdf != nullptr) {
      EXPECT_TRUE(IsSameToTheBit(entry.tsdf->distance_m, found->tsdf->distance_m));
      EXPECT_TRUE(IsSameToTheBit(entry.tsdf->weight, found->tsdf->weight));
      EXPECT_TRUE(entry.tsdf->color == found->tsdf->color);
      EXPECT_EQ(entry.tsdf->part_id.value(), found->tsdf->part_id.value());
    }
    if (entry.labels != nullptr) {
      EXPECT_TRUE(*entry.labels == *found->labels);
      EXPECT_EQ(entry.labels->part_id.value(), found->labels->part_id.value());
    }
    if (entry.gone != nullptr) {
      EXPECT_TRUE(*entry.gone == *found->gone);
    }
  }
}

bool IsOnDisk(const MapSnapshot& state) {
  for (const auto& submap : state.submaps()) {
    for (const TileEntry& entry : submap->blocks().tiles()) {
      if (entry.tile->IsRead()) return false;
    }
  }
  return true;
}

class SpillFileTest : public ::testing::Test {
 protected:
  SpillFileTest() : file_(SpillFile::Open(folder_.path().string()).value()), spill_(file_) {}
  Map MadeMap() {
    Map map(generator_.Info("m"));
    for (int n = 0; n < 4; ++n) generator_.AddSubmap(map, 20);
    map.Publish(1);
    return map;
  }

  testing::TempDir folder_;
  MapGenerator generator_{5};
  const std::shared_ptr<SpillFile> file_;
  TileSpillFile spill_;
};

TEST_F(SpillFileTest, WhatIsLeftThereIsTheSameStateWithTheSameParts) {
  Map map = MadeMap();
  const auto before = map.published();
  const StateMarks marks(*before);
  const auto same = map.EvictPages(true, &spill_);
  ASSERT_NE(same, before);
  EXPECT_EQ(same->revision(), before->revision());
  EXPECT_TRUE(IsOnDisk(*same));
  EXPECT_TRUE(DiffSnapshots(before.get(), *same).empty());
  EXPECT_TRUE(DiffTiles(marks, *same).empty());
  for (std::size_t s = 0; s < same->submaps().size(); ++s) {
    EXPECT_EQ(same->submaps()[s]->blocks().tiles().size(), before->submaps()[s]->blocks().tiles().size());
    ExpectSameBlocks(before->submaps()[s]->blocks(), same->submaps()[s]->blocks());
  }
  EXPECT_TRUE(DiffTiles(StateMarks(*same), *before).empty()) << "as it was read";
  const std::int64_t num_bytes = file_->size_bytes();
  const auto again = map.EvictPages(true, &spill_);
  EXPECT_TRUE(IsOnDisk(*again));
  EXPECT_EQ(file_->size_bytes(), num_bytes) << "it is there already";
}

TEST_F(SpillFileTest, AMapThatIsWrittenToInBetweenIsTheOneThatStaysInMemory) {
  Map map = MadeMap(), in_memory = map.Fork();
  MapGenerator same_changes(77), other_changes(77);
  for (int n = 0; n < 30; ++n) {
    SCOPED_TRACE("change " + std::to_string(n));
    same_changes.Change(map);
    other_changes.Change(in_memory);
    const auto before = map.Publish(2 + n);
    const auto expected = in_memory.Publish(2 + n);
    const auto left = map.EvictPages(n % 3 != 0, &spill_);
    ASSERT_EQ(left->submaps().size(), expected->submaps().size());
    for (std::size_t s = 0; s < left->submaps().size(); ++s) {
      const BlockTable &a = expected->submaps()[s]->blocks(), &b = left->submaps()[s]->blocks();
      ASSERT_EQ(a.size(), b.size());
      for (const BlockEntry& entry : a.entries()) {
        const BlockEntry* found = b.Find(entry.index);
        ASSERT_NE(found, nullptr);
        if (entry.tsdf != nullptr) {
          ASSERT_TRUE(IsSameToTheBit(entry.tsdf->distance_m, found->tsdf->distance_m));
          ASSERT_TRUE(IsSameToTheBit(entry.tsdf->weight, found->tsdf->weight));
        }
        if (entry.labels != nullptr) {
          ASSERT_TRUE(*entry.labels == *found->labels);
        }
      }
    }
  }
}

TEST_F(SpillFileTest, WhatWasWrittenLatelyStaysAtFirst) {
  Map map = MadeMap();
  map.mutable_info().num_frames += 1;
  map.Publish(2);
  map.FindMutable(SubmapId(1))->MutableTsdf({100, 0, 0}).weight[0] = 1;
  map.Publish(3);
  const auto left = map.EvictPages(false, &spill_);
  const TileEntry* late = left->Find(SubmapId(1))->blocks().FindTile(TileOf({100, 0, 0}));
  EXPECT_TRUE(late->tile->IsRead());
  EXPECT_FALSE(left->Find(SubmapId(2))->blocks().tiles().front().tile->IsRead());
  EXPECT_TRUE(IsOnDisk(*map.EvictPages(true, &spill_)));
}

TEST_F(SpillFileTest, WhatClonesShareIsThereOnceAndStaysShared) {
  Map map = MadeMap();
  map.EvictPages(true, &spill_);
  const std::int64_t num_bytes = file_->size_bytes();
  map.FindMutable(SubmapId(1))->MutableTsdf({0, 0, 0}).weight[0] = 5;
  const SubmapId copy = map.Clone(SubmapId(1))->id();
  map.Publish(2);
  const auto left = map.EvictPages(true, &spill_);
  const auto tiles = left->Find(SubmapId(1))->blocks().tiles();
  ASSERT_FALSE(tiles.empty());
  for (const TileEntry& entry : tiles) {
    EXPECT_FALSE(entry.tile->IsRead());
    EXPECT_EQ(entry.tile, left->Find(copy)->blocks().FindTile(entry.index)->tile);
  }
  EXPECT_LE(file_->size_bytes(), num_bytes + 10 * static_cast<std::int64_t>(SpillFile::kPageBytes)) << "one tile more";
}

TEST_F(SpillFileTest, RoomThatWasGivenBackIsUsedAgain) {
  std::int64_t most = 0;
  {
    Map map = MadeMap();
    map.EvictPages(true, &spill_);
    most = file_->size_bytes();
    EXPECT_GT(most, 0);
    for (int n = 0; n < 50; ++n) {
      for (std::uint32_t id = 1; id <= 4; ++id) {
        TsdfBlock& block = map.FindMutable(SubmapId(id))->MutableTsdf({0, 0, 0});
        block.weight[0] += 1;
      }
      map.Publish(2 + n);
      map.EvictPages(true, &spill_);
    }
    EXPECT_LE(file_->size_bytes(), 3 * most) << "those of before are given back";
  }
  EXPECT_EQ(file_->size_bytes(), 0) << "when nothing is left in it";
}

TEST_F(SpillFileTest, BytesOfAnyLengthComeBack) {
  std::vector<std::pair<Bytes, std::vector<std::uint32_t>>> written;
  for (const std::size_t size : {std::size_t{0}, std::size_t{1}, SpillFile::kPageBytes - 1, SpillFile::kPageBytes,
                                 SpillFile::kPageBytes + 1, 5 * SpillFile::kPageBytes + 77}) {
    Bytes bytes(size);
    for (std::uint8_t& byte : bytes) byte = static_cast<std::uint8_t>(generator_.Below(256));
    auto pages = file_->Write(bytes);
    ASSERT_TRUE(pages.ok());
    written.emplace_back(std::move(bytes), *std::move(pages));
  }
  file_->GiveBack(written[3].second);
  written.erase(written.begin() + 3);
  Bytes other(3 * SpillFile::kPageBytes, 9);
  auto pages = file_->Write(other);  // in the gap, and behind
  ASSERT_TRUE(pages.ok());
  written.emplace_back(std::move(other), *std::move(pages));
  for (const auto& [bytes, there] : written) {
    const auto read = file_->Read(there, bytes.size());
    ASSERT_TRUE(read.ok());
    EXPECT_EQ(*read, bytes);
  }
  const std::vector<std::uint32_t> beyond = {1000};
  EXPECT_EQ(file_->Read(beyond, 10).status().code(), StatusCode::kUnavailable);
}

TEST_F(SpillFileTest, AFolderThatIsNotThereIsAnError) {
  EXPECT_EQ(SpillFile::Open((folder_.path() / "none").string()).status().code(), StatusCode::kUnavailable);
}

/// Has no room.
class FullSpill final : public TileSpill {
 public:
  Result<std::shared_ptr<TileSource>> Write(const BlockTile&) override {
    ++num_asked;
    return ResourceExhausted("full");
  }
  [[nodiscard]] std::int64_t size_bytes() const override { return 0; }
  int num_asked = 0;
};

TEST_F(SpillFileTest, WhereThereIsNoRoomItStaysInMemory) {
  Map map = MadeMap();
  FullSpill full;
  const auto before = map.published();
  EXPECT_EQ(map.EvictPages(true, &full), before);
  EXPECT_EQ(full.num_asked, static_cast<int>(before->submaps().size() - 1)) << "once a submap, but the empty one";
}

}  // namespace
}  // namespace dhpmap

// SPDX-License-Identifier: BSD-3-Clause
// The law: whatever is done to a map, it is the same whether its voxels are in memory or in the file.
#include <array>
#include <memory>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "tests/support/eventually.h"
#include "tests/support/map_equality.h"
#include "tests/unit/storage/sqlite_fixture.h"

namespace dhpmap {
namespace {

using testing::MapsAreEqual;

std::string TextOfTiles(const std::vector<SubmapTileChange>& changes) {
  std::string text;
  for (const SubmapTileChange& change : changes) {
    text += "submap " + std::to_string(change.id.value) + (change.is_new ? " new" : "") +
            (change.after == nullptr ? " gone" : "") + (change.copy_of ? " copied" : "") + "\n";
    for (const TileChange& tile : change.tiles) {
      text +=
          "  " + std::to_string(tile.index.x) + ' ' + std::to_string(tile.index.y) + ' ' + std::to_string(tile.index.z);
      for (std::size_t i = 0; i < kNumBlockLayers; ++i) {
        text += (tile.is_written[i] ? " written " : " same ") + std::to_string(tile.num_before[i]) + ' ' +
                std::to_string(tile.num_after[i]);
      }
      text += '\n';
    }
  }
  return text;
}

/// A map in a file, which is written to again and again.
class StoredSide {
 public:
  StoredSide(bool is_paged, unsigned seed) : is_paged_(is_paged), generator_(seed) {
    OpenStore();
    map_.emplace(generator_.Info("house"));
    for (int n = 0; n < 3; ++n) generator_.AddSubmap(*map_, 12);
    EXPECT_TRUE(store_->CreateMap(*map_->Publish(1)).ok());
    Reopen();
  }

  void Reopen() {
    map_.reset();
    OpenStore();
    map_.emplace(store_->LoadMap("house").value());
    marks_ = std::make_shared<const StateMarks>(*map_->published());
  }

  /// One of the things that happen to maps, which `choice` names. Returns what the store was told of it.
  std::string Change(unsigned choice, std::int64_t time_ns) {
    const auto& submaps = map_->submaps();
    const bool is_bare = submaps.size() == 1;  // there is nothing but the unknown one
    const SubmapId id = is_bare ? kUnknownSubmap : submaps[1 + choice / 16 % (submaps.size() - 1)]->id();
    switch (is_bare ? 0 : choice % 7) {
      case 0: generator_.AddSubmap(*map_, 6); break;
      case 1: map_->Clone(id); break;
      case 2: map_->Remove(id); break;
      case 3: EraseABlock(id, choice / 256); break;
      case 4: map_->FindMutable(id)->DropLabels(); break;
      case 5: map_->FindMutable(id)->DropGone(); break;
      default: generator_.AddBlocks(*map_->FindMutable(id), 3);
    }
    map_->mutable_info().num_frames += 1;
    const auto state = map_->Publish(time_ns);
    std::string text = TextOfTiles(DiffTiles(*marks_, *state));
    const Status stored = store_->Commit(*marks_, *state, Durability::kNormal);
    EXPECT_TRUE(stored.ok()) << stored.ToString();
    marks_ = std::make_shared<const StateMarks>(*state, marks_.get());
    return text;
  }

  void EvictPages(bool even_used) { map_->EvictPages(even_used); }
  [[nodiscard]] std::shared_ptr<const MapSnapshot> state() const { return map_->published(); }

  void AwaitCollection() const {
    EXPECT_TRUE(testing::Eventually([this] {
      auto database = sqlite::Database::Open(Path(), sqlite::OpenMode::kReadOnly, 1000);
      const auto left = database.ok() ? database->QueryInt("SELECT count(*) FROM dead_blobs", "look")
                                      : Result<std::int64_t>(database.status());
      return left.ok() && *left == 0;
    }));
  }
  VerifyReport Verify() { return store_->VerifyMap("house", false, {}).value(); }

 private:
  [[nodiscard]] std::string Path() const { return (folder_.path() / "maps.db").string(); }
  void OpenStore() {
    store_ = nullptr;
    auto opened = OpenSqliteStore(Path(), {.busy_timeout_ms = 50, .pages_tiles = is_paged_});
    ASSERT_TRUE(opened.ok()) << opened.status().ToString();
    store_ = std::move(opened).value();
  }
  void EraseABlock(SubmapId id, unsigned choice) {
    Submap& submap = *map_->FindMutable(id);
    const auto tiles = submap.blocks().tiles();
    if (tiles.empty()) return;
    submap.EraseBlock(tiles[choice % tiles.size()].tile->entries().front().index);
  }

  const bool is_paged_;
  testing::TempDir folder_;
  testing::MapGenerator generator_;
  std::unique_ptr<MapStore> store_;
  std::optional<Map> map_;
  std::shared_ptr<const StateMarks> marks_;
};

TEST(PagedMap, IsWhateverHappensTheSameAsOneInMemory) {
  for (unsigned seed = 1; seed <= 4; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937 random(seed);
    StoredSide whole(false, seed), paged(true, seed);
    std::vector<std::array<std::shared_ptr<const MapSnapshot>, 2>> states;  // of before, not read
    for (int step = 0; step < 60; ++step) {
      SCOPED_TRACE("step " + std::to_string(step));
      const auto choice = static_cast<unsigned>(random());
      const std::int64_t time_ns = 100 + step;
      ASSERT_EQ(whole.Change(choice, time_ns), paged.Change(choice, time_ns));
      if (step % 3 == 0) {
        ASSERT_TRUE(MapsAreEqual(*whole.state(), *paged.state()));
        paged.EvictPages(random() % 2 == 0);
      }
      states.push_back({whole.state(), paged.state()});
      if (step % 15 != 14) continue;
      paged.AwaitCollection();  // what no row refers to is deleted by now
      for (const auto& [a, b] : states) ASSERT_TRUE(MapsAreEqual(*a, *b)) << "revision " << a->revision();
      states.clear();
      whole.Reopen();
      paged.Reopen();
    }
    EXPECT_EQ(paged.Verify().num_faults, 0);
  }
}

}  // namespace
}  // namespace dhpmap

// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/map/map.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <map>
#include <optional>
#include <random>
#include <set>

#include "tests/support/diff_snapshots.h"

namespace dhpmap {
namespace {

MapInfo Info() {
  MapInfo info;
  info.name = "m";
  return info;
}

SubmapInfo NamedThing(const std::string& name = "") {
  SubmapInfo info;
  info.panoptic = Panoptic::kThing;
  info.display_name = name;
  info.voxel_size_m = 0.04;
  return info;
}

/// All that a reader can see of a snapshot, as a deep copy.
struct DeepCopy {
  struct Layers {
    std::optional<std::array<float, kBlockVoxels>> distance_m;
    std::optional<LabelBlock> labels;
    bool operator==(const Layers&) const = default;
  };
  struct Row {
    std::string name;
    std::int64_t revision = 0;
    std::map<BlockIndex, Layers> blocks;
    bool operator==(const Row&) const = default;
  };
  std::int64_t revision = 0;
  std::map<SubmapId, Row> submaps;
  bool operator==(const DeepCopy&) const = default;

  explicit DeepCopy(const MapSnapshot& snapshot) : revision(snapshot.revision()) {
    for (const auto& submap : snapshot.submaps()) {
      Row& row = submaps[submap->id()];
      row.name = submap->info().display_name;
      row.revision = submap->info().revision;
      for (const BlockEntry& entry : submap->blocks().entries()) {
        Layers& layers = row.blocks[entry.index];
        if (entry.tsdf) layers.distance_m = entry.tsdf->distance_m;
        if (entry.labels) layers.labels = *entry.labels;
      }
    }
  }
};

/// The present state, as a reader would see it.
DeepCopy StateOf(Map& map) { return DeepCopy(*map.Freeze()); }

TEST(MapFork, GoesItsOwnWayAndIsTheStateToGoBackTo) {
  Map map(Info());
  map.Create(NamedThing("published")).MutableTsdf({0, 0, 0}).distance_m.fill(1);
  map.Create(NamedThing("removed later")).MutableLabels({0, 0, 0}).AddObservation(1, ClassId(2));
  map.Publish(0);
  map.FindMutable(SubmapId(1))->MutableTsdf({1, 0, 0}).distance_m.fill(2);
  map.Create(NamedThing("unpublished")).MutableTsdf({0, 0, 0}).distance_m.fill(3);
  const DeepCopy state = StateOf(map);

  Map before = map.Fork();
  EXPECT_EQ(StateOf(before), state);
  map.FindMutable(SubmapId(1))->MutableTsdf({1, 0, 0}).distance_m.fill(7);
  map.FindMutable(SubmapId(1))->mutable_info().display_name = "changed";
  map.FindMutable(SubmapId(3))->MutableTsdf({0, 0, 0}).distance_m.fill(8);
  map.FindMutable(SubmapId(3))->MutableTsdf({5, 5, 5}).distance_m.fill(9);
  map.Remove(SubmapId(2));
  map.Create(NamedThing("new"));
  EXPECT_EQ(StateOf(before), state) << "the writer must have copied what it wrote";

  map = std::move(before);
  EXPECT_EQ(StateOf(map), state);
  EXPECT_EQ(map.info().next_submap_id, SubmapId(4));
  map.FindMutable(SubmapId(3))->MutableTsdf({0, 0, 0}).distance_m.fill(4);
  const auto snapshot = map.Publish(1);
  EXPECT_EQ(snapshot->revision(), 2);
  EXPECT_EQ(snapshot->Find(SubmapId(1))->info().revision, 2) << "written before the fork, not yet published then";
  EXPECT_EQ(snapshot->Find(SubmapId(2))->info().revision, 1);
  EXPECT_EQ(snapshot->Find(SubmapId(3))->info().revision, 2);
}

TEST(MapFork, OfAPublishedStatePublishesNothingNew) {
  Map map(Info());
  map.Create(NamedThing());
  const auto published = map.Publish(0);
  Map fork = map.Fork();
  EXPECT_EQ(fork.Publish(1), published);
  EXPECT_EQ(map.Publish(1), published);
}

TEST(Map, StartsWithTheUnknownSubmapAlone) {
  const Map map(Info());
  ASSERT_EQ(map.submaps().size(), 1u);
  EXPECT_EQ(map.submaps()[0]->id(), kUnknownSubmap);
  EXPECT_EQ(map.submaps()[0]->info().panoptic, Panoptic::kUnknown);
  EXPECT_EQ(map.submaps()[0]->info().voxel_size_m, map.info().config.voxel_size_m);
}

TEST(Map, NeverUsesAnIdAgainAndKeepsTheUnknownSubmap) {
  Map map(Info());
  EXPECT_EQ(map.Create(NamedThing()).id(), SubmapId(1));
  EXPECT_EQ(map.Create(NamedThing()).id(), SubmapId(2));
  EXPECT_TRUE(map.Remove(SubmapId(2)));
  EXPECT_FALSE(map.Remove(SubmapId(2)));
  EXPECT_EQ(map.Create(NamedThing()).id(), SubmapId(3));
  EXPECT_EQ(map.Find(SubmapId(2)), nullptr);
  EXPECT_EQ(map.FindMutable(SubmapId(2)), nullptr);
  EXPECT_EQ(map.Clone(SubmapId(2)), nullptr);
  EXPECT_FALSE(map.Remove(kUnknownSubmap));
  EXPECT_NE(map.Find(kUnknownSubmap), nullptr);
}

TEST(Map, PublishesANewRevisionOnlyAfterAChange) {
  Map map(Info());
  const auto first = map.Publish(10);
  EXPECT_EQ(first->revision(), 1);
  EXPECT_EQ(first->info().update_time_ns, 10);
  EXPECT_EQ(map.Publish(20), first);
  map.mutable_info().display_name = "new";
  const auto second = map.Publish(30);
  EXPECT_EQ(second->revision(), 2);
  EXPECT_EQ(map.published(), second);
  EXPECT_EQ(first->info().display_name, "");
  EXPECT_NE(map.FindMutable(kUnknownSubmap), nullptr);
  EXPECT_EQ(map.Publish(40)->revision(), 3);
  map.Create(NamedThing());
  EXPECT_EQ(map.Publish(50)->revision(), 4);
  map.Remove(SubmapId(1));
  EXPECT_EQ(map.Publish(60)->revision(), 5);
}

TEST(Map, SubmapsCarryTheRevisionThatLastChangedThem) {
  Map map(Info());
  map.Create(NamedThing());
  map.Create(NamedThing());
  map.Publish(1);
  map.FindMutable(SubmapId(2))->mutable_info().display_name = "x";
  const auto second = map.Publish(2);
  EXPECT_EQ(second->Find(SubmapId(1))->info().revision, 1);
  EXPECT_EQ(second->Find(SubmapId(2))->info().revision, 2);
}

TEST(Map, ASnapshotNeverChangesWhateverIsDoneAfterIt) {
  for (unsigned seed = 0; seed < 8; ++seed) {
    std::mt19937 random(seed);
    Map map(Info());
    std::vector<std::pair<std::shared_ptr<const MapSnapshot>, DeepCopy>> history;
    for (int step = 0; step < 300; ++step) {
      const SubmapId id = map.submaps()[random() % map.submaps().size()]->id();
      const BlockIndex block{static_cast<std::int32_t>(random() % 3) - 1, 0, 0};
      switch (random() % 10) {
        case 0: map.Create(NamedThing(std::to_string(step))); break;
        case 1: map.Clone(id); break;
        case 2: map.Remove(id); break;
        case 3: map.FindMutable(id)->mutable_info().display_name = std::to_string(step); break;
        case 4: map.FindMutable(id)->EraseBlock(block); break;
        case 5: map.FindMutable(id)->DropLabels(); break;
        case 6: {
          const auto snapshot = map.Publish(step);
          history.emplace_back(snapshot, DeepCopy(*snapshot));
          if (random() % 4 == 0) map = Map(snapshot);  // as after a restart
          break;
        }
        case 7: map.FindMutable(id)->MutableLabels(block).AddObservation(step, ClassId(1)); break;
        default: map.FindMutable(id)->MutableTsdf(block).distance_m[0] = static_cast<float>(step);
      }
    }
    ASSERT_GT(history.size(), 10u);
    for (const auto& [snapshot, copy] : history) EXPECT_EQ(DeepCopy(*snapshot), copy);
  }
}

TEST(Map, PublishingCopiesOnlyWhatIsWrittenAfterIt) {
  Map map(Info());
  Submap& submap = map.Create(NamedThing());
  submap.MutableTsdf({0, 0, 0});
  submap.MutableTsdf({1, 0, 0});
  map.Create(NamedThing());
  const auto before = map.Publish(1);
  map.FindMutable(SubmapId(1))->MutableTsdf({0, 0, 0}).weight[0] = 1;
  const auto after = map.Publish(2);
  const auto block = [](const auto& snapshot, int x) {
    return snapshot->Find(SubmapId(1))->blocks().Find({x, 0, 0})->tsdf;
  };
  EXPECT_NE(block(before, 0), block(after, 0));
  EXPECT_EQ(block(before, 1), block(after, 1));
  EXPECT_EQ(before->Find(SubmapId(2)), after->Find(SubmapId(2)));
}

TEST(Map, WritesInPlaceBetweenTwoPublishes) {
  Map map(Info());
  map.Create(NamedThing()).MutableTsdf({0, 0, 0});
  map.Publish(1);
  const TsdfBlock* block = &map.FindMutable(SubmapId(1))->MutableTsdf({0, 0, 0});
  EXPECT_EQ(&map.FindMutable(SubmapId(1))->MutableTsdf({0, 0, 0}), block);
}

TEST(Map, CloningLeavesTheOriginalAndItsRevisionAsTheyAre) {
  Map map(MapInfo{});
  Submap& made = map.Create({.voxel_size_m = 0.1, .truncation_m = 0.2});
  made.MutableTsdf({0, 0, 0}).weight[0] = 1;
  const auto before = map.Publish(1);
  map.Clone(SubmapId(1));
  const auto after = map.Publish(2);
  EXPECT_EQ(after->Find(SubmapId(1)), before->Find(SubmapId(1))) << "the very same state";
  EXPECT_EQ(after->Find(SubmapId(1))->info().revision, before->revision());
  EXPECT_EQ(after->Find(SubmapId(2))->info().revision, after->revision());
  ASSERT_EQ(DiffSnapshots(before.get(), *after).size(), 1u);

  // Writing to either leaves the other, and what was published, alone.
  map.FindMutable(SubmapId(1))->MutableTsdf({0, 0, 0}).weight[0] = 2;
  map.FindMutable(SubmapId(2))->MutableTsdf({0, 0, 0}).weight[0] = 3;
  EXPECT_EQ(map.Find(SubmapId(1))->blocks().Find({0, 0, 0})->tsdf->weight[0], 2);
  EXPECT_EQ(map.Find(SubmapId(2))->blocks().Find({0, 0, 0})->tsdf->weight[0], 3);
  for (const auto& entry : {after->Find(SubmapId(1)), after->Find(SubmapId(2)), before->Find(SubmapId(1))}) {
    EXPECT_EQ(entry->blocks().Find({0, 0, 0})->tsdf->weight[0], 1);
  }
}

TEST(Map, CloneSharesBlocksThenDiverges) {
  Map map(Info());
  map.Create(NamedThing("chair")).MutableTsdf({0, 0, 0}).distance_m[0] = 1;
  map.FindMutable(SubmapId(1))->mutable_info().track_id = 77;
  const Submap* clone = map.Clone(SubmapId(1));
  ASSERT_NE(clone, nullptr);
  EXPECT_EQ(clone->id(), SubmapId(2));
  EXPECT_EQ(clone->info().display_name, "chair");
  EXPECT_EQ(clone->info().track_id, 0u) << "the front end's object is the original";
  const auto distance = [&map](std::uint32_t id) {
    return map.Find(SubmapId(id))->blocks().Find({0, 0, 0})->tsdf->distance_m[0];
  };
  EXPECT_EQ(map.Find(SubmapId(1))->blocks().Find({0, 0, 0})->tsdf, clone->blocks().Find({0, 0, 0})->tsdf);
  map.FindMutable(SubmapId(2))->MutableTsdf({0, 0, 0}).distance_m[0] = 2;
  EXPECT_EQ(distance(1), 1);
  map.FindMutable(SubmapId(1))->MutableTsdf({0, 0, 0}).distance_m[0] = 3;
  EXPECT_EQ(distance(1), 3);
  EXPECT_EQ(distance(2), 2);
}

TEST(Map, GoesOnFromASnapshotWithoutTouchingIt) {
  Map map(Info());
  map.Create(NamedThing()).MutableTsdf({0, 0, 0}).distance_m[0] = 1;
  const auto snapshot = map.Publish(1);
  Map again(snapshot);
  EXPECT_EQ(again.Publish(5), snapshot) << "nothing has changed yet";
  again.FindMutable(SubmapId(1))->MutableTsdf({0, 0, 0}).distance_m[0] = 2;
  map.FindMutable(SubmapId(1))->MutableTsdf({0, 0, 0}).distance_m[0] = 3;
  EXPECT_EQ(snapshot->Find(SubmapId(1))->blocks().Find({0, 0, 0})->tsdf->distance_m[0], 1);
  EXPECT_EQ(again.Publish(6)->revision(), 2);
  EXPECT_EQ(again.Create(NamedThing()).id(), SubmapId(2));
}

/// Brings a deep copy of `before` up to `after` with nothing but the changes.
void Apply(const std::vector<SubmapChange>& changes,
           std::map<SubmapId, std::map<BlockIndex, DeepCopy::Layers>>& state) {
  for (const SubmapChange& change : changes) {
    EXPECT_EQ(change.is_new, change.after != nullptr && !state.contains(change.id));
    if (change.after == nullptr) {
      EXPECT_EQ(state.erase(change.id), 1u);
      continue;
    }
    auto& blocks = state[change.id];
    for (const BlockEntry* entry : change.written_tsdf) blocks[entry->index].distance_m = entry->tsdf->distance_m;
    for (const BlockEntry* entry : change.written_labels) blocks[entry->index].labels = *entry->labels;
    for (const BlockIndex index : change.erased_tsdf) blocks.at(index).distance_m.reset();
    for (const BlockIndex index : change.erased_labels) blocks.at(index).labels.reset();
  }
}

std::map<SubmapId, std::map<BlockIndex, DeepCopy::Layers>> StateOf(const MapSnapshot& snapshot) {
  std::map<SubmapId, std::map<BlockIndex, DeepCopy::Layers>> state;
  for (const auto& [id, row] : DeepCopy(snapshot).submaps) state[id] = row.blocks;
  return state;
}

/// A block without layers is as good as none.
void DropEmpty(std::map<SubmapId, std::map<BlockIndex, DeepCopy::Layers>>& state) {
  for (auto& [id, blocks] : state) {
    std::erase_if(blocks, [](const auto& item) { return !item.second.distance_m && !item.second.labels; });
  }
}

TEST(DiffSnapshots, AppliedToTheStateBeforeGivesTheStateAfter) {
  for (unsigned seed = 0; seed < 8; ++seed) {
    std::mt19937 random(seed);
    Map map(Info());
    std::shared_ptr<const MapSnapshot> last;
    std::map<SubmapId, std::map<BlockIndex, DeepCopy::Layers>> state;
    for (int step = 0; step < 400; ++step) {
      const SubmapId id = map.submaps()[random() % map.submaps().size()]->id();
      const BlockIndex block{static_cast<std::int32_t>(random() % 4) - 2, 0, 0};
      switch (random() % 9) {
        case 0: map.Create(NamedThing()); break;
        case 1: map.Clone(id); break;
        case 2: map.Remove(id); break;
        case 3: map.FindMutable(id)->EraseBlock(block); break;
        case 4: map.FindMutable(id)->DropLabels(); break;
        case 5: map.FindMutable(id)->MutableLabels(block).AddObservation(step, ClassId(1)); break;
        case 6: map.FindMutable(id)->MutableTsdf(block).distance_m[0] = static_cast<float>(step); break;
        default: {
          const auto snapshot = map.Publish(step);
          Apply(DiffSnapshots(last.get(), *snapshot), state);
          auto expected = StateOf(*snapshot);
          DropEmpty(expected);
          DropEmpty(state);
          ASSERT_EQ(state, expected) << "seed " << seed << " step " << step;
          last = snapshot;
        }
      }
    }
  }
}

TEST(DiffSnapshots, NamesOnlyWhatChanged) {
  Map map(Info());
  Submap& first = map.Create(NamedThing());
  for (int x = 0; x < 3; ++x) {
    first.MutableTsdf({x, 0, 0});
    first.MutableLabels({x, 0, 0});
  }
  map.Create(NamedThing()).MutableTsdf({0, 0, 0});
  map.Create(NamedThing());
  const auto before = map.Publish(1);
  EXPECT_TRUE(DiffSnapshots(before.get(), *before).empty());

  map.FindMutable(SubmapId(1))->MutableTsdf({1, 0, 0});
  map.FindMutable(SubmapId(1))->EraseBlock({2, 0, 0});
  map.FindMutable(SubmapId(2))->mutable_info().T_map_submap.translation().x() = 1;
  map.Remove(SubmapId(3));
  const auto after = map.Publish(2);
  const auto changes = DiffSnapshots(before.get(), *after);
  ASSERT_EQ(changes.size(), 3u);
  EXPECT_EQ(changes[0].id, SubmapId(1));
  ASSERT_EQ(changes[0].written_tsdf.size(), 1u);
  EXPECT_EQ(changes[0].written_tsdf[0]->index, (BlockIndex{1, 0, 0}));
  EXPECT_TRUE(changes[0].written_labels.empty());
  EXPECT_EQ(changes[0].erased_tsdf, (std::vector<BlockIndex>{{2, 0, 0}}));
  EXPECT_EQ(changes[0].erased_labels, (std::vector<BlockIndex>{{2, 0, 0}}));
  EXPECT_EQ(changes[1].id, SubmapId(2)) << "moving a submap changes its row";
  EXPECT_TRUE(changes[1].written_tsdf.empty()) << "but none of its blocks";
  EXPECT_EQ(changes[2].id, SubmapId(3));
  EXPECT_EQ(changes[2].after, nullptr);
}

TEST(DiffSnapshots, AgainstNothingIsEverything) {
  Map map(Info());
  map.Create(NamedThing()).MutableTsdf({0, 0, 0});
  const auto snapshot = map.Publish(1);
  const auto changes = DiffSnapshots(nullptr, *snapshot);
  ASSERT_EQ(changes.size(), 2u);
  EXPECT_TRUE(changes[0].is_new);
  EXPECT_TRUE(changes[1].is_new);
  EXPECT_EQ(changes[1].written_tsdf.size(), 1u);
}

TEST(ValidateMapName, AcceptsTheNamesTheStoreAndUrlsCanHold) {
  for (const std::string& good : std::vector<std::string>{"a", "0", "house-1", "a.b_c-d", std::string(63, 'x')}) {
    EXPECT_TRUE(ValidateMapName(good).ok()) << good;
  }
  for (const std::string& bad :
       std::vector<std::string>{"", "A", ".a", "-a", "_a", "a b", "a/b", "ä", std::string(64, 'x')}) {
    const Status status = ValidateMapName(bad);
    EXPECT_EQ(status.code(), StatusCode::kInvalidArgument) << bad;
    EXPECT_EQ(status.reason(), Reason("BAD_NAME"));
  }
  EXPECT_FALSE(ValidateMapName(std::string("a\0b", 3)).ok());
}

}  // namespace
}  // namespace dhpmap

// SPDX-License-Identifier: BSD-3-Clause
// What commits changed, as both stores keep it.
#include <gtest/gtest.h>

#include <limits>
#include <map>
#include <string>
#include <vector>

#include "mapping/submap/observed_sphere.h"
#include "storage/store.h"
#include "tests/support/scenes.h"
#include "tests/unit/storage/kept_store.h"
#include "tests/unit/storage/map_fixtures.h"

namespace dhpmap {
namespace {

using testing::ExpectSameInfo;
using testing::MapGenerator;
using testing::StoreKind;

/// A submap as somebody holds it who follows the map.
struct Held {
  SubmapInfo info;
  BoundingSphere observed;
  std::int64_t num_blocks = 0;
};
using HeldMap = std::map<SubmapId, Held>;

HeldMap ListOf(const MapSnapshot& state) {
  HeldMap list;
  for (const auto& submap : state.submaps()) {
    list[submap->id()] = {submap->info(), SphereOfObservedInMap(*submap),
                          static_cast<std::int64_t>(submap->blocks().size())};
  }
  return list;
}

void Apply(const MapChange& change, HeldMap& held) {
  for (const SubmapEvent& event : change.submaps) {
    if (event.kind == ChangeKind::kRemoved || event.kind == ChangeKind::kMerged) held.erase(event.info.id);
    else held[event.info.id] = {event.info, event.observed, event.num_blocks};
  }
}

void ExpectSame(const HeldMap& expected, const HeldMap& held) {
  ASSERT_EQ(expected.size(), held.size());
  for (const auto& [id, submap] : expected) {
    const auto found = held.find(id);
    ASSERT_NE(found, held.end()) << "submap " << id.value;
    SCOPED_TRACE("submap " + std::to_string(id.value));
    ExpectSameInfo(submap.info, found->second.info);
    EXPECT_EQ(submap.observed.center_m, found->second.observed.center_m);
    EXPECT_EQ(submap.observed.radius_m, found->second.observed.radius_m);
    EXPECT_EQ(submap.num_blocks, found->second.num_blocks);
  }
}

class ChangesTest : public ::testing::TestWithParam<StoreKind> {
 protected:
  ChangesTest() { Open(); }

  void Open(const ChangeHistoryLimits& limits = {}) {
    kept_.Open(store_, {.changes = limits, .passing_time_ns = [this] { return passed_ns_; }});
  }
  void SetUp() override { DHPMAP_SKIP_UNLESS_THERE(kept_); }
  void BeginAnew(const ChangeHistoryLimits& limits) {
    store_ = nullptr;
    kept_.BeginAnew();
    Open(limits);
  }

  std::unique_ptr<Map> Create(const std::string& name, int num_submaps = 3) {
    auto map = std::make_unique<Map>(generator_.Info(name));
    for (int n = 0; n < num_submaps; ++n) generator_.AddSubmap(*map, 4);
    EXPECT_TRUE(store_->CreateMap(*map->Publish(11)).ok());
    return map;
  }
  /// Commits what was written to the map since `before`, and tells the change.
  MapChange Commit(Map& map, const std::shared_ptr<const MapSnapshot>& before, std::int64_t time_ns = 20) {
    const Status committed = store_->Commit(*before, *map.Publish(time_ns), Durability::kNormal);
    EXPECT_TRUE(committed.ok()) << committed.ToString();
    const auto list = store_->ListChanges(map.info().name, before->revision(), 1);
    EXPECT_TRUE(list.ok()) << list.status().ToString();
    EXPECT_EQ(list->changes.size(), 1u);
    return list.ok() && !list->changes.empty() ? *list->changes[0] : MapChange();
  }
  /// All that is told after a revision, in pages.
  std::vector<std::shared_ptr<const MapChange>> ReadAll(const std::string& name, std::int64_t after,
                                                        std::size_t max_bytes) {
    std::vector<std::shared_ptr<const MapChange>> all;
    while (true) {
      const auto list = store_->ListChanges(name, after, max_bytes);
      EXPECT_TRUE(list.ok()) << list.status().ToString();
      if (!list.ok() || (list->changes.empty() && !list->has_more)) return all;
      all.insert(all.end(), list->changes.begin(), list->changes.end());
      after = all.back()->last_revision;
    }
  }

  testing::KeptStore kept_{GetParam()};
  MapGenerator generator_{31};
  std::int64_t passed_ns_ = 0;
  std::unique_ptr<MapStore> store_;
};

TEST_P(ChangesTest, ReplayedFromAnyRevisionOverTheListThenTheyGiveThePresentList) {
  for (std::uint32_t seed = 0; seed < 3; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    MapGenerator generator(seed);
    const std::string name = "map-" + std::to_string(seed);
    Map map(generator.Info(name));
    generator.AddSubmap(map, 3);
    std::map<std::int64_t, HeldMap> lists = {{0, {}}};
    ASSERT_TRUE(store_->CreateMap(*map.Publish(1)).ok());
    lists[map.published()->revision()] = ListOf(*map.published());
    for (int step = 0; step < 25; ++step) {
      const auto before = map.published();
      generator.Change(map);
      if (generator.Below(2) == 0) {  // seen, and only stored together with what came next
        map.Publish(step);
        lists[map.published()->revision()] = ListOf(*map.published());
        generator.Change(map);
      }
      ASSERT_TRUE(store_->Commit(*before, *map.Publish(step), Durability::kNormal).ok());
      lists[map.published()->revision()] = ListOf(*map.published());
      if (generator.Below(5) == 0) Open();
    }
    for (const auto& [revision, list] : lists) {
      SCOPED_TRACE("from revision " + std::to_string(revision));
      HeldMap held = list;
      std::int64_t last = revision;
      for (const auto& change : ReadAll(name, revision, generator.Below(2) ? 1 : 5000)) {
        EXPECT_GT(change->last_revision, last) << "in order, each once";
        EXPECT_LE(change->first_revision, last + 1) << "nothing left out";
        last = change->last_revision;
        Apply(*change, held);
      }
      EXPECT_EQ(last, map.published()->revision());
      ExpectSame(lists.rbegin()->second, held);
      if (HasFailure()) return;
    }
  }
}

TEST_P(ChangesTest, AMapsCreationIsItsFirstChange) {
  const auto map = Create("house");
  const auto list = store_->ListChanges("house", 0, 1 << 20);
  ASSERT_TRUE(list.ok()) << list.status().ToString();
  EXPECT_EQ(list->history_id, map->info().history_id);
  EXPECT_EQ(list->revision, 1);
  EXPECT_EQ(list->complete_after, 0);
  EXPECT_FALSE(list->has_more);
  ASSERT_EQ(list->changes.size(), 1u);
  const MapChange& change = *list->changes[0];
  EXPECT_EQ(change.first_revision, 1);
  EXPECT_EQ(change.last_revision, 1);
  EXPECT_EQ(change.time_ns, 11);
  ASSERT_EQ(change.submaps.size(), 4u);
  for (const SubmapEvent& event : change.submaps) {
    EXPECT_EQ(event.kind, ChangeKind::kCreated);
    EXPECT_FALSE(event.before.has_value());
  }
}

TEST_P(ChangesTest, RevisionsThatWereStoredTogetherAreToldAsOne) {
  const auto map = Create("house");
  const auto before = map->published();
  map->mutable_info().num_frames = 1;
  map->Publish(12);
  map->mutable_info().num_frames = 2;
  const MapChange change = Commit(*map, before, 13);
  EXPECT_EQ(change.first_revision, 2);
  EXPECT_EQ(change.last_revision, 3);
  EXPECT_EQ(change.time_ns, 13);
  EXPECT_TRUE(change.submaps.empty());
  EXPECT_EQ(store_->ListChanges("house", 2, 1)->changes.size(), 1u) << "a part of it may be later";
  EXPECT_TRUE(store_->ListChanges("house", 3, 1)->changes.empty());
  EXPECT_TRUE(store_->ListChanges("house", std::numeric_limits<std::int64_t>::max(), 1)->changes.empty());
}

TEST_P(ChangesTest, ACommitOfNothingIsNoChange) {
  const auto map = Create("house");
  ASSERT_TRUE(store_->Commit(*map->published(), *map->published(), Durability::kFull).ok());
  EXPECT_TRUE(store_->ListChanges("house", 1, 1)->changes.empty());
}

TEST_P(ChangesTest, EachPartThatChangesIsTold) {
  const auto map = Create("house");
  const SubmapId id(2);
  const auto parts_of = [&](const std::function<void(Submap&)>& write) {
    const auto before = map->published();
    write(*map->FindMutable(id));
    const MapChange change = Commit(*map, before);
    EXPECT_EQ(change.submaps.size(), 1u);
    if (change.submaps.empty()) return SubmapParts();
    EXPECT_EQ(change.submaps[0].info.id, id);
    EXPECT_EQ(change.submaps[0].kind, ChangeKind::kChanged);
    EXPECT_TRUE(change.submaps[0].before.has_value());
    return change.submaps[0].parts;
  };
  using enum SubmapPart;
  EXPECT_EQ(parts_of([](Submap&) {}), SubmapParts());
  EXPECT_EQ(parts_of([](Submap& s) { s.mutable_info().T_map_submap.translation().x() += 1; }), SubmapParts({kPose}));
  EXPECT_EQ(parts_of([](Submap& s) { s.mutable_info().class_id = ClassId(7); }), SubmapParts({kLabels}));
  EXPECT_EQ(parts_of([](Submap& s) { s.mutable_info().display_name = "a new one"; }), SubmapParts({kName}));
  EXPECT_EQ(parts_of([](Submap& s) { s.mutable_info().is_locked = !s.info().is_locked; }), SubmapParts({kLock}));
  EXPECT_EQ(
      parts_of([](Submap& s) { s.mutable_info().presence = s.IsAbsent() ? Presence::kPresent : Presence::kAbsent; }),
      SubmapParts({kActivity}));
  EXPECT_EQ(parts_of([](Submap& s) { ++s.mutable_info().num_frames_observed; }), SubmapParts({kObservation}));
  EXPECT_EQ(parts_of([](Submap& s) { s.MutableTsdf({9, 9, 9}).weight[0] = 1; }), SubmapParts({kGeometry}));
  EXPECT_EQ(parts_of([](Submap& s) {
              s.MutableLabels({9, 9, 9}).AddObservation(3, ClassId(1));
            }),
            SubmapParts({kVoxelLabels}));
  EXPECT_EQ(parts_of([](Submap& s) { s.EraseBlock({9, 9, 9}); }), SubmapParts({kGeometry, kVoxelLabels}));
}

TEST_P(ChangesTest, WhatGoesIsToldWithWhatItWasAndWhatItIsAPartOf) {
  const auto map = Create("house");
  auto before = map->published();
  const SubmapInfo gone = map->Find(SubmapId(1))->info();
  const BoundingSphere sphere = map->Find(SubmapId(1))->BoundingSphereInMap();
  map->Remove(SubmapId(1));
  MapChange change = Commit(*map, before);
  ASSERT_EQ(change.submaps.size(), 1u);
  EXPECT_EQ(change.submaps[0].kind, ChangeKind::kRemoved);
  ExpectSameInfo(gone, change.submaps[0].info);
  EXPECT_EQ(change.submaps[0].before->sphere.center_m, sphere.center_m);
  EXPECT_EQ(change.submaps[0].before->sphere.radius_m, sphere.radius_m);

  before = map->published();
  map->Remove(SubmapId(2));
  map->mutable_info().merged.Add(SubmapId(2), SubmapId(3));
  change = Commit(*map, before);
  ASSERT_EQ(change.submaps.size(), 1u);
  EXPECT_EQ(change.submaps[0].kind, ChangeKind::kMerged);
  EXPECT_EQ(change.submaps[0].info.id, SubmapId(2));
  EXPECT_EQ(change.submaps[0].into, SubmapId(3));
}

TEST_P(ChangesTest, AMapsNewNameIsTold) {
  const auto map = Create("house");
  const auto before = map->published();
  map->mutable_info().display_name = "My house";
  EXPECT_EQ(Commit(*map, before).display_name, "My house");
}

TEST_P(ChangesTest, WhatComesAndGoesBetweenTwoCommitsIsToldAsGoneForWhoeverListedItMeanwhile) {
  const auto map = Create("house");
  const auto before = map->published();
  const SubmapId removed = generator_.AddSubmap(*map, 2).id(), merged = generator_.AddSubmap(*map, 2).id();
  const SubmapId stays = generator_.AddSubmap(*map, 2).id();
  map->Publish(1);
  map->Remove(removed);
  map->Remove(merged);
  map->mutable_info().merged.Add(merged, stays);
  const MapChange change = Commit(*map, before);
  ASSERT_EQ(change.submaps.size(), 3u);
  EXPECT_EQ(change.submaps[0].kind, ChangeKind::kRemoved);
  EXPECT_EQ(change.submaps[0].info.id, removed);
  EXPECT_EQ(change.submaps[1].kind, ChangeKind::kMerged);
  EXPECT_EQ(change.submaps[1].info.id, merged);
  EXPECT_EQ(change.submaps[1].into, stays);
  EXPECT_EQ(change.submaps[2].kind, ChangeKind::kCreated);
  for (const SubmapEvent& event : change.submaps) EXPECT_FALSE(event.before) << event.info.id.value;
  const auto then = map->published();
  map->mutable_info().display_name = "My house";
  EXPECT_TRUE(Commit(*map, then).submaps.empty()) << "told once";
}

Region UnitBoxAt(double x_m) { return Eigen::AlignedBox3d(Eigen::Vector3d(x_m, 0, 0), Eigen::Vector3d(x_m + 1, 1, 1)); }

TEST_P(ChangesTest, RegionsThatAreKeptClearAndLiftedAreToldByNameAsTheyDifferBetweenTwoCommits) {
  const auto map = Create("house");
  const auto before = map->published();
  KeptClear& kept = map->mutable_info().kept_clear;
  ASSERT_TRUE(kept.Add({"hall", UnitBoxAt(0)}).ok());
  ASSERT_TRUE(kept.Add({"door", BoundingSphere{{1, 2, 3}, 0.5}}).ok());
  MapChange change = Commit(*map, before);
  ASSERT_EQ(change.regions.size(), 2u);
  EXPECT_EQ(change.regions[0].kind, RegionEventKind::kKeptClear);
  EXPECT_EQ(change.regions[0].name, "door");
  EXPECT_TRUE(IsSame(change.regions[0].region, BoundingSphere{{1, 2, 3}, 0.5}));
  EXPECT_EQ(change.regions[1].name, "hall");
  EXPECT_TRUE(change.submaps.empty());

  const auto then = map->published();
  KeptClear& later = map->mutable_info().kept_clear;
  ASSERT_TRUE(later.Lift("door") && later.Lift("hall"));
  ASSERT_TRUE(later.Add({"hall", UnitBoxAt(7)}).ok());
  ASSERT_TRUE(later.Add({"passing", UnitBoxAt(8)}).ok());
  map->Publish(15);
  ASSERT_TRUE(map->mutable_info().kept_clear.Lift("passing"));
  change = Commit(*map, then);
  ASSERT_EQ(change.regions.size(), 3u) << "what came and went between is not told";
  EXPECT_EQ(change.regions[0].kind, RegionEventKind::kLifted);
  EXPECT_EQ(change.regions[0].name, "door");
  EXPECT_EQ(change.regions[1].kind, RegionEventKind::kLifted);
  EXPECT_TRUE(IsSame(change.regions[1].region, UnitBoxAt(0))) << "as it was";
  EXPECT_EQ(change.regions[2].kind, RegionEventKind::kKeptClear);
  EXPECT_TRUE(IsSame(change.regions[2].region, UnitBoxAt(7)));
}

TEST_P(ChangesTest, WhatAnEditHasClearedIsToldWithItsChange) {
  const auto map = Create("house");
  const auto before = map->published();
  map->mutable_info().display_name = "cleared";
  const auto after = map->Publish(20);
  const EditRecord edit{.entry = {after->revision(), 20, {}, {}},
                        .answer = "",
                        .before = before,
                        .cleared = {{.region = UnitBoxAt(2), .submap = SubmapId(3), .num_voxels = 12},
                                    {.region = BoundingSphere{{1, 2, 3}, 0.5}, .classes = {ClassId(1), ClassId(7)}}}};
  ASSERT_TRUE(store_->CommitEdit(*before, *after, edit).ok());
  Open();  // a database is closed and opened again
  const auto list = store_->ListChanges("house", before->revision(), 1);
  ASSERT_TRUE(list.ok()) << list.status().ToString();
  ASSERT_EQ(list->changes.size(), 1u);
  const MapChange& change = *list->changes[0];
  ASSERT_EQ(change.regions.size(), 2u);
  EXPECT_EQ(change.regions[0].kind, RegionEventKind::kCleared);
  EXPECT_TRUE(IsSame(change.regions[0].region, UnitBoxAt(2)));
  EXPECT_EQ(change.regions[0].submap, SubmapId(3));
  EXPECT_EQ(change.regions[0].num_voxels, 12);
  EXPECT_TRUE(IsSame(change.regions[1].region, BoundingSphere{{1, 2, 3}, 0.5}));
  EXPECT_EQ(change.regions[1].classes, (std::vector<ClassId>{ClassId(1), ClassId(7)}));
  EXPECT_EQ(change.display_name, "cleared");
}

TEST_P(ChangesTest, UnknownMapsAreNotFound) {
  EXPECT_EQ(store_->ListChanges("ghost", 0, 1).status().code(), StatusCode::kNotFound);
  Create("house");
  ASSERT_TRUE(store_->DeleteMap("house").ok());
  EXPECT_EQ(store_->ListChanges("house", 0, 1).status().code(), StatusCode::kNotFound);
}

/// How many changes can be read, and that the rest is refused with where they begin.
std::int64_t NumKept(MapStore& store, const std::string& name, std::int64_t now) {
  std::int64_t num_kept = -1;
  for (std::int64_t after = now; after >= 0; --after) {
    const auto list = store.ListChanges(name, after, std::numeric_limits<std::size_t>::max());
    if (list.ok()) {
      EXPECT_EQ(list->changes.size(), static_cast<std::size_t>(now - after));
      num_kept = now - after;
      continue;
    }
    EXPECT_EQ(list.status().code(), StatusCode::kOutOfRange);
    EXPECT_EQ(list.status().reason(), Reason("COMPACTED"));
    EXPECT_EQ(list.status().metadata().size(), 1u);
    EXPECT_EQ(list.status().metadata()[0],
              (std::pair<std::string, std::string>("oldest_revision", std::to_string(now - num_kept + 1))));
  }
  return num_kept;
}

TEST_P(ChangesTest, OldOnesGoByNumberAgeAndBytes) {
  const auto kept_of_40 = [this](const ChangeHistoryLimits& limits) {
    passed_ns_ = 0;
    BeginAnew(limits);
    const auto map = Create("house");
    for (int step = 2; step <= 40; ++step) {
      const auto before = map->published();
      map->FindMutable(SubmapId(1 + static_cast<std::uint32_t>(step % 3)))->mutable_info().num_frames_observed = step;
      passed_ns_ = step * 1'000'000'000LL;
      EXPECT_TRUE(store_->Commit(*before, *map->Publish(step), Durability::kNormal).ok());
    }
    return NumKept(*store_, "house", 40);
  };
  EXPECT_EQ(kept_of_40({}), 40);
  EXPECT_EQ(kept_of_40({.max_changes = 7}), 7);
  EXPECT_EQ(kept_of_40({.max_changes = 0}), 0);
  EXPECT_EQ(kept_of_40({.max_age_s = 10}), 11);
  const std::int64_t kept = kept_of_40({.max_bytes = 4000});
  EXPECT_GT(kept, 2);
  EXPECT_LT(kept, 30);
  EXPECT_EQ(kept_of_40({.max_bytes = 1}), 0) << "one that is too large for itself is not kept either";
}

TEST_P(ChangesTest, TheyGoOnAfterALimitWasLowered) {
  const auto map = Create("house");
  const auto commit = [&](int count) {
    for (int n = 0; n < count; ++n) {
      const auto before = map->published();
      map->mutable_info().num_frames += 1;
      ASSERT_TRUE(store_->Commit(*before, *map->Publish(n), Durability::kNormal).ok());
    }
  };
  commit(99);
  if (GetParam() == StoreKind::kMemory) return;  // has the limits that it was made with
  Open({.max_changes = 10});
  EXPECT_EQ(NumKept(*store_, "house", 100), 100) << "a look deletes nothing";
  commit(1);
  EXPECT_EQ(NumKept(*store_, "house", 101), 101 - 16) << "no commit deletes them all";
  commit(8);
  EXPECT_EQ(NumKept(*store_, "house", 109), 10);
}

INSTANTIATE_TEST_SUITE_P(Stores, ChangesTest, ::testing::ValuesIn(testing::AllStores()), testing::NameOfKind);

}  // namespace
}  // namespace dhpmap

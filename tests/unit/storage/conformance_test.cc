// SPDX-License-Identifier: BSD-3-Clause
// What every MapStore promises, asked of each of them.
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <string>
#include <thread>
#include <vector>

#include "storage/store.h"
#include "tests/unit/storage/kept_store.h"
#include "tests/unit/storage/map_fixtures.h"

namespace dhpmap {
namespace {

using testing::ExpectSameMap;
using testing::MapGenerator;
using testing::StoreKind;

class MapStoreTest : public ::testing::TestWithParam<StoreKind> {
 protected:
  MapStoreTest() { Open(); }

  void Open() { kept_.Open(store_); }
  void SetUp() override { DHPMAP_SKIP_UNLESS_THERE(kept_); }

  std::shared_ptr<const MapSnapshot> Load(const std::string& name) {
    auto loaded = store_->LoadMap(name);
    EXPECT_TRUE(loaded.ok()) << loaded.status().ToString();
    return loaded.ok() ? *loaded : nullptr;
  }

  /// A map with three objects, created in the store.
  std::unique_ptr<Map> CreateSample(const std::string& name) {
    auto map = std::make_unique<Map>(generator_.Info(name));
    generator_.AddBlocks(*map->FindMutable(kUnknownSubmap), 2);
    for (int n = 0; n < 3; ++n) generator_.AddSubmap(*map, 4);
    for (int n = 0; n < 3; ++n) generator_.AddVoxels(map->mutable_free_space());
    const Status created = store_->CreateMap(*map->Publish(11));
    EXPECT_TRUE(created.ok()) << created.ToString();
    return map;
  }

  testing::KeptStore kept_{GetParam()};
  MapGenerator generator_{5};
  std::unique_ptr<MapStore> store_;
};

TEST_P(MapStoreTest, IsEmptyAtFirst) {
  const auto maps = store_->ListMaps();
  ASSERT_TRUE(maps.ok());
  EXPECT_TRUE(maps->empty());
}

TEST_P(MapStoreTest, GivesBackACreatedMap) {
  const auto map = CreateSample("house");
  ExpectSameMap(*map->published(), *Load("house"));
  Open();
  ExpectSameMap(*map->published(), *Load("house"));
}

TEST_P(MapStoreTest, GivesBackAMapWithoutAnything) {
  MapInfo info;
  info.name = "bare";
  Map map(info);
  ASSERT_TRUE(store_->CreateMap(*map.Publish(0)).ok());
  ExpectSameMap(*map.published(), *Load("bare"));
}

TEST_P(MapStoreTest, AnswersNotFoundForUnknownMaps) {
  Map map(generator_.Info("ghost"));
  const auto before = map.Publish(1);
  EXPECT_EQ(store_->GetMap("ghost").status().code(), StatusCode::kNotFound);
  EXPECT_EQ(store_->LoadMap("ghost").status().code(), StatusCode::kNotFound);
  EXPECT_EQ(store_->DeleteMap("ghost").code(), StatusCode::kNotFound);
  map.mutable_info().num_frames = 1;
  EXPECT_EQ(store_->Commit(*before, *map.Publish(2), Durability::kNormal).code(), StatusCode::kNotFound);
}

TEST_P(MapStoreTest, RefusesASecondMapOfTheSameName) {
  const auto map = CreateSample("house");
  Map other(generator_.Info("house"));
  EXPECT_EQ(store_->CreateMap(*other.Publish(3)).code(), StatusCode::kAlreadyExists);
  ExpectSameMap(*map->published(), *Load("house"));
}

TEST_P(MapStoreTest, RefusesABadName) {
  Map map(generator_.Info("../etc"));
  EXPECT_EQ(store_->CreateMap(*map.Publish(1)).code(), StatusCode::kInvalidArgument);
}

TEST_P(MapStoreTest, ListsMapsByNameWithTheirSizes) {
  CreateSample("zoo");
  CreateSample("attic");
  const auto maps = store_->ListMaps();
  ASSERT_TRUE(maps.ok());
  ASSERT_EQ(maps->size(), 2u);
  EXPECT_EQ((*maps)[0].info.name, "attic");
  EXPECT_EQ((*maps)[1].info.name, "zoo");

  const auto loaded = Load("zoo");
  const auto zoo = store_->GetMap("zoo");
  ASSERT_TRUE(zoo.ok());
  std::int64_t num_tsdf = 0, num_labels = 0;
  for (const auto& submap : loaded->submaps()) {
    for (const BlockEntry& entry : submap->blocks().entries()) {
      num_tsdf += entry.tsdf != nullptr;
      num_labels += entry.labels != nullptr;
    }
  }
  EXPECT_EQ(zoo->num_submaps, 4);
  EXPECT_EQ(zoo->num_tsdf_blocks, num_tsdf);
  EXPECT_EQ(zoo->num_label_blocks, num_labels);
  EXPECT_GT(zoo->blob_bytes, 100 * num_tsdf);
  EXPECT_EQ(zoo->info.revision, loaded->revision());
}

TEST_P(MapStoreTest, ListsMapsPageByPageByTheBytesOfTheirNames) {
  const std::vector<std::string> names = {"9", "a", "a-b", "a.b", "a_b", "aa", "b"};
  for (const std::string& name : {names[3], names[0], names[6], names[1], names[5], names[4], names[2]}) {
    ASSERT_TRUE(store_->CreateMap(*Map(generator_.Info(name)).Publish(1)).ok());
  }
  for (std::size_t size = 1; size <= names.size() + 1; ++size) {
    std::vector<std::string> listed;
    for (;;) {
      const auto page = store_->ListMaps(listed.empty() ? "" : listed.back(), size);
      ASSERT_TRUE(page.ok()) << page.status().ToString();
      ASSERT_LE(page->size(), size);
      for (const StoredMap& map : *page) {
        listed.push_back(map.info.name);
        const auto alone = store_->GetMap(map.info.name);
        ASSERT_TRUE(alone.ok());
        testing::ExpectSameMapInfo(map.info, alone->info);
        EXPECT_EQ(map.num_submaps, alone->num_submaps);
      }
      if (page->size() < size) break;
    }
    EXPECT_EQ(listed, names) << "by pages of " << size;
    const auto num_first = static_cast<std::ptrdiff_t>(std::min(size, names.size()));
    EXPECT_EQ(*store_->ListMapNames("", size), std::vector<std::string>(names.begin(), names.begin() + num_first));
  }
  EXPECT_EQ(store_->ListMaps("a-a", 1)->at(0).info.name, "a-b") << "after a name that is not there";
  EXPECT_EQ(*store_->ListMapNames("aa", 9), (std::vector<std::string>{"b"}));
}

TEST_P(MapStoreTest, DeletedMapsAreGoneAndTheirNameIsFree) {
  CreateSample("house");
  const auto kept = CreateSample("kept");
  ASSERT_TRUE(store_->DeleteMap("house").ok());
  EXPECT_EQ(store_->LoadMap("house").status().code(), StatusCode::kNotFound);
  CreateSample("house");
  ExpectSameMap(*kept->published(), *Load("kept"));
}

TEST_P(MapStoreTest, RefusesACommitFromAnotherRevision) {
  const auto map = CreateSample("house");
  const auto first = map->published();
  map->mutable_info().num_frames = 1;
  const auto second = map->Publish(20);
  map->mutable_info().num_frames = 2;
  const auto third = map->Publish(30);
  EXPECT_EQ(store_->Commit(*second, *third, Durability::kNormal).code(), StatusCode::kFailedPrecondition);
  ASSERT_TRUE(store_->Commit(*first, *third, Durability::kNormal).ok());
  EXPECT_EQ(store_->Commit(*first, *second, Durability::kNormal).code(), StatusCode::kFailedPrecondition);
  EXPECT_EQ(store_->GetMap("house")->info.revision, third->revision());
}

TEST_P(MapStoreTest, RefusesACommitToAMapThatTookTheName) {
  const auto map = CreateSample("house");
  ASSERT_TRUE(store_->DeleteMap("house").ok());
  MapInfo info = generator_.Info("house");
  info.create_time_ns += 1;
  Map other(info);
  ASSERT_TRUE(store_->CreateMap(*other.Publish(40)).ok());
  const auto before = map->published();
  map->mutable_info().num_frames = 1;
  EXPECT_EQ(store_->Commit(*before, *map->Publish(50), Durability::kFull).code(), StatusCode::kFailedPrecondition);
}

TEST_P(MapStoreTest, RefusesACommitThatIsNotAStepForward) {
  const auto map = CreateSample("house");
  const auto other = CreateSample("other");
  const auto before = map->published();
  map->mutable_info().num_frames = 1;
  const auto after = map->Publish(60);
  EXPECT_EQ(store_->Commit(*after, *before, Durability::kNormal).code(), StatusCode::kInvalidArgument);
  EXPECT_EQ(store_->Commit(*other->published(), *after, Durability::kNormal).code(), StatusCode::kInvalidArgument);
}

TEST_P(MapStoreTest, CommitsNothingButDurability) {
  const auto map = CreateSample("house");
  EXPECT_TRUE(store_->Commit(*map->published(), *map->published(), Durability::kFull).ok());
  ExpectSameMap(*map->published(), *Load("house"));
}

TEST_P(MapStoreTest, MappingGoesOnFromALoadedMap) {
  auto map = CreateSample("house");
  for (int round = 0; round < 4; ++round) {
    Open();
    const auto loaded = Load("house");
    ASSERT_NE(loaded, nullptr);
    map = std::make_unique<Map>(loaded);
    generator_.Change(*map);
    const Status committed = store_->Commit(*loaded, *map->Publish(100 + round), Durability::kNormal);
    ASSERT_TRUE(committed.ok()) << committed.ToString();
    ExpectSameMap(*map->published(), *Load("house"));
  }
}

TEST_P(MapStoreTest, WritesAChangedConfigAndLabelSet) {
  const auto map = CreateSample("house");
  const auto before = map->published();
  map->mutable_info().config.integration.weighting = Weighting::kConstant;
  map->mutable_info().config.voxel_size_m = 0.1 + 0.2;
  map->mutable_info().label_set = std::make_shared<const LabelSet>(
      LabelSet::Create({{ClassId(3), "o'reilly; --", Panoptic::kThing, SizeClass::kMedium, {9, 9, 9}}}).value());
  ASSERT_TRUE(store_->Commit(*before, *map->Publish(70), Durability::kNormal).ok());
  ExpectSameMap(*map->published(), *Load("house"));
}

TEST_P(MapStoreTest, FollowsRandomHistories) {
  for (std::uint32_t seed = 0; seed < 4; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    MapGenerator generator(seed);
    const std::string name = "map-" + std::to_string(seed);
    Map map(generator.Info(name));
    generator.AddSubmap(map, 3);
    ASSERT_TRUE(store_->CreateMap(*map.Publish(1)).ok());
    for (int step = 0; step < 20; ++step) {
      const auto before = map.published();
      generator.Change(map);
      if (generator.Below(3) == 0) map.Publish(step);  // a state that was never committed
      generator.Change(map);
      const auto durability = generator.Below(4) ? Durability::kNormal : Durability::kFull;
      const Status committed = store_->Commit(*before, *map.Publish(step), durability);
      ASSERT_TRUE(committed.ok()) << committed.ToString();
      if (generator.Below(5) == 0) Open();
      ExpectSameMap(*map.published(), *Load(name));
      if (HasFatalFailure()) return;
    }
  }
}

TEST_P(MapStoreTest, ServesReadersWhileItCommits) {
  const auto map = CreateSample("house");
  CreateSample("other");
  std::atomic<bool> done = false;
  std::vector<std::thread> readers;
  for (int n = 0; n < 2; ++n) {
    readers.emplace_back([&] {
      std::int64_t last_revision = 0;
      while (!done) {
        const auto loaded = store_->LoadMap("house");
        ASSERT_TRUE(loaded.ok()) << loaded.status().ToString();
        EXPECT_GE((*loaded)->revision(), last_revision);
        last_revision = (*loaded)->revision();
        EXPECT_EQ((*loaded)->info().num_frames, last_revision - 1) << "half a commit";
        EXPECT_TRUE(store_->ListMaps().ok());
      }
    });
  }
  for (int step = 0; step < 30; ++step) {
    const auto before = map->published();
    generator_.Change(*map);
    const Status committed = store_->Commit(*before, *map->Publish(step), Durability::kNormal);
    EXPECT_TRUE(committed.ok()) << committed.ToString();
  }
  done = true;
  for (std::thread& reader : readers) reader.join();
  ExpectSameMap(*map->published(), *Load("house"));
}

INSTANTIATE_TEST_SUITE_P(Stores, MapStoreTest,
                         ::testing::Values(StoreKind::kMemory, StoreKind::kSqlite, StoreKind::kPaged,
                                           StoreKind::kPostgres, StoreKind::kPagedPostgres),
                         testing::NameOfKind);

}  // namespace
}  // namespace dhpmap

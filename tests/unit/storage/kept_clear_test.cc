// SPDX-License-Identifier: BSD-3-Clause
// Regions that a map keeps clear, as both stores keep them.
#include <gtest/gtest.h>

#include <fstream>

#include "tests/unit/storage/any_store_fixture.h"
#include "tests/unit/storage/map_fixtures.h"

namespace dhpmap {
namespace {

using testing::AnyStoreTest;
using testing::ExpectSameMap;
using testing::StoreKind;

const BoundingSphere kSphere{{-0.0, 1e-300, 1.0 / 3}, 0.75};
const Eigen::AlignedBox3d kBox(Eigen::Vector3d(-1, -0.0, -2.0 / 3), Eigen::Vector3d(1, 2, 3));

class KeptClearStoreTest : public AnyStoreTest {
 protected:
  /// Adds, replaces or lifts some, and commits that.
  void Change(MapStore& store, Map& map, int step) {
    const auto before = map.published();
    KeptClear& kept_clear = map.mutable_info().kept_clear;
    for (int n = generator_.Below(3); n >= 0; --n) {
      const std::string name = "region-" + std::to_string(generator_.Below(5));
      if (kept_clear.Lift(name) && generator_.Below(2) == 0) continue;
      const BoundingSphere sphere{{generator_.Uniform(-9, 9), 0, 0}, generator_.Uniform(0.1, 2)};
      ASSERT_TRUE(kept_clear.Add({name, sphere}).ok());
    }
    ASSERT_TRUE(store.Commit(*before, *map.Publish(step), Durability::kNormal).ok());
  }
};

/// By SQL of SQLite's own.
class KeptClearStoreTestInAFile : public KeptClearStoreTest {};

TEST_P(KeptClearStoreTest, ComeBackToTheBitFromBothStores) {
  Open();
  const auto memory = MakeMemoryStore();
  Map map(generator_.Info("a"));
  ASSERT_TRUE(map.mutable_info().kept_clear.Add({"lift.2", kBox}).ok());
  ASSERT_TRUE(map.mutable_info().kept_clear.Add({"door", kSphere}).ok());
  for (MapStore* store : {memory.get(), store_.get()}) ASSERT_TRUE(store->CreateMap(*map.Publish(1)).ok());
  for (int step = 0; step < 30; ++step) {
    Open();
    for (MapStore* store : {memory.get(), store_.get()}) {
      const auto loaded = store->LoadMap("a");
      ASSERT_TRUE(loaded.ok()) << loaded.status().ToString();
      ExpectSameMap(*map.published(), **loaded);
    }
    const auto before = map.published();
    Change(*store_, map, step);
    ASSERT_TRUE(memory->Commit(*before, *map.published(), Durability::kNormal).ok());
  }
  const KeptClearRegion* box = map.info().kept_clear.Find("lift.2");
  ASSERT_NE(box, nullptr);
  EXPECT_TRUE(IsSame(box->region, kBox));
}

TEST_P(KeptClearStoreTestInAFile, GoWithTheirMapAndIntoABackup) {
  Open();
  Map map(generator_.Info("a"));
  ASSERT_TRUE(map.mutable_info().kept_clear.Add({"door", kSphere}).ok());
  ASSERT_TRUE(store_->CreateMap(*map.Publish(1)).ok());
  const std::string copy = kept_.Path() + ".copy";
  {
    auto backup = store_->Backup({});
    ASSERT_TRUE(backup.ok()) << backup.status().ToString();
    std::ofstream out(copy, std::ios::binary);
    for (std::string part = "-"; !part.empty();) {
      auto read = (*backup)->Read(1 << 16);
      ASSERT_TRUE(read.ok()) << read.status().ToString();
      out << (part = *std::move(read));
    }
  }
  ASSERT_TRUE(store_->DeleteMap("a").ok());
  EXPECT_EQ(Query("SELECT count(*) FROM kept_clear"), 0);
  const auto restored = OpenSqliteStore(copy, {});
  ASSERT_TRUE(restored.ok()) << restored.status().ToString();
  const auto loaded = (*restored)->LoadMap("a");
  ASSERT_TRUE(loaded.ok()) << loaded.status().ToString();
  EXPECT_TRUE((*loaded)->info().kept_clear == map.info().kept_clear);
}

TEST_P(KeptClearStoreTest, DamageIsSeen) {
  Open();
  Map map(generator_.Info("a"));
  ASSERT_TRUE(map.mutable_info().kept_clear.Add({"door", kSphere}).ok());
  ASSERT_TRUE(store_->CreateMap(*map.Publish(1)).ok());
  for (const char* damage :
       {"UPDATE kept_clear SET name = 'gate'", "UPDATE kept_clear SET region = x'02'", "DELETE FROM kept_clear"}) {
    SCOPED_TRACE(damage);
    store_ = nullptr;
    Tamper(damage);
    Open();
    EXPECT_EQ(store_->LoadMap("a").status().code(), StatusCode::kDataLoss);
  }
}

DHPMAP_ON_STORES_THAT_KEEP(KeptClearStoreTest);
INSTANTIATE_TEST_SUITE_P(Stores, KeptClearStoreTestInAFile, ::testing::Values(StoreKind::kSqlite), testing::NameOfKind);

}  // namespace
}  // namespace dhpmap

// SPDX-License-Identifier: BSD-3-Clause
#include "server/grpc/map_quota.h"

#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "server/auth/keys/key_file.h"
#include "server/auth/map_owners_table.h"
#include "storage/store.h"
#include "tests/support/fake_auth_tables.h"
#include "tests/support/scenes.h"

namespace dhpmap {
namespace {

class MapQuotaTest : public ::testing::Test {
 protected:
  MapQuotaTest() {
    EXPECT_TRUE(auth::ChangeKeyFile(key_file, [](std::vector<auth::KeyRecord>&) { return Status::Ok(); }).ok());
    Start({.maps = 3});
  }
  /// Starts a server with these limits.
  void Start(const auth::CallLimits& limits) {
    quota.reset();
    gate =
        auth::Gate::WithKeys({.key_file = key_file, .owners_file = key_file + ".owners", .limits = limits, .look_s = 0})
            .value();
    quota = std::make_unique<MapQuota>(*gate, *registry, [this] { return now_s; });
  }
  static Caller CallerNamed(const std::string& name) {
    return {std::make_shared<const auth::Principal>(auth::Principal{.name = name}), nullptr, nullptr};
  }
  std::unique_ptr<MapQuota::Making> Begin(const std::string& name) {
    auto making = quota->Begin(CallerNamed(name));
    reason = making.status().reason();
    return making.ok() ? *std::move(making) : nullptr;
  }
  void Make(const std::string& name, const std::string& map) {
    const auto making = Begin(name);
    ASSERT_NE(making, nullptr);
    making->Done(registry->Create(MapInfo{.name = map}).value());
  }

  testing::TempDir folder;
  const std::string key_file = (folder.path() / "keys").string();
  double now_s = 0;
  std::unique_ptr<MapStore> store = MakeMemoryStore();
  std::unique_ptr<MapRegistry> registry = MapRegistry::Open(*store, {}).value();
  std::shared_ptr<auth::Gate> gate;
  std::unique_ptr<MapQuota> quota;
  Reason reason;
};

TEST_F(MapQuotaTest, CountsExistingMapsAndThoseBeingMade) {
  Make("anna", "a");
  auto second = Begin("anna");
  const auto third = Begin("anna");
  ASSERT_TRUE(second != nullptr && third != nullptr);
  EXPECT_EQ(Begin("anna"), nullptr);
  EXPECT_EQ(reason, Reason("OUT_OF_QUOTA"));
  EXPECT_NE(Begin("bert"), nullptr) << "each has their own";
  second.reset();
  Make("anna", "b");
  EXPECT_EQ(Begin("anna"), nullptr) << "a, b and the third";
  ASSERT_TRUE(registry->Delete("a").ok());
  EXPECT_NE(Begin("anna"), nullptr);
}

TEST_F(MapQuotaTest, KnowsOwnersAfterARestart) {
  Make("anna", "a");
  Make("bert", "b");
  ASSERT_TRUE(registry->Create(MapInfo{.name = "of-nobody"}).ok());
  Start({.maps = 2});
  Make("anna", "c");
  EXPECT_EQ(Begin("anna"), nullptr);
  EXPECT_NE(Begin("bert"), nullptr);
}

TEST_F(MapQuotaTest, APrincipalBeyondItsDiskQuotaMakesAndFeedsNoMap) {
  Make("anna", "a");
  ASSERT_TRUE(registry->Create(MapInfo{.name = "of-nobody"}).ok());
  Start({.disk_bytes = 1});
  EXPECT_TRUE(quota->CheckFeed(registry->Get("a")->info).ok()) << "there is nothing in it";
  Start({.disk_bytes = 0});
  EXPECT_EQ(quota->CheckFeed(registry->Get("a")->info).reason(), Reason("OUT_OF_QUOTA"));
  EXPECT_TRUE(quota->CheckFeed(registry->Get("of-nobody")->info).ok());
  EXPECT_EQ(Begin("anna"), nullptr);
  EXPECT_EQ(reason, Reason("OUT_OF_QUOTA"));
}

TEST_F(MapQuotaTest, DoesNotLimitCallersWithoutKeys) {
  const auto open = auth::Gate::Open();
  MapQuota without(*open, *registry);
  const auto making = without.Begin(Caller());
  ASSERT_TRUE(making.ok());
  EXPECT_EQ(*making, nullptr);
  EXPECT_TRUE(without.CheckFeed(MapInfo{.history_id = 7}).ok());
}

TEST_F(MapQuotaTest, AMapThatAnotherServerNotesCountsHere) {
  const auto tables = std::make_shared<testing::FakeAuthTables>();
  const auto shared = auth::Gate::WithKeys({.key_file = key_file,
                                            .owners = std::make_shared<auth::MapOwnersTable>(tables),
                                            .limits = {.maps = 2},
                                            .look_s = 0})
                          .value();
  MapQuota here(*shared, *registry);
  ASSERT_TRUE(here.Begin(CallerNamed("anna")).ok());
  for (const char* map : {"a", "b"}) {
    ASSERT_TRUE(tables->AddMapMaker(registry->Create(MapInfo{.name = map})->info.history_id, "anna").ok());
  }
  EXPECT_EQ(here.Begin(CallerNamed("anna")).status().reason(), Reason("OUT_OF_QUOTA"));
  EXPECT_TRUE(here.Begin(CallerNamed("bert")).ok());
}

TEST_F(MapQuotaTest, ADatabaseThatDoesNotAnswerKeepsNoRobotOut) {
  const auto tables = std::make_shared<testing::FakeAuthTables>();
  const auto shared = auth::Gate::WithKeys({.key_file = key_file,
                                            .owners = std::make_shared<auth::MapOwnersTable>(tables),
                                            .limits = {.disk_bytes = 0},
                                            .look_s = 0})
                          .value();
  MapQuota here(*shared, *registry);
  const MapInfo map = registry->Create(MapInfo{.name = "a"})->info;
  ASSERT_TRUE(tables->AddMapMaker(map.history_id, "anna").ok());
  EXPECT_EQ(here.CheckFeed(map).reason(), Reason("OUT_OF_QUOTA"));
  tables->FailWith(Unavailable("gone"));
  EXPECT_TRUE(here.CheckFeed(map).ok());
  EXPECT_EQ(here.Begin(CallerNamed("bea")).status().code(), StatusCode::kUnavailable) << "maps are not made meanwhile";
}

TEST_F(MapQuotaTest, TheFileDoesNotGrowWithDeletedMaps) {
  for (int i = 0; i < 2500; ++i) {
    Make("anna", "a");
    ASSERT_TRUE(registry->Delete("a").ok());
  }
  EXPECT_LE(gate->owners()->size(), 1002u);
}

}  // namespace
}  // namespace dhpmap

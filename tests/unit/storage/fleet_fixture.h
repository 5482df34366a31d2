// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>

#include <atomic>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "storage/postgres/fleet/fleet_member.h"
#include "storage/postgres_store.h"
#include "tests/support/assert_ok.h"
#include "tests/support/cut_connection.h"
#include "tests/support/postgres_cluster.h"
#include "tests/unit/storage/map_fixtures.h"

namespace dhpmap::testing {

/// Servers on one database, which beat when the test says so, by a clock that goes as the test says.
class FleetOfStores : public ::testing::Test {
 protected:
  static constexpr std::int64_t kSecond = 1'000'000'000;

  /// A process.
  struct Server {
    std::unique_ptr<MapStore> store;
    [[nodiscard]] postgres::FleetMember& fleet() const { return static_cast<postgres::FleetMember&>(*store->fleet()); }
  };

  void SetUp() override {
    if (PostgresCluster::Get() == nullptr) GTEST_SKIP() << PostgresCluster::WhyThereIsNone();
    schema_ = PostgresCluster::Get()->NewSchema();
  }
  [[nodiscard]] PostgresStoreOptions OptionsOf(const std::string& address) {
    return {.schema = schema_,
            .max_connections = 3,
            .answer_s = 20,
            .fleet = {.address = address,
                      .version = "1.0",
                      .beats_by_itself = false,
                      .time_ns = [this] { return now_ns_.load(); },
                      .await_beats = [] {}}};
  }
  Server Open(const std::string& address, const std::string& url = PostgresCluster::Get()->Url()) {
    return Open(OptionsOf(address), url);
  }
  Server Open(const PostgresStoreOptions& options, const std::string& url = PostgresCluster::Get()->Url()) {
    auto opened = OpenPostgresStore(url, options);
    EXPECT_OK(opened);
    return {opened.ok() ? std::move(opened).value() : nullptr};
  }
  /// Time goes on, during which these beat.
  void Pass(double seconds, const std::vector<Server*>& beating) {
    constexpr int kSteps = 10;
    for (int n = 0; n < kSteps; ++n) {
      now_ns_ += static_cast<std::int64_t>(seconds * 1e9 / kSteps);
      for (const Server* server : beating) ASSERT_OK(server->fleet().Beat());
    }
  }
  std::unique_ptr<Map> Create(const Server& server, const std::string& name = "house") {
    auto map = std::make_unique<Map>(generator_.Info(name));
    for (int n = 0; n < 3; ++n) generator_.AddSubmap(*map, 8);
    EXPECT_OK(server.store->CreateMap(*map->Publish(11)));
    return map;
  }
  /// Commits some change.
  Status Commit(const Server& server, Map& map) {
    const auto before = map.published();
    generator_.Change(map);
    return server.store->Commit(*before, *map.Publish(++time_ns_), Durability::kFull);
  }
  /// What a refused commit, or load, says of the owner.
  static std::string OwnerIn(const Status& status) {
    EXPECT_EQ(status.code(), StatusCode::kUnavailable) << status.ToString();
    EXPECT_EQ(status.reason(), Reason("NOT_OWNER")) << status.ToString();
    for (const auto& [key, value] : status.metadata()) {
      if (key == "owner") return value;
    }
    return "";
  }
  std::int64_t EpochOf(const Server& server, const std::string& map = "house") {
    const auto owner = server.fleet().OwnerOf(map);
    EXPECT_OK(owner);
    return owner.ok() ? owner->epoch : -1;
  }

  std::atomic<std::int64_t> now_ns_ = 1000 * kSecond;
  MapGenerator generator_{23};
  std::int64_t time_ns_ = 100;
  std::string schema_;
};

}  // namespace dhpmap::testing

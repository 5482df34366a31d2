// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>

#include <memory>
#include <string>

#include "storage/store.h"
#include "tests/unit/storage/map_fixtures.h"

namespace dhpmap::testing {

/// A store of any kind, and maps for it.
class StoreSamples {
 protected:
  /// A map of some 25 blocks, in the store.
  std::unique_ptr<Map> CreateSample(const std::string& name) {
    auto map = std::make_unique<Map>(generator_.Info(name));
    for (int n = 0; n < 3; ++n) generator_.AddSubmap(*map, 8);
    for (int n = 0; n < 3; ++n) generator_.AddVoxels(map->mutable_free_space());
    const Status created = store_->CreateMap(*map->Publish(11));
    EXPECT_TRUE(created.ok()) << created.ToString();
    return map;
  }

  void ExpectStored(const MapSnapshot& expected) {
    const auto loaded = store_->LoadMap(expected.info().name);
    ASSERT_TRUE(loaded.ok()) << loaded.status().ToString();
    ExpectSameMap(expected, **loaded);
  }

  MapGenerator generator_{9};
  std::unique_ptr<MapStore> store_;
};

/// No status that may reach a client shows a path or SQL.
inline void ExpectDiscreet(const Status& status, const std::string& path) {
  EXPECT_EQ(status.ToString().find(path), std::string::npos) << status.ToString();
  for (const char* word : {"SELECT", "INSERT", "UPDATE", "PRAGMA", "tile_blobs"}) {
    EXPECT_EQ(status.ToString().find(word), std::string::npos) << status.ToString();
  }
}

}  // namespace dhpmap::testing

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <memory>
#include <utility>

#include "mapping/paging/tile_spill.h"
#include "storage/sqlite_store.h"
#include "storage/store.h"
#include "tests/integration/test_server.h"
#include "tests/support/scenes.h"

namespace dhpmap::testing {

/// A server on a database in its own folder; it can be restarted.
class ServerOnFile : public ::testing::Test {
 protected:
  void SetUp() override { Start(); }
  void TearDown() override { server.reset(); }

  void Start() {
    auto opened = OpenSqliteStore((dir.path() / "maps.db").string(), {.pages_tiles = page_bytes > 0});
    ASSERT_OK(opened);
    store = std::move(*opened);
    auto spill = page_bytes > 0 ? OpenTileSpill(dir.path().string()).value() : nullptr;
    server = std::make_unique<TestServer>(
        *store, OpenMapOptions{.pages = {.budget_bytes = page_bytes, .spill = std::move(spill)}});
  }
  void Restart() {
    ASSERT_OK(server->Stop());
    server.reset();
    store.reset();
    Start();
  }

  TempDir dir;
  std::int64_t page_bytes = 0;  ///< of the next server: see OpenMapOptions
  std::unique_ptr<MapStore> store;
  std::unique_ptr<TestServer> server;
};

}  // namespace dhpmap::testing

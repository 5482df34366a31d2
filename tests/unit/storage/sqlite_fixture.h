// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <memory>
#include <string>

#include "storage/sqlite/database.h"
#include "storage/sqlite_store.h"
#include "storage/store.h"
#include "tests/support/scenes.h"
#include "tests/unit/storage/store_samples.h"

namespace dhpmap::testing {

/// A SQLite store in a folder of its own, and access to its file behind its back.
class SqliteStoreTest : public ::testing::Test, protected StoreSamples {
 protected:
  [[nodiscard]] std::string Path() const { return (folder_.path() / "maps.db").string(); }

  Status TryOpen(bool read_only = false) {
    store_ = nullptr;
    auto opened = OpenSqliteStore(Path(), {.read_only = read_only, .busy_timeout_ms = 50, .pages_tiles = pages_tiles_});
    if (!opened.ok()) return opened.status();
    store_ = std::move(opened).value();
    return Status::Ok();
  }

  void Open(bool read_only = false) {
    const Status opened = TryOpen(read_only);
    ASSERT_TRUE(opened.ok()) << opened.ToString();
  }

  void OpenWith(const EditLogLimits& limits) {
    store_ = nullptr;
    auto opened = OpenSqliteStore(Path(), {.edits = limits});
    ASSERT_TRUE(opened.ok()) << opened.status().ToString();
    store_ = std::move(opened).value();
  }

  /// Runs SQL of our own on the file, as no store would.
  void Tamper(const std::string& sql) {
    auto database = sqlite::Database::Open(Path(), sqlite::OpenMode::kReadWriteOrCreate, 1000);
    ASSERT_TRUE(database.ok());
    const Status done = database->Execute(sql, "tamper");
    ASSERT_TRUE(done.ok()) << done.ToString();
  }

  std::int64_t Query(const std::string& sql) {
    auto database = sqlite::Database::Open(Path(), sqlite::OpenMode::kReadOnly, 1000);
    return database.ok() ? database->QueryInt(sql, "look").value() : -1;
  }

  void WriteFile(const std::string& bytes) { std::ofstream(Path(), std::ios::binary) << bytes; }

  TempDir folder_;
  bool pages_tiles_ = false;  ///< of the store that is opened next
};

}  // namespace dhpmap::testing

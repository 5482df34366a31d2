// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "storage/postgres_store.h"
#include "storage/sqlite_store.h"
#include "storage/store.h"
#include "tests/support/postgres_cluster.h"
#include "tests/support/scenes.h"

namespace dhpmap::testing {

/// What holds the maps. In the paged ones voxels stay until they are read.
enum class StoreKind { kMemory, kSqlite, kPaged, kPostgres, kPagedPostgres };

/// Those that the suite of what every MapStore promises runs on, and all that keep their maps when they are closed.
inline std::vector<StoreKind> AllStores() { return {StoreKind::kMemory, StoreKind::kSqlite, StoreKind::kPostgres}; }
inline std::vector<StoreKind> StoresThatKeep() { return {StoreKind::kSqlite, StoreKind::kPostgres}; }
inline std::vector<StoreKind> StoresThatPage() { return {StoreKind::kPaged, StoreKind::kPagedPostgres}; }

inline std::string NameOfKind(const ::testing::TestParamInfo<StoreKind>& kind) {
  switch (kind.param) {
    case StoreKind::kMemory: return "Memory";
    case StoreKind::kSqlite: return "Sqlite";
    case StoreKind::kPaged: return "Paged";
    case StoreKind::kPostgres: return "Postgres";
    case StoreKind::kPagedPostgres: return "PagedPostgres";
  }
  return "";
}

struct KeptStoreOptions {
  ChangeHistoryLimits changes = {};
  EditLogLimits edits = {};
  std::function<std::int64_t()> passing_time_ns = {};
  bool reads_all = false;  ///< a paged store opens as one that is not
};

/// A place for maps, and stores that are opened on it one after the other.
class KeptStore {
 public:
  explicit KeptStore(StoreKind kind) : kind_(kind) { BeginAnew(); }

  /// False: the test is to be skipped.
  [[nodiscard]] bool IsThere() const { return !IsPostgres() || PostgresCluster::Get() != nullptr; }

  /// Opens a store on what the last one left; `store` is closed before. One in memory goes on, with its own options.
  void Open(std::unique_ptr<MapStore>& store, const KeptStoreOptions& options = {}) {
    if (!IsThere()) return;
    if (kind_ == StoreKind::kMemory) {
      if (!store) store = MakeMemoryStore(options.changes, options.edits, options.passing_time_ns);
      return;
    }
    store = nullptr;
    auto opened = IsPostgres() ? OpenPostgres(options) : OpenSqlite(options);
    ASSERT_TRUE(opened.ok()) << opened.status().ToString();
    store = std::move(opened).value();
  }
  /// What is opened next is empty.
  void BeginAnew() {
    std::filesystem::remove(Path());
    if (IsPostgres() && IsThere()) schema_ = PostgresCluster::Get()->NewSchema();
  }
  [[nodiscard]] const std::string& schema() const { return schema_; }
  /// Of the files that belong to it.
  [[nodiscard]] std::string Folder() const { return folder_.path().string(); }

  /// Of SQLite.
  [[nodiscard]] std::string Path() const { return (folder_.path() / "maps.db").string(); }
  [[nodiscard]] StoreKind kind() const { return kind_; }
  [[nodiscard]] bool IsPostgres() const { return kind_ == StoreKind::kPostgres || kind_ == StoreKind::kPagedPostgres; }

 private:
  [[nodiscard]] Result<std::unique_ptr<MapStore>> OpenPostgres(const KeptStoreOptions& options) const {
    return OpenPostgresStore(PostgresCluster::Get()->Url(),
                             {.schema = schema_,
                              .changes = options.changes,
                              .edits = options.edits,
                              .max_connections = 4,
                              .pages_tiles = kind_ == StoreKind::kPagedPostgres && !options.reads_all,
                              .transit_folder = Folder(),
                              .passing_time_ns = options.passing_time_ns});
  }
  [[nodiscard]] Result<std::unique_ptr<MapStore>> OpenSqlite(const KeptStoreOptions& options) const {
    return OpenSqliteStore(Path(), {.changes = options.changes,
                                    .edits = options.edits,
                                    .pages_tiles = kind_ == StoreKind::kPaged && !options.reads_all,
                                    .passing_time_ns = options.passing_time_ns});
  }

  const StoreKind kind_;
  TempDir folder_;
  std::string schema_;
};

/// Skips the test where the store of its kind cannot be had.
#define DHPMAP_SKIP_UNLESS_THERE(kept) \
  if (!(kept).IsThere()) GTEST_SKIP() << ::dhpmap::testing::PostgresCluster::WhyThereIsNone()

}  // namespace dhpmap::testing

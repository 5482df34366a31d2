// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <utility>

#include "mapping/base/thread_pool.h"
#include "storage/commit_rules.h"
#include "storage/connection.h"
#include "storage/file_lock.h"
#include "storage/map_rows.h"
#include "storage/snapshot_reader.h"
#include "storage/snapshot_writer.h"
#include "storage/sqlite/transaction.h"
#include "storage/store.h"
#include "storage/submap_rows.h"

namespace dhpmap {
namespace {

using sqlite::Database;
using sqlite::Transaction;

/// Encoding and decoding gain little beyond that: SQLite itself takes as long on one.
constexpr int kMaxThreads = 2;

int NumThreads() { return std::min(kMaxThreads, std::max(1, static_cast<int>(std::thread::hardware_concurrency()))); }

/// What makes a store a writer: the only one of its database.
struct Writer {
  FileLock lock;  // first, so that it outlives the connection
  Database database;
  ThreadPool pool{NumThreads()};
  Durability durability = Durability::kNormal;

  Writer(FileLock file_lock, Database connection) : lock(std::move(file_lock)), database(std::move(connection)) {}
};

Result<StoredMap> Describe(Database& database, const std::string& name) {
  DHPMAP_ASSIGN_OR_RETURN(MapRow row, ReadMap(database, name));
  DHPMAP_ASSIGN_OR_RETURN(sqlite::Statement sums,
                          database.Prepare("SELECT total(num_tsdf_blocks), total(num_label_blocks), total(blob_bytes) "
                                           "FROM submaps WHERE map_key = ?",
                                           "count the map's blocks"));
  DHPMAP_ASSIGN_OR_RETURN(const bool has_row, sums.Bind(row.key).Step());
  if (!has_row) return Internal("counting the map's blocks gave no row");
  return StoredMap{std::move(row.info), row.num_submaps, sums.Int(0), sums.Int(1), sums.Int(2), {}};
}

/// Errors that come from one map's rows, not from the database as a whole.
bool IsDamage(const Status& status) {
  return status.code() == StatusCode::kDataLoss || status.code() == StatusCode::kFailedPrecondition;
}

StoredMap DamagedMap(const std::string& name, const Status& why) {
  StoredMap map;
  map.info.name = name;
  map.damage = why;
  return map;
}

class SqliteStore final : public MapStore {
 public:
  SqliteStore(std::unique_ptr<Writer> writer, std::string path, sqlite::OpenMode reader_mode, int busy_timeout_ms)
      : writer_(std::move(writer)), readers_(std::move(path), reader_mode, busy_timeout_ms) {}

  Result<std::vector<StoredMap>> ListMaps() override {
    return Read<std::vector<StoredMap>>([](Database& database) -> Result<std::vector<StoredMap>> {
      DHPMAP_ASSIGN_OR_RETURN(const std::vector<std::string> names, ReadMapNames(database));
      std::vector<StoredMap> maps;
      for (const std::string& name : names) {
        Result<StoredMap> map = Describe(database, name);
        if (!map.ok() && !IsDamage(map.status())) return map.status();
        maps.push_back(map.ok() ? std::move(map).value() : DamagedMap(name, map.status()));
      }
      return maps;
    });
  }

  Result<StoredMap> GetMap(const std::string& name) override {
    return Read<StoredMap>([&](Database& database) { return Describe(database, name); });
  }

  Result<std::shared_ptr<const MapSnapshot>> LoadMap(const std::string& name) override {
    return Read<std::shared_ptr<const MapSnapshot>>([&](Database& database) {
      ThreadPool pool(NumThreads());
      return ReadSnapshot(database, name, pool);
    });
  }

  Status CreateMap(const MapSnapshot& snapshot) override {
    DHPMAP_RETURN_IF_ERROR(ValidateMapName(snapshot.info().name));
    return Write(Durability::kFull, [&](Database& database) -> Status {
      DHPMAP_ASSIGN_OR_RETURN(const std::int64_t map_key, InsertMap(database, snapshot));
      return WriteChanges(database, map_key, DiffSnapshots(nullptr, snapshot), writer_->pool);
    });
  }

  Status Commit(const MapSnapshot& before, const MapSnapshot& after, Durability durability) override {
    DHPMAP_RETURN_IF_ERROR(ValidateCommit(before.info(), after.info()));
    return Write(durability, [&](Database& database) -> Status {
      DHPMAP_ASSIGN_OR_RETURN(const MapHead head, ReadMapHead(database, before.info().name));
      DHPMAP_RETURN_IF_ERROR(ValidateBase(before.info(), head.revision, head.create_time_ns));
      DHPMAP_RETURN_IF_ERROR(UpdateMap(database, head.key, before.info(), after));
      return WriteChanges(database, head.key, DiffSnapshots(&before, after), writer_->pool);
    });
  }

  Status DeleteMap(const std::string& name) override {
    return Write(Durability::kFull, [&](Database& database) { return DeleteMapRows(database, name); });
  }

 private:
  /// Runs `body` on one state of the database.
  template <typename T, typename Body>
  Result<T> Read(Body&& body) {
    DHPMAP_ASSIGN_OR_RETURN(ReaderPool::Lease lease, readers_.Borrow());
    DHPMAP_ASSIGN_OR_RETURN(const Transaction transaction, Transaction::BeginRead(*lease));
    return body(*lease);
  }

  /// Runs `body` as one transaction: all of it, or nothing.
  template <typename Body>
  Status Write(Durability durability, Body&& body) {
    if (writer_ == nullptr) {
      return FailedPrecondition("the database was opened read-only").WithReason("NOT_WRITABLE");
    }
    const std::lock_guard lock(writer_mutex_);
    DHPMAP_RETURN_IF_ERROR(SetDurability(durability));
    DHPMAP_ASSIGN_OR_RETURN(Transaction transaction, Transaction::BeginWrite(writer_->database));
    DHPMAP_RETURN_IF_ERROR(body(writer_->database));
    return transaction.Commit();
  }

  /// In WAL mode, synchronous = FULL syncs the log at each commit, and with it all commits before.
  Status SetDurability(Durability durability) {
    if (writer_->durability == durability) return Status::Ok();
    const char* pragma = durability == Durability::kFull ? "PRAGMA synchronous = FULL" : "PRAGMA synchronous = NORMAL";
    DHPMAP_RETURN_IF_ERROR(writer_->database.Execute(pragma, "set the durability of a commit"));
    writer_->durability = durability;
    return Status::Ok();
  }

  const std::unique_ptr<Writer> writer_;  // null: read-only
  std::mutex writer_mutex_;               // guards what writer_ points to
  ReaderPool readers_;
};

}  // namespace

Result<std::unique_ptr<MapStore>> OpenSqliteStore(const std::string& path, const SqliteStoreOptions& options) {
  const int timeout_ms = options.busy_timeout_ms;
  if (options.read_only) {
    DHPMAP_ASSIGN_OR_RETURN(const sqlite::OpenMode mode, ProbeReadOnly(path, timeout_ms));
    return std::unique_ptr<MapStore>(std::make_unique<SqliteStore>(nullptr, path, mode, timeout_ms));
  }
  DHPMAP_ASSIGN_OR_RETURN(FileLock lock, FileLock::Acquire(path));
  DHPMAP_ASSIGN_OR_RETURN(Database database, OpenWriter(path, timeout_ms));
  auto writer = std::make_unique<Writer>(std::move(lock), std::move(database));
  return std::unique_ptr<MapStore>(
      std::make_unique<SqliteStore>(std::move(writer), path, sqlite::OpenMode::kReadOnly, timeout_ms));
}

}  // namespace dhpmap

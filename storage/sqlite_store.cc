// SPDX-License-Identifier: BSD-3-Clause
#include "storage/sqlite_store.h"

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <utility>

#include "mapping/base/thread_pool.h"
#include "storage/check/sqlite_check.h"
#include "storage/commit/store_number.h"
#include "storage/commit_rules.h"
#include "storage/connection.h"
#include "storage/fair_mutex.h"
#include "storage/files/backup.h"
#include "storage/files/file_lock.h"
#include "storage/files/map_copy.h"
#include "storage/files/map_file.h"
#include "storage/files/map_import.h"
#include "storage/files/upgrade_copy.h"
#include "storage/history/change_history.h"
#include "storage/history/edit_history.h"
#include "storage/history/edit_log.h"
#include "storage/history/seen_clock.h"
#include "storage/paging/map_layers.h"
#include "storage/paging/tile_blobs.h"
#include "storage/paging/tile_cells.h"
#include "storage/rows/map_pages.h"
#include "storage/rows/map_rows.h"
#include "storage/rows/submap_rows.h"
#include "storage/snapshot_reader.h"
#include "storage/snapshot_writer.h"
#include "storage/space_reclaimer.h"
#include "storage/sqlite/free_pages.h"
#include "storage/sqlite/transaction.h"
#include "storage/store.h"

namespace dhpmap {
namespace {

using sqlite::Database;
using sqlite::Transaction;

/// Free pages to keep in the file for later data: 4 MB.
constexpr std::int64_t kNumSparePages = 1024;

/// The parts of a writing store, the only one of its database.
struct Writer {
  FileLock lock;  // first, so that it outlives the connection (the store closes its readers before)
  Database database;
  ThreadPool pool{NumCodecThreads()};
  Durability durability = Durability::kNormal;

  Writer(FileLock file_lock, Database connection) : lock(std::move(file_lock)), database(std::move(connection)) {}
};

Result<StoredMap> DescribeStored(Database& database, const std::string& name) {
  DHPMAP_ASSIGN_OR_RETURN(MapRow row, ReadMap(database, name));
  DHPMAP_ASSIGN_OR_RETURN(sqlite::Statement sums,
                          database.Prepare("SELECT total(num_tsdf_blocks), total(num_label_blocks), total(blob_bytes) "
                                           "FROM submaps WHERE map_key = ?",
                                           "count the map's blocks"));
  DHPMAP_ASSIGN_OR_RETURN(const bool has_row, sums.Bind(row.key).Step());
  if (!has_row) return Internal("counting the map's blocks gave no row");
  StoredMap map{.info = std::move(row.info), .num_submaps = row.num_submaps, .damage = {}};
  sqlite::Columns columns(sums);
  map.num_tsdf_blocks = columns.Int();
  map.num_label_blocks = columns.Int();
  map.blob_bytes = columns.Int() + row.tiles.bytes;
  DHPMAP_ASSIGN_OR_RETURN(map.lost_revisions, ReadLostRevisions(database, row.key));
  return map;
}

class SqliteStore final : public MapStore {
 public:
  SqliteStore(std::unique_ptr<Writer> writer, std::string path, sqlite::OpenMode reader_mode,
              const SqliteStoreOptions& options)
      : path_(path),
        change_limits_(options.changes),
        edit_limits_(options.edits),
        time_(options.passing_time_ns),
        writer_(std::move(writer)),
        readers_(path, reader_mode, options.busy_timeout_ms),
        paging_(options.pages_tiles ? std::make_shared<TileBlobs>(std::move(path), reader_mode, options.busy_timeout_ms)
                                    : nullptr) {}
  ~SqliteStore() override {
    if (paging_ != nullptr) paging_->Close();  // while this process holds the database
    StoreTimeSinceLastCommit();
  }
  SqliteStore(const SqliteStore&) = delete;
  SqliteStore& operator=(const SqliteStore&) = delete;

  Result<std::vector<StoredMap>> ListMaps(const std::string& after, std::size_t max) override {
    return Read<std::vector<StoredMap>>([&](Database& database) { return ReadMapPage(database, after, max); });
  }
  Result<std::vector<std::string>> ListMapNames(const std::string& after, std::size_t max) override {
    return Read<std::vector<std::string>>([&](Database& database) { return ReadMapNamesAfter(database, after, max); });
  }

  Result<StoredMap> GetMap(const std::string& name) override {
    return Read<StoredMap>([&](Database& database) { return DescribeStored(database, name); });
  }

  Result<std::shared_ptr<const MapSnapshot>> LoadMap(const std::string& name) override {
    Paging paging{.blobs = paging_, .reads_the_rest = writer_ == nullptr};
    auto map = LoadMap(name, paging);
    if (!paging.lacks_cells || writer_ == nullptr) return map;
    // If it fails, tiles are read at once, which reports errors.
    (void)NoteTileCells(
        [this](const std::function<Status(Database&)>& body) {
          return Write(Durability::kNormal, [&](Writer& writer) { return body(writer.database); });
        },
        name);
    paging.reads_the_rest = true;
    return LoadMap(name, paging);
  }

  Status CreateMap(const MapSnapshot& snapshot) override {
    DHPMAP_RETURN_IF_ERROR(ValidateMapName(snapshot.info().name));
    WrittenTiles written;
    Status done = Write(Durability::kFull, [&](Writer& writer) -> Status {
      DHPMAP_ASSIGN_OR_RETURN(const MapRow head, InsertMap(writer.database, snapshot));
      DHPMAP_ASSIGN_OR_RETURN(written, WriteState(writer, head, snapshot.info(), StateMarks(), snapshot, {}));
      return Status::Ok();
    });
    if (done.ok()) written.TellTiles(number_);
    return done;
  }

  Status Commit(const StateMarks& before, const MapSnapshot& after, Durability durability) override {
    return CommitState(before, after, durability, nullptr);
  }

  Status CommitEdit(const StateMarks& before, const MapSnapshot& after, const EditRecord& edit) override {
    return CommitState(before, after, Durability::kFull, &edit);
  }

  Result<std::vector<LoggedEdit>> ListEdits(const std::string& name, const EditQuery& query) override {
    return Read<std::vector<LoggedEdit>>([&](Database& database) -> Result<std::vector<LoggedEdit>> {
      DHPMAP_ASSIGN_OR_RETURN(const MapRow head, ReadMapHead(database, name));
      return ReadEdits(database, head, query);
    });
  }

  Result<std::optional<StoredAnswer>> FindAnswer(const std::string& name, const std::string& request_id) override {
    return Read<std::optional<StoredAnswer>>([&](Database& database) -> Result<std::optional<StoredAnswer>> {
      DHPMAP_ASSIGN_OR_RETURN(const MapRow head, ReadMapHead(database, name));
      return ReadAnswer(database, head, request_id);
    });
  }

  Result<ChangeList> ListChanges(const std::string& name, std::int64_t after_revision, std::size_t max_bytes) override {
    return Read<ChangeList>([&](Database& database) -> Result<ChangeList> {
      DHPMAP_ASSIGN_OR_RETURN(const MapRow head, ReadMapHead(database, name));
      return ReadChanges(database, head, after_revision, max_bytes);
    });
  }

  Result<StateDelta> LoadEdit(const std::string& name, std::int64_t revision) override {
    return Read<StateDelta>([&](Database& database) -> Result<StateDelta> {
      DHPMAP_ASSIGN_OR_RETURN(const MapRow head, ReadMapHead(database, name));
      return ReadHistory(database, head, revision, number_);
    });
  }

  Status DeleteMap(const std::string& name) override {
    return Write(Durability::kFull, [&](Writer& writer) { return DeleteMapRows(writer.database, name); });
  }

  Status Reserve(const std::string& name, const NumberMarks& marks) override {
    return Write(Durability::kFull, [&](Writer& writer) { return SetMarks(writer.database, name, marks); });
  }

  Result<VerifyReport> VerifyMap(const std::string& name, bool repair, const std::stop_token& stop) override {
    DHPMAP_ASSIGN_OR_RETURN(Verification found, Read<Verification>([&](Database& database) {
                              return VerifyRows(database, name, VerifyScope::kAll, stop);
                            }));
    if (repair && found.report.num_faults > 0) {
      DHPMAP_RETURN_IF_ERROR(
          Write(Durability::kFull, [&](Writer& writer) { return RepairRows(writer.database, name, found); }));
    }
    return std::move(found.report);
  }

  Result<std::unique_ptr<StoreBackup>> Backup(const std::stop_token& stop) override {
    DHPMAP_ASSIGN_OR_RETURN(ReaderPool::Lease lease, readers_.Borrow());
    return MakeBackup(*lease, path_, stop);
  }

  Result<std::unique_ptr<StoreBackup>> ExportMap(const std::string& name, const std::stop_token& stop) override {
    const std::string place = UnfinishedPath(path_);
    DHPMAP_RETURN_IF_ERROR(WriteMapFile(path_, name, place, stop));
    return OpenOnce(place);
  }

  Result<std::unique_ptr<MapImport>> ImportMap() override {
    const auto write = [this](Durability durability, const std::function<Status(Database&)>& body) {
      return Write(durability, [&](Writer& writer) { return body(writer.database); });
    };
    return BeginMapImport(UnfinishedPath(path_), [this, write](MapFile file) -> std::unique_ptr<MapTaker> {
      return std::make_unique<MapCopy>(std::move(file), ImportTarget{write, kept_});
    });
  }

  /// For a store that was just opened, before anything else: from now on, deleted data return their space.
  Status GiveSpaceBack() {
    const FairMutexLock lock(writer_mutex_);
    DHPMAP_ASSIGN_OR_RETURN(const bool is_allowed, sqlite::AllowsGivingBack(writer_->database));
    DHPMAP_ASSIGN_OR_RETURN(Database log, OpenForLog(path_));
    const auto write = [this](const std::function<Status(Database&)>& body) {
      return Write(Durability::kNormal, [&](Writer& writer) { return body(writer.database); });
    };
    const auto hold = [this](const std::function<Status()>& body) {
      const FairMutexLock held(writer_mutex_);
      return body();
    };
    reclaimer_ = std::make_unique<SpaceReclaimer>(SpaceReclaimer::Writer{write, hold}, std::move(log),
                                                  is_allowed ? kNumSparePages : SpaceReclaimer::kKeepAll, &kept_);
    return Status::Ok();
  }

  /// For a store that was just opened: see Reserve and Backup.
  Status GoOn() {
    return Write(Durability::kFull, [this](Writer& writer) -> Status {
      DHPMAP_ASSIGN_OR_RETURN(SeenClock clock, SeenClock::GoOn(writer.database, time_));
      stored_seen_ns_ = clock.Now_ns();
      clock_ = std::move(clock);
      DHPMAP_RETURN_IF_ERROR(LeaveReservedNumbers(writer.database));
      return BeginHistoriesOfBackup(writer.database);
    });
  }

 private:
  /// Runs `body` on one state of the database.
  template <typename T, typename Body>
  Result<T> Read(Body&& body) {
    DHPMAP_ASSIGN_OR_RETURN(ReaderPool::Lease lease, readers_.Borrow());
    DHPMAP_ASSIGN_OR_RETURN(const Transaction transaction, Transaction::BeginRead(*lease));
    return body(*lease);
  }

  /// Runs `body` as one transaction: completely or not at all.
  template <typename Body>
  Status Write(Durability durability, Body&& body) {
    if (writer_ == nullptr) {
      return FailedPrecondition("the database was opened read-only").WithReason("NOT_WRITABLE");
    }
    const FairMutexLock lock(writer_mutex_);
    DHPMAP_RETURN_IF_ERROR(SetDurability(*writer_, durability));
    DHPMAP_ASSIGN_OR_RETURN(Transaction transaction, Transaction::BeginWrite(writer_->database));
    DHPMAP_RETURN_IF_ERROR(body(*writer_));
    DHPMAP_RETURN_IF_ERROR(transaction.Commit());
    writer_->database.ReleaseMemory();
    if (reclaimer_ == nullptr) return Status::Ok();
    const Result<std::int64_t> num_free_pages = sqlite::NumFreePages(writer_->database);
    const Result<bool> has_dead_blobs = HasDeadBlobs(writer_->database, kept_);
    if (num_free_pages.ok() && has_dead_blobs.ok()) {
      reclaimer_->Notice({*num_free_pages, *has_dead_blobs, writer_->database.NumLogBytes()});
    }
    return Status::Ok();
  }

  Result<std::shared_ptr<const MapSnapshot>> LoadMap(const std::string& name, Paging& paging) {
    return Read<std::shared_ptr<const MapSnapshot>>([&](Database& database) {
      ThreadPool pool(NumCodecThreads());
      return ReadSnapshot(database, name, number_, pool, paging.blobs != nullptr ? &paging : nullptr);
    });
  }

  /// `edit`: the edit that made `after`, or null.
  Status CommitState(const StateMarks& before, const MapSnapshot& after, Durability durability,
                     const EditRecord* edit) {
    DHPMAP_RETURN_IF_ERROR(ValidateCommit(before.info(), after.info()));
    WrittenTiles written;
    Status done = Write(durability, [&](Writer& writer) -> Status {
      DHPMAP_ASSIGN_OR_RETURN(const MapRow head, ReadMapHead(writer.database, before.info().name));
      DHPMAP_RETURN_IF_ERROR(ValidateBase(before.info(), head.info.revision, head.info.create_time_ns));
      if (edit == nullptr) {
        DHPMAP_ASSIGN_OR_RETURN(auto left, RecorderOfLeft(writer.database, head));
        const Writing writing{.layers = left ? &*left : nullptr};
        DHPMAP_ASSIGN_OR_RETURN(written, WriteState(writer, head, before.info(), before, after, writing));
        return left ? AddToHistory(writer.database, *left, clock_->Now_ns(), edit_limits_) : Status::Ok();
      }
      if (before.lacks_left()) return FailedPrecondition("the edit before left something").WithReason("STALE_STATE");
      DHPMAP_ASSIGN_OR_RETURN(const std::int64_t key,
                              RecordEdit(writer.database, head.key, *edit, clock_->Now_ns(), edit_limits_));
      // The undo data of an undo are those of the original edit.
      const bool is_kept = edit->entry.summary.kind == EditKind::kEdit && edit_limits_.max_histories > 0;
      DHPMAP_ASSIGN_OR_RETURN(EditTileRecorder recorder, EditTileRecorder::Prepare(writer.database, key));
      EditTileRecorder* const noted = is_kept ? &recorder : nullptr;
      const Writing writing{.layers = noted, .objects = noted, .cleared = edit->cleared, .lacks_left = true};
      DHPMAP_ASSIGN_OR_RETURN(written, WriteState(writer, head, before.info(), before, after, writing));
      if (is_kept) DHPMAP_RETURN_IF_ERROR(RecordHistory(writer.database, head.key, key, *edit, after, recorder));
      return TrimHistories(writer.database, head.key, clock_->Now_ns(), edit_limits_);
    });
    if (done.ok()) written.TellTiles(number_);
    return done;
  }

  /// Additional records of a commit.
  struct Writing {
    EditTileRecorder* layers = nullptr;   ///< records the map's own tiles
    EditTileRecorder* objects = nullptr;  ///< records tiles of objects
    std::vector<RegionEvent> cleared = {};
    bool lacks_left = false;  ///< space vacated by MapSnapshot::leaving() is written by a later commit
  };

  /// Writes the differences between two states of the map whose row is `head`.
  Result<WrittenTiles> WriteState(Writer& writer, const MapRow& head, const MapInfo& info_before,
                                  const StateMarks& before, const MapSnapshot& after, const Writing& writing) {
    const MapLayersToWrite layers{*after.free_space(), writing.lacks_left ? *after.noted_vacated() : *after.vacated()};
    DHPMAP_ASSIGN_OR_RETURN(TileRows tile_rows, TileRows::Prepare(writer.database));
    DHPMAP_ASSIGN_OR_RETURN(const TileTotals tiles,
                            WriteMapLayers(tile_rows, OwnerOfMap(head.key), head, before, layers, writing.layers));
    const StoredLayersOfMap stored{tiles, writing.lacks_left ? after.leaving() : std::nullopt};
    DHPMAP_RETURN_IF_ERROR(UpdateMap(writer.database, head, info_before, after, stored));
    const std::vector<SubmapTileChange> changes = DiffTiles(before, after);
    DHPMAP_ASSIGN_OR_RETURN(SubmapRowWriter submap_rows, SubmapRowWriter::Prepare(writer.database));
    DHPMAP_ASSIGN_OR_RETURN(WrittenTiles written, WriteChanges(submap_rows, tile_rows, head.key, changes, number_,
                                                               writer.pool, writing.objects));
    if (before.revision() != after.revision()) {
      const std::int64_t now_ns = clock_->Now_ns();
      DHPMAP_RETURN_IF_ERROR(RecordChange(writer.database, head.key, after.info(),
                                          DescribeChange(before, after, changes, writing.cleared), now_ns,
                                          change_limits_));
      DHPMAP_RETURN_IF_ERROR(StoreSeenTime(writer.database, now_ns));
      stored_seen_ns_ = now_ns;
    }
    DHPMAP_RETURN_IF_ERROR(CollectBacklog(writer.database, written.num_new_blobs(), kept_));
    return written;
  }

  /// At shutdown; otherwise time would not advance for a server that only answers queries.
  void StoreTimeSinceLastCommit() {
    constexpr std::int64_t kWorthACommit_ns = 60'000'000'000;
    if (!clock_ || clock_->Now_ns() - stored_seen_ns_ < kWorthACommit_ns) return;
    // If it fails, data are kept a little longer.
    (void)Write(Durability::kNormal,
                [this](Writer& writer) { return StoreSeenTime(writer.database, clock_->Now_ns()); });
  }

  /// In WAL mode, synchronous = FULL syncs the log at each commit, including all earlier commits.
  static Status SetDurability(Writer& writer, Durability durability) {
    if (writer.durability == durability) return Status::Ok();
    const char* pragma = durability == Durability::kFull ? "PRAGMA synchronous = FULL" : "PRAGMA synchronous = NORMAL";
    DHPMAP_RETURN_IF_ERROR(writer.database.Execute(pragma, "set the durability of a commit"));
    writer.durability = durability;
    return Status::Ok();
  }

  const std::string path_;
  const std::uint16_t number_ = NextStoreNumber();
  const ChangeHistoryLimits change_limits_;
  const EditLogLimits edit_limits_;
  const PassingTime time_;
  std::optional<SeenClock> clock_;                // none: read-only
  std::atomic<std::int64_t> stored_seen_ns_ = 0;  // lower bound: may be of a failed commit
  FairMutex writer_mutex_;  // fair, because consecutive commits would otherwise starve the reclaimer
  const std::unique_ptr<Writer> writer_ DHPMAP_PT_GUARDED_BY(writer_mutex_);  // null: read-only
  ReaderPool readers_;
  const std::shared_ptr<TileBlobs> paging_;  // null: maps are read completely
  KeptBlobs kept_;
  std::unique_ptr<SpaceReclaimer> reclaimer_;  // last, because it uses all others; null: read-only
};

}  // namespace

Result<std::unique_ptr<MapStore>> OpenSqliteStore(const std::string& path, const SqliteStoreOptions& options) {
  const int timeout_ms = options.busy_timeout_ms;
  if (options.read_only) {
    const auto mode = ProbeReadOnly(path, timeout_ms);
    if (!mode.ok()) return WithWayBack(mode.status(), path);
    return std::unique_ptr<MapStore>(std::make_unique<SqliteStore>(nullptr, path, *mode, options));
  }
  DHPMAP_ASSIGN_OR_RETURN(FileLock lock, FileLock::Acquire(path));
  auto database =
      OpenWriter(path, timeout_ms, {.is_kept = options.keeps_copy_before_migration, .progress = options.on_progress});
  if (!database.ok()) return WithWayBack(database.status(), path);
  RemoveUnfinishedBackups(path);
  auto writer = std::make_unique<Writer>(std::move(lock), std::move(*database));
  auto store = std::make_unique<SqliteStore>(std::move(writer), path, sqlite::OpenMode::kReadOnly, options);
  DHPMAP_RETURN_IF_ERROR(store->GiveSpaceBack());
  DHPMAP_RETURN_IF_ERROR(store->GoOn());
  return std::unique_ptr<MapStore>(std::move(store));
}

std::int64_t SqliteMemoryBytes() { return Database::BytesInUse(); }

}  // namespace dhpmap

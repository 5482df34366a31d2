// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <stop_token>
#include <string>
#include <string_view>
#include <vector>

#include "mapping/base/result.h"
#include "mapping/changes/map_change.h"
#include "mapping/changes/state_delta.h"
#include "mapping/changes/state_marks.h"
#include "mapping/map/edit_entry.h"
#include "mapping/map/lost_revisions.h"
#include "mapping/map/map.h"
#include "mapping/paging/tile_spill.h"
#include "storage/fleet.h"

namespace dhpmap {

/// Durability of a commit when it returns: kNormal survives a killed process, kFull also a power cut.
enum class Durability { kNormal, kFull };

/// Numbers of a map that may be visible to clients before their state is stored.
struct NumberMarks {
  std::int64_t revision = 0;   ///< the last revision
  SubmapId next_submap_id{0};  ///< the first id that is not in use
};

/// A stored map without its submaps.
struct StoredMap {
  MapInfo info;
  std::int64_t num_submaps = 0;
  LostRevisions lost_revisions;  ///< see MapStore::Reserve
  // From GetMap only, as they are summed up over the submaps:
  std::int64_t num_tsdf_blocks = 0;
  std::int64_t num_label_blocks = 0;
  std::int64_t blob_bytes = 0;  ///< size of the encoded tiles; a clone's shared tiles count again
  /// From ListMaps: why the map cannot be read; then only info.name is valid.
  Status damage;
};

StoredMap DamagedMap(const std::string& name, const Status& why);

/// A defect of a stored map, and its place.
struct MapFault {
  enum class Kind {
    kRow,        ///< a row has a wrong checksum
    kBlob,       ///< a tile is missing or damaged
    kCount,      ///< a row's count or sum of tiles is wrong
    kBounds,     ///< a sphere or box does not contain its object
    kReference,  ///< unreferenced blobs or rows, or wrong reference counts: of the whole store, or of edits
  };
  Kind kind = Kind::kRow;
  std::string place;  ///< "submap 3: tsdf tile (1, -2, 0)"
  std::string what;   ///< continues the sentence after the place
};

/// A block in which two inactive objects hold the same voxels.
struct SharedPlace {
  SubmapId first, second;
  BlockIndex block;
  std::int64_t num_voxels = 0;
};

struct VerifyReport {
  static constexpr std::size_t kMaxFaults = 1000;
  static constexpr std::size_t kMaxSharedPlaces = 100;

  std::int64_t revision = 0;  ///< revision that was verified; after a repair, the new one
  std::int64_t num_submaps = 0;
  std::int64_t num_tiles = 0;   ///< layers of tiles that were read
  std::int64_t num_blocks = 0;  ///< layers of blocks in them
  std::int64_t blob_bytes = 0;
  /// Voxels that several inactive objects hold on the map's grid: none after a full refinement. -1: the map is too
  /// large to tell.
  std::int64_t num_shared_voxels = 0;
  std::vector<SharedPlace> shared_places;  ///< the first of them
  std::int64_t num_faults = 0;
  std::vector<MapFault> faults;  ///< the first of them
  bool is_repaired = false;      ///< unreadable data were dropped; the faults list them
};

/// Limits of the kept changes of each map. Later commits delete the excess, oldest first. Ages count the time in which
/// a store was open for writing, independent of the system clock.
struct ChangeHistoryLimits {
  std::int64_t max_changes = 10'000;
  std::int64_t max_bytes = 32 << 20;  ///< as stored
  double max_age_s = 86'400;
};

/// Changes of commits, in order.
struct ChangeList {
  std::uint64_t history_id = 0;     ///< of the map
  std::int64_t revision = 0;        ///< of the map as it is stored
  std::int64_t complete_after = 0;  ///< changes of all later revisions are kept
  /// Consecutive; revisions between two of them changed nothing.
  std::vector<std::shared_ptr<const MapChange>> changes;
  bool has_more = false;  ///< there are more, up to `revision`
};

/// Limits of each map's edit log, and with it of the answers to repeated requests. Later edits delete the excess,
/// oldest first. Ages as in ChangeHistoryLimits.
struct EditLogLimits {
  std::int64_t max_edits = 100'000;
  std::int64_t max_bytes = 64 << 20;  ///< as they are stored
  double max_age_s = 2'592'000;
  // Limits of undo data; bytes count the tiles that they keep. An edit that alone exceeds them has none.
  std::int64_t max_histories = 1'000;
  std::int64_t max_history_bytes = 256 << 20;
  double max_history_age_s = 86'400;
};

/// An edit to be stored with its state.
struct EditRecord {
  EditEntry entry;
  std::string answer;                         ///< answer to its request, if that has an id; opaque to the store
  std::shared_ptr<const MapSnapshot> before;  ///< the last committed state, which the edit started from
  std::vector<RegionEvent> cleared = {};      ///< reported with the change, not in the log
};

/// An edit of the log.
struct LoggedEdit {
  EditEntry entry;
  bool is_undone = false;  ///< and not redone since
  bool is_kept = false;    ///< its undo data are kept
};

/// A filter of the log.
struct EditQuery {
  std::optional<std::int64_t> before_revision;  ///< only older ones
  std::optional<std::string> author;
  std::size_t max_edits = 100;
};

/// The answer to a request with an id.
struct StoredAnswer {
  std::int64_t revision = 0;
  std::uint64_t request_fingerprint = 0;
  std::string answer;
};

/// A copy of a whole store, as a file of its own. Thread-compatible.
class StoreBackup {
 public:
  virtual ~StoreBackup() = default;
  [[nodiscard]] virtual std::int64_t size_bytes() const = 0;
  /// The next part; empty at the end.
  virtual Result<std::string> Read(std::size_t max_bytes) = 0;
};

/// A map being imported from a file. Must not outlive its store; discards unfinished work. Thread-compatible.
class MapImport {
 public:
  virtual ~MapImport() = default;
  /// The next part of the file. RESOURCE_EXHAUSTED if the disk is full.
  virtual Status Write(std::string_view piece) = 0;
  // Then, once each, in this order, as long as all return OK:
  /// Verifies the file as VerifyMap does. Returns the map's name. INVALID_ARGUMENT, reason BAD_MAP; DATA_LOSS,
  /// DAMAGED_MAP; FAILED_PRECONDITION, NEWER_SCHEMA, NEWER_CONFIG, RETIRED_CONFIG or NEWER_LAYER; CANCELLED.
  virtual Result<std::string> LookThrough(const std::stop_token& stop) = 0;
  /// Copies the blobs into the store, still unreferenced, in steps of milliseconds between commits. CANCELLED,
  /// RESOURCE_EXHAUSTED.
  virtual Status Bring(const std::stop_token& stop) = 0;
  /// Adds the whole map under `name`, atomically; commits of other maps wait meanwhile, some microseconds a tile. The
  /// map has a new history, so watchers list it first. INVALID_ARGUMENT for a bad name; ALREADY_EXISTS.
  virtual Status Add(const std::string& name) = 0;
};

/// A committed state of a map that another process may write.
struct StateToRead {
  std::shared_ptr<const MapSnapshot> snapshot = nullptr;
  // The store's own:
  std::int64_t map_key = 0;
  std::int64_t commit_id = 0;
  std::uint16_t store = 0;  ///< of the storage keys of its tiles
};

/// Stores maps, whatever holds them: sqlite_store.h opens one in a file. Thread-safe: calls on different maps, and
/// reads, run concurrently; commits are serialised inside. Every error is typed: NOT_FOUND, ALREADY_EXISTS,
/// RESOURCE_EXHAUSTED (disk full), FAILED_PRECONDITION (read-only, too new, or in use by another process), DATA_LOSS
/// (checksum, not a database), UNAVAILABLE.
class MapStore {
 public:
  virtual ~MapStore() = default;

  /// The processes that share this store; null: there is this one only.
  [[nodiscard]] virtual Fleet* fleet() { return nullptr; }

  /// By ascending name, from the first after `after` on, at most `max`: fewer only at the end. Includes damaged maps,
  /// so that the others can be served. Linear in the page, whatever the maps hold.
  virtual Result<std::vector<StoredMap>> ListMaps(const std::string& after, std::size_t max) = 0;
  /// All of them, page by page.
  Result<std::vector<StoredMap>> ListMaps();
  /// The names alone, likewise.
  virtual Result<std::vector<std::string>> ListMapNames(const std::string& after, std::size_t max);
  virtual Result<StoredMap> GetMap(const std::string& name) = 0;

  /// Adds a complete map. ALREADY_EXISTS if its name is in use.
  virtual Status CreateMap(const MapSnapshot& snapshot) = 0;

  /// Writes the difference between two states of a map in one transaction. `before` are marks of the last committed (or
  /// created, or loaded) state, which itself need not be kept; FAILED_PRECONDITION if the store holds another revision.
  virtual Status Commit(const StateMarks& before, const MapSnapshot& after, Durability durability) = 0;

  /// Complete changes of the commits after `after_revision`: as many as fit into `max_bytes` of memory, at least one if
  /// there is any. Includes a commit that spans `after_revision`, because part of it may be later, and the creation of
  /// the map. Changes are written with their commit, so each exists if and only if its state does. NOT_FOUND;
  /// OUT_OF_RANGE, reason COMPACTED, with `oldest_revision` in the metadata, if changes after `after_revision` are not
  /// kept; DATA_LOSS, reason DAMAGED_CHANGES, which does not affect the map itself.
  virtual Result<ChangeList> ListChanges(const std::string& name, std::int64_t after_revision, std::size_t max_bytes) {
    (void)name, (void)after_revision, (void)max_bytes;
    return Status(StatusCode::kUnimplemented, "this store keeps no changes");
  }

  /// Commits the state of an edit with a full sync: log entry and answer exist if and only if the state is stored.
  /// Linear in the edit's changes: the old place of MapSnapshot::leaving() is written by the next commit (StateMarks
  /// with `lacks_left`), and until then computed after loading. FAILED_PRECONDITION if `before` lacks such a place.
  /// This default keeps no log.
  virtual Status CommitEdit(const StateMarks& before, const MapSnapshot& after, const EditRecord& edit) {
    (void)edit;
    return Commit(before, after, Durability::kFull);
  }
  /// The log of a map's edits, the newest first. NOT_FOUND; DATA_LOSS, reason DAMAGED_EDITS, which does not affect the
  /// map itself.
  virtual Result<std::vector<LoggedEdit>> ListEdits(const std::string& name, const EditQuery& query) {
    (void)name, (void)query;
    return std::vector<LoggedEdit>();
  }
  /// The answer to a request of this (non-empty) id; nothing if the log has none. Errors as ListEdits.
  virtual Result<std::optional<StoredAnswer>> FindAnswer(const std::string& name, const std::string& request_id) {
    (void)name, (void)request_id;
    return std::optional<StoredAnswer>();
  }

  /// The changes of an edit (kEdit only), for undo and redo, as long as the limits keep them. Tiles have their storage
  /// keys. NOT_FOUND, reason EDIT_NOT_FOUND; FAILED_PRECONDITION, reason UNDO_NOT_KEPT, with the `oldest_edit` that is
  /// kept in the metadata; DATA_LOSS, reason DAMAGED_EDITS.
  virtual Result<StateDelta> LoadEdit(const std::string& name, std::int64_t revision) {
    (void)name, (void)revision;
    return Status(StatusCode::kUnimplemented, "this store keeps no edits");
  }

  /// The whole map. Distances are within truncation / 4096 of the committed ones; counts, ids and labels are exact.
  virtual Result<std::shared_ptr<const MapSnapshot>> LoadMap(const std::string& name) = 0;

  /// The same for who will not write the map: where several processes share the store, it does not take it.
  virtual Result<StateToRead> LoadToRead(const std::string& name) {
    StateToRead state;
    DHPMAP_ASSIGN_OR_RETURN(state.snapshot, LoadMap(name));
    return state;
  }
  /// The last committed state of the map of `before`: equal to what LoadToRead gives, and shares with `before` what has
  /// not changed, so that it costs what the commits since have written. The same snapshot if there was none. Errors as
  /// LoadMap.
  virtual Result<StateToRead> ReadSince(const StateToRead& before) { return LoadToRead(before.snapshot->info().name); }

  virtual Status DeleteMap(const std::string& name) = 0;

  /// Reserves numbers that become visible before they are stored, so that they never get another meaning: stores with a
  /// full sync that those up to `marks` may be in use. If the store is not closed cleanly, the next process continues
  /// above the marks: the map then has a later revision and next id than last committed, and the skipped revisions are
  /// lost ones. Commits raise the marks to their own numbers.
  virtual Status Reserve(const std::string& name, const NumberMarks& marks) = 0;

  /// Verifies all stored data of a map while commits continue. With `repair`, allowed only while the map is closed:
  /// drops unreadable data and keeps the rest as a new revision; an intact map is not changed. NOT_FOUND, CANCELLED;
  /// FAILED_PRECONDITION for a map of a later version; with `repair`, DATA_LOSS if the map's own row is damaged,
  /// because everything depends on it.
  virtual Result<VerifyReport> VerifyMap(const std::string&, bool /*repair*/, const std::stop_token&) {
    return FailedPrecondition("this store has nothing to look through").WithReason("NOT_A_FILE");
  }

  /// One committed state of all maps, while commits continue. Opening it for writing gives its maps new histories.
  /// Occupies the store's size on disk until released. CANCELLED; FAILED_PRECONDITION, reason NOT_A_FILE, for a store
  /// without a file.
  virtual Result<std::unique_ptr<StoreBackup>> Backup(const std::stop_token&) {
    return FailedPrecondition("this store is kept in memory: there is no file to copy").WithReason("NOT_A_FILE");
  }

  /// One committed map, as a file for ImportMap of any store of this version or a later one, while commits continue.
  /// Occupies the map's size on disk until released. NOT_FOUND; DATA_LOSS if the map's row is damaged; CANCELLED;
  /// NOT_A_FILE as Backup.
  virtual Result<std::unique_ptr<StoreBackup>> ExportMap(const std::string&, const std::stop_token&) {
    return FailedPrecondition("this store is kept in memory and exports nothing").WithReason("NOT_A_FILE");
  }
  /// Begins the import of a file from ExportMap.
  virtual Result<std::unique_ptr<MapImport>> ImportMap() {
    return FailedPrecondition("this store is kept in memory and imports nothing").WithReason("NOT_A_FILE");
  }
};

/// Spill for data of open maps that no store has in this form: an unlinked file of this process in that folder. Errors
/// are those of the disk.
Result<std::shared_ptr<TileSpill>> OpenTileSpill(const std::string& folder);

/// A store in memory, for tests and benchmarks: the same contract, without loss of precision.
std::unique_ptr<MapStore> MakeMemoryStore(const ChangeHistoryLimits& changes = {}, const EditLogLimits& edits = {},
                                          std::function<std::int64_t()> passing_time_ns = {});

}  // namespace dhpmap

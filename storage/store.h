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

namespace dhpmap {

/// How far a commit must have gone when it returns: kNormal survives a killed process, kFull a power cut too.
enum class Durability { kNormal, kFull };

/// Up to where a map's numbers may be shown to others before the state that bears them is stored.
struct NumberMarks {
  std::int64_t revision = 0;   ///< the last revision
  SubmapId next_submap_id{0};  ///< the first id beyond
};

/// A map without its submaps, as the store has it.
struct StoredMap {
  MapInfo info;
  std::int64_t num_submaps = 0;
  std::int64_t num_tsdf_blocks = 0;
  std::int64_t num_label_blocks = 0;
  std::int64_t blob_bytes = 0;   ///< size of the encoded tiles; what a clone shares counts for each
  LostRevisions lost_revisions;  ///< see MapStore::Reserve
  /// From ListMaps: why the map cannot be read; then of all else only info.name is valid.
  Status damage;
};

/// Something that is wrong with a stored map, and where.
struct MapFault {
  enum class Kind {
    kRow,        ///< a row has a wrong checksum
    kBlob,       ///< a tile is missing or damaged
    kCount,      ///< a row says of its tiles what is not so
    kBounds,     ///< a sphere or box does not contain what it should
    kReference,  ///< blobs or rows belong to nothing, or to others than is noted: of the whole store, or the edits
  };
  Kind kind = Kind::kRow;
  std::string place;  ///< "submap 3: tsdf tile (1, -2, 0)"
  std::string what;   ///< goes on after the place
};

/// A block of which two settled objects show the same voxels.
struct SharedPlace {
  SubmapId first, second;
  BlockIndex block;
  std::int64_t num_voxels = 0;
};

struct VerifyReport {
  static constexpr std::size_t kMaxFaults = 1000;
  static constexpr std::size_t kMaxSharedPlaces = 100;

  std::int64_t revision = 0;  ///< that was looked at; after a repair, the one that it made
  std::int64_t num_submaps = 0;
  std::int64_t num_tiles = 0;   ///< layers of tiles that were read
  std::int64_t num_blocks = 0;  ///< layers of blocks in them
  std::int64_t blob_bytes = 0;
  /// Voxels that more than one settled object shows, where nobody has moved any: none once all is refined. -1: the map
  /// is too large to tell.
  std::int64_t num_shared_voxels = 0;
  std::vector<SharedPlace> shared_places;  ///< the first of them
  std::int64_t num_faults = 0;
  std::vector<MapFault> faults;  ///< the first of them
  bool is_repaired = false;      ///< what could not be read was dropped; the faults tell what
};

/// How much is kept of what commits changed, of each map. What is beyond goes with later commits, the oldest first.
/// Ages count the time in which a store was open for writing, whatever the system's clock is set to.
struct ChangeHistoryLimits {
  std::int64_t max_changes = 10'000;
  std::int64_t max_bytes = 32 << 20;  ///< as they are stored
  double max_age_s = 86'400;
};

/// What commits changed, in their order.
struct ChangeList {
  std::uint64_t history_id = 0;     ///< of the map
  std::int64_t revision = 0;        ///< of the map as it is stored
  std::int64_t complete_after = 0;  ///< the changes of all later revisions are kept
  /// Each begins after the one before; revisions between two of them changed nothing.
  std::vector<std::shared_ptr<const MapChange>> changes;
  bool has_more = false;  ///< of later revisions, up to `revision`
};

/// How much is kept of the log of each map's edits, and with it of what repeated requests are answered. What is beyond
/// goes with later edits, the oldest first. Ages as in ChangeHistoryLimits.
struct EditLogLimits {
  std::int64_t max_edits = 100'000;
  std::int64_t max_bytes = 64 << 20;  ///< as they are stored
  double max_age_s = 2'592'000;
  // Of what it takes to undo edits; the bytes are of tiles that it keeps. What is larger alone is not kept.
  std::int64_t max_histories = 1'000;
  std::int64_t max_history_bytes = 256 << 20;
  double max_history_age_s = 86'400;
};

/// An edit that is to be stored with the state that it made.
struct EditRecord {
  EditEntry entry;
  std::string answer;                         ///< to its request, if that has an id; the store does not look into it
  std::shared_ptr<const MapSnapshot> before;  ///< the state that it met, which is the one last committed
  std::vector<RegionEvent> cleared = {};      ///< told with the change, and not in the log
};

/// An edit of the log.
struct LoggedEdit {
  EditEntry entry;
  bool is_undone = false;  ///< and not done again since
  bool is_kept = false;    ///< what it takes to undo it is
};

/// Which edits of a log.
struct EditQuery {
  std::optional<std::int64_t> before_revision;  ///< older than this one only
  std::optional<std::string> author;
  std::size_t max_edits = 100;
};

/// What a request was answered that had an id.
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

/// A map that comes in as a file. Lives no longer than its store, and leaves nothing behind that was not finished.
/// Thread-compatible.
class MapImport {
 public:
  virtual ~MapImport() = default;
  /// The next part of the file. RESOURCE_EXHAUSTED if the disk is full.
  virtual Status Write(std::string_view piece) = 0;
  // Then, each once and only if all before it were OK:
  /// Looks through the file as VerifyMap does. Returns the name that the map had. INVALID_ARGUMENT, reason BAD_MAP;
  /// DATA_LOSS, DAMAGED_MAP; FAILED_PRECONDITION, NEWER_SCHEMA, NEWER_CONFIG or NEWER_LAYER; CANCELLED.
  virtual Result<std::string> LookThrough(const std::stop_token& stop) = 0;
  /// Brings what is large into the store, where nothing refers to it yet, in steps of milliseconds between which
  /// commits go on. CANCELLED, RESOURCE_EXHAUSTED.
  virtual Status Bring(const std::stop_token& stop) = 0;
  /// Adds the map under `name`, in full and all or nothing; commits of other maps wait meanwhile, some microseconds a
  /// tile. It has a new history; who follows it lists it first. INVALID_ARGUMENT for a bad name; ALREADY_EXISTS.
  virtual Status Add(const std::string& name) = 0;
};

/// Keeps maps. The only header of storage/ that server/ sees. Thread-safe: calls on different maps and reads may run at
/// once; commits are serialised inside. Every error is typed: NOT_FOUND, ALREADY_EXISTS, RESOURCE_EXHAUSTED (disk
/// full), FAILED_PRECONDITION (read-only, too new, or another process's), DATA_LOSS (checksum, not a database),
/// UNAVAILABLE.
class MapStore {
 public:
  virtual ~MapStore() = default;

  /// By ascending name. A damaged map is among them: it does not keep the others from being served.
  virtual Result<std::vector<StoredMap>> ListMaps() = 0;
  virtual Result<StoredMap> GetMap(const std::string& name) = 0;

  /// Adds a map, in full. ALREADY_EXISTS if its name is taken.
  virtual Status CreateMap(const MapSnapshot& snapshot) = 0;

  /// Writes what differs between two states of a map, in one transaction: all or nothing. `before` are marks of the
  /// state last committed (or created, or loaded), which itself need not be kept; FAILED_PRECONDITION if the store
  /// holds another revision.
  virtual Status Commit(const StateMarks& before, const MapSnapshot& after, Durability durability) = 0;

  /// What the commits of revisions after `after_revision` changed, of each all of it: as many as fit into `max_bytes`
  /// of memory, but one at least, if there is one. One that took the map from a revision before to one after is among
  /// them, since part of it may be later. A map's creation is a change, too. Written with the commit: it is there if
  /// and only if the state is. NOT_FOUND; OUT_OF_RANGE, reason COMPACTED, the metadata with `oldest_revision`, if
  /// changes after `after_revision` are not kept; DATA_LOSS, reason DAMAGED_CHANGES, which says nothing of the map
  /// itself.
  virtual Result<ChangeList> ListChanges(const std::string& name, std::int64_t after_revision, std::size_t max_bytes) {
    (void)name, (void)after_revision, (void)max_bytes;
    return Status(StatusCode::kUnimplemented, "this store keeps no changes");
  }

  /// Commit of a state that an edit has made of the one last committed, with a full sync: the edit is in the log, and
  /// its answer is known, if and only if the state is stored. It costs what the edit changes: what
  /// MapSnapshot::leaving() has left is worked out and written by the next commit of the same state or a later one
  /// (StateMarks with `lacks_left`), and until then whoever loads the map has it to work out. FAILED_PRECONDITION if
  /// `before` lacks such. This one keeps no log.
  virtual Status CommitEdit(const StateMarks& before, const MapSnapshot& after, const EditRecord& edit) {
    (void)edit;
    return Commit(before, after, Durability::kFull);
  }
  /// The log of a map's edits, the newest first. NOT_FOUND; DATA_LOSS, reason DAMAGED_EDITS, which says nothing of the
  /// map itself.
  virtual Result<std::vector<LoggedEdit>> ListEdits(const std::string& name, const EditQuery& query) {
    (void)name, (void)query;
    return std::vector<LoggedEdit>();
  }
  /// What a request of this id, which is not empty, was answered; nothing if the log has none. Errors as ListEdits.
  virtual Result<std::optional<StoredAnswer>> FindAnswer(const std::string& name, const std::string& request_id) {
    (void)name, (void)request_id;
    return std::optional<StoredAnswer>();
  }

  /// What an edit changed, to undo it or to do it again: of kEdit only, and as long as the limits say. Tiles know the
  /// keys under which they are stored. NOT_FOUND, reason EDIT_NOT_FOUND; FAILED_PRECONDITION, reason UNDO_NOT_KEPT, the
  /// metadata with the `oldest_edit` of which it is kept; DATA_LOSS, reason DAMAGED_EDITS.
  virtual Result<StateDelta> LoadEdit(const std::string& name, std::int64_t revision) {
    (void)name, (void)revision;
    return Status(StatusCode::kUnimplemented, "this store keeps no edits");
  }

  /// The whole map. Distances are within truncation / 4096 of what was committed; counts, ids and labels are exact.
  virtual Result<std::shared_ptr<const MapSnapshot>> LoadMap(const std::string& name) = 0;

  virtual Status DeleteMap(const std::string& name) = 0;

  /// Keeps numbers that are shown before they are stored from ever meaning something else: stores, with a full sync,
  /// that those up to `marks` may be in use. Whoever opens the store after an end that did not lower them again goes on
  /// above: the map then has a later revision and next id than were last committed, and the revisions between are among
  /// its lost ones. Commits raise the marks to what they store.
  virtual Status Reserve(const std::string& name, const NumberMarks& marks) = 0;

  /// Looks through everything that is stored of a map, while commits go on. With `repair`, which the caller asks for
  /// only while nobody has the map open: drops what cannot be read and keeps the rest, as a new revision; nothing is
  /// changed where nothing is wrong. NOT_FOUND, CANCELLED; FAILED_PRECONDITION for a map of a later version; with
  /// `repair`, DATA_LOSS if the map's own row is damaged, by which the rest is understood.
  virtual Result<VerifyReport> VerifyMap(const std::string&, bool /*repair*/, const std::stop_token&) {
    return FailedPrecondition("this store has nothing to look through").WithReason("NOT_A_FILE");
  }

  /// One state of all maps, as committed, while commits go on. Whoever opens it for writing gives its maps new
  /// histories. Takes as much space as the store until it is let go of.
  /// CANCELLED; FAILED_PRECONDITION, reason NOT_A_FILE, for a store that has none.
  virtual Result<std::unique_ptr<StoreBackup>> Backup(const std::stop_token&) {
    return FailedPrecondition("this store is kept in memory: there is no file to copy").WithReason("NOT_A_FILE");
  }

  /// One map as committed, as a file for ImportMap of any store of this version or a later one; commits go on. Takes as
  /// much space as the map until it is let go of. NOT_FOUND; DATA_LOSS if the map's row is damaged; CANCELLED;
  /// NOT_A_FILE as Backup.
  virtual Result<std::unique_ptr<StoreBackup>> ExportMap(const std::string&, const std::stop_token&) {
    return FailedPrecondition("this store is kept in memory and exports nothing").WithReason("NOT_A_FILE");
  }
  /// Begins to take in what ExportMap gave.
  virtual Result<std::unique_ptr<MapImport>> ImportMap() {
    return FailedPrecondition("this store is kept in memory and imports nothing").WithReason("NOT_A_FILE");
  }
};

struct SqliteStoreOptions {
  bool read_only = false;
  int busy_timeout_ms = 5000;
  /// Hears, while it is opened, what is brought up to date of an older database and how much is left; may be empty.
  std::function<void(const std::string& message)> on_progress;
  ChangeHistoryLimits changes = {};
  EditLogLimits edits = {};
  /// LoadMap leaves the voxels of objects on the disk until somebody reads them (BlockTile). Maps of schema 10 and
  /// before are read once for it. Whoever reads a state throws StatusError where the disk fails: DATA_LOSS, UNAVAILABLE
  /// once the store is closed, or what SQLite says. States of the same map that were loaded apart know nothing of each
  /// other: what commits from one have replaced, and nobody has read of the other, is ABORTED, reason SNAPSHOT_EXPIRED.
  bool pages_tiles = false;
  /// By which what is kept gets old, in ns; may be empty: std::chrono::steady_clock.
  std::function<std::int64_t()> passing_time_ns = {};
};

/// Opens or creates a database file. DATA_LOSS if it is damaged or no database; FAILED_PRECONDITION, by reason:
/// FOREIGN_DATABASE (other application_id), NEWER_SCHEMA, NOT_WRITABLE, NOT_A_FILE, DATABASE_IN_USE (another store, of
/// this or another process, writes to it; names the process). NOT_FOUND if its folder is not there. With read_only,
/// which works beside a writer: NOT_FOUND if there is no file, reason OLDER_SCHEMA if it must be migrated first.
Result<std::unique_ptr<MapStore>> OpenSqliteStore(const std::string& path, const SqliteStoreOptions& options = {});

/// For what open maps have in memory and no store has as it is: a file of this process in that folder, without a name,
/// which goes with it. Its errors are those of the disk.
Result<std::shared_ptr<TileSpill>> OpenTileSpill(const std::string& folder);

/// What SQLite has in memory, for all stores of the process. Thread-safe.
std::int64_t SqliteMemoryBytes();

/// Keeps everything in memory, for tests and benchmarks: the same contract, without loss of precision.
std::unique_ptr<MapStore> MakeMemoryStore(const ChangeHistoryLimits& changes = {}, const EditLogLimits& edits = {},
                                          std::function<std::int64_t()> passing_time_ns = {});

}  // namespace dhpmap

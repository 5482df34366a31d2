// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "mapping/base/mutex.h"
#include "mapping/surfaces/surface_cache.h"
#include "server/app/edits/edit_list.h"
#include "server/app/edits/edit_undo.h"
#include "server/app/edits/map_edits.h"
#include "server/app/edits/revision_restore.h"
#include "server/app/follow/followed_maps.h"
#include "server/app/maps/map_summary.h"
#include "server/app/maps/outgoing_files.h"
#include "server/app/maps/running_exports.h"
#include "server/app/maps/summary_cache.h"
#include "server/app/maps/surface_keeper.h"
#include "server/app/open_map/open_map.h"
#include "server/app/watch/change_feed.h"
#include "storage/store.h"

namespace dhpmap {

/// Options for all maps together.
struct RegistryOptions {
  double idle_close_s = 600;               ///< unused maps are closed after this; 0: never
  std::size_t surface_bytes = 512u << 20;  ///< limit of cached surfaces
  std::size_t max_watchers = 1000;
  std::int64_t max_import_bytes = std::int64_t{16} << 30;  ///< limit of an imported file
  int max_imports = 2;                                     ///< concurrent imports
  std::function<void(const MapInfo&)> on_loaded = {};      ///< called whenever a map has been loaded; may be empty
};

class IncomingMap;
class MapRegistry;

/// An import request.
struct ImportRequest {
  std::string name;              ///< of the new map; empty: its name in the file
  std::int64_t total_bytes = 0;  ///< of the file; 0: unknown
  /// Whether the new map may have a name; called once it is known, at the latest after the whole file. Empty: any.
  std::function<Status(const std::string& name)> check_name = {};
};

/// Reserves a name while its map is being added to the store, which already shows it. No other map of this process gets
/// the name. The destructor releases it. Movable.
class HeldName {
 public:
  HeldName(MapRegistry& registry, std::string name) : registry_(&registry), name_(std::move(name)) {}
  ~HeldName();
  HeldName(HeldName&& other) noexcept
      : registry_(std::exchange(other.registry_, nullptr)), name_(std::move(other.name_)) {}
  HeldName& operator=(HeldName&& other) noexcept {
    std::swap(registry_, other.registry_);
    std::swap(name_, other.name_);
    return *this;
  }
  HeldName(const HeldName&) = delete;
  HeldName& operator=(const HeldName&) = delete;

 private:
  friend class MapRegistry;
  MapRegistry* registry_;
  std::string name_;
};

/// All maps of a store. A map is loaded on the first access beyond its summary, and closed after
/// RegistryOptions::idle_close_s without access. Summaries of closed maps come from the store; if no other process
/// writes it, they are cached. Thread-safe; no call on one map waits for another map.
class MapRegistry {
 public:
  using Clock = std::chrono::steady_clock;

  /// Takes as long for many maps as for few. The store outlives the registry, which is its only writer in this process.
  static Result<std::unique_ptr<MapRegistry>> Open(MapStore& store, OpenMapOptions map_options,
                                                   const RegistryOptions& options = {});
  /// Calls Shutdown().
  ~MapRegistry();

  /// Adds a map with `info`'s name, display name, config (must be valid) and label set. INVALID_ARGUMENT for a bad
  /// name, ALREADY_EXISTS.
  Result<MapSummary> Create(MapInfo info);
  /// Begins the import of a file from MapStore::ExportMap. ALREADY_EXISTS, checked again at the end; INVALID_ARGUMENT
  /// for a bad name or size; RESOURCE_EXHAUSTED, reasons BODY_TOO_LARGE and TOO_BUSY.
  Result<std::unique_ptr<IncomingMap>> BeginImport(ImportRequest request);
  // These ask the store about closed maps. UNAVAILABLE if it does not answer.
  /// NOT_FOUND if there is no such map, DATA_LOSS if it is damaged.
  Result<MapSummary> Get(const std::string& name) const;
  /// Up to `max` of them, by name, from the first after `after` on: fewer only at the end. Includes damaged ones.
  Result<std::vector<MapSummary>> List(const std::string& after, std::size_t max) const;
  /// Revisions that were visible before a crash but never stored; empty for an unknown map. Not null.
  [[nodiscard]] std::shared_ptr<const LostRevisions> LostRevisionsOf(const std::string& name) const;
  /// Returns the last revision. ABORTED for a wrong etag, FAILED_PRECONDITION while the map is fed. Blocks.
  Result<std::int64_t> Delete(const std::string& name, const std::string& etag = "");

  /// The open map; loads it if necessary, which blocks. Returns errors of MapStore::LoadMap; the next call tries again.
  /// RESOURCE_EXHAUSTED, reason TOO_BUSY, while it is repaired.
  Result<std::shared_ptr<OpenMap>> GetOpen(const std::string& name);
  /// Whether it may be the name of a map that is not open: an access then waits for the store. Never waits itself.
  [[nodiscard]] bool MustLoad(const std::string& name) const;
  /// Whether other processes write the store, too. It is then remote, and even a summary may take long.
  [[nodiscard]] bool SharesStore() const { return store_.fleet() != nullptr; }
  /// The last published state of the map; opens it if necessary.
  Result<std::shared_ptr<const MapView>> ViewOf(const std::string& name);
  /// The state at a recent revision, or the last published one; see dhpmap::ViewAt. `field` is the request's field with
  /// the revision. Opens the map if necessary.
  Result<std::shared_ptr<const MapView>> ViewAt(const std::string& name, std::int64_t revision,
                                                const std::string& field);
  /// The state of the map that this process has, which may be older than the owner's. If the map is open here, its last
  /// published state; else that of a copy, which is made if necessary (see FollowedMaps::ViewOf). Without a fleet,
  /// ViewOf.
  Result<std::shared_ptr<const MapView>> EventualViewOf(const std::string& name, std::int64_t at_least = 0);
  /// Whether EventualViewOf has to read the map first.
  [[nodiscard]] bool MustLoadForEventual(const std::string& name) const;
  /// Like Get, from the state of EventualViewOf if that is in memory; does not read the map for it.
  Result<MapSummary> GetEventual(const std::string& name) const;
  /// Copies of maps that other processes write; null without a fleet.
  [[nodiscard]] const FollowedMaps* followed() const { return followed_.get(); }
  /// Stored changes of the maps. Reading them opens no map.
  [[nodiscard]] ChangeFeed& changes() { return changes_; }
  [[nodiscard]] const ChangeFeed& changes() const { return changes_; }
  /// For distance queries, over all maps.
  [[nodiscard]] SurfaceCache& surfaces() { return surfaces_; }
  /// Memory of the cached surfaces.
  [[nodiscard]] std::size_t surface_bytes() const { return surfaces_.bytes() + surfaces_.cell_bytes(); }
  /// See MapStore::ListEdits. Opens no map.
  Result<std::vector<LoggedEdit>> ListEdits(const std::string& name, const EditQuery& query) {
    return store_.ListEdits(name, query);
  }
  /// Writer job that undoes or redoes edits; see UndoEdits.
  std::function<Result<EditMade>(Map&)> UndoOf(UndoRequest request);
  /// Likewise, restores a deleted submap; see UndeleteSubmap.
  std::function<Result<EditMade>(Map&)> UndeletionOf(SubmapId id, EditConditions conditions = {});
  /// Likewise, applies a list of edits and returns their effects in `results`; see ApplyEdits.
  std::function<Result<EditMade>(Map&)> EditsOf(EditList list, std::shared_ptr<std::vector<EditResult>> results);
  /// Likewise, changes a map itself; see PatchMap.
  std::function<Result<EditMade>(Map&)> PatchOf(MapPatch patch, EditConditions conditions);
  /// See MapStore::ExportMap; RESOURCE_EXHAUSTED, reason TOO_BUSY, for too many at once. Opens no map.
  Result<std::unique_ptr<StoreBackup>> Export(const std::string& name, const std::stop_token& stop) {
    return outgoing_.Open(
        [&] { return exports_->Open(ExportKind::kMapFile, name, [&] { return store_.ExportMap(name, stop); }); });
  }
  /// See MapStore::Backup; likewise.
  Result<std::unique_ptr<StoreBackup>> Backup(const std::stop_token& stop) {
    return outgoing_.Open([&] { return exports_->Open(ExportKind::kBackup, "", [&] { return store_.Backup(stop); }); });
  }
  /// Progress of exports and backups. Identifies maps by name only.
  [[nodiscard]] const RunningExports& exports() const { return *exports_; }
  /// Writer job that restores the map, or an object of it, to a revision; see RestoreRevision. Opens the map.
  Result<std::function<Result<EditMade>(Map&)>> RestorationOf(const std::string& name, RestoreRequest request);
  /// See MapStore::VerifyMap. An open map is not repaired, because it was read without errors. With eviction this is
  /// not certain, so a damaged open map is closed first if it is unused.
  Result<VerifyReport> Verify(const std::string& name, bool repair, const std::stop_token& stop);
  /// Bytes of encoded blocks in the store.
  Result<std::int64_t> DiskBytes(const std::string& name);
  [[nodiscard]] std::vector<std::shared_ptr<OpenMap>> OpenMaps() const;
  /// See OpenMap::Finishing; nothing if the map is not open. Opens no map.
  [[nodiscard]] std::optional<FinishProgress> FinishingOf(const std::string& name) const;
  /// For the map of `state`: its kept state of that revision, else the present one; null if the map is not open. Opens
  /// no map.
  [[nodiscard]] std::shared_ptr<const MapSnapshot> PresentOf(const MapSnapshot& state) const;
  /// OpenMap::KeepPagesInBounds of all open maps, if necessary. Runs before each view is returned, and periodically.
  void KeepPagesInBounds();
  /// Closes the maps that are idle at `now`, as the registry does periodically. Views stay valid; a map stays open
  /// while one of its views may have to read from the store.
  void CloseIdleMaps(Clock::time_point now);

  // Only for stores that several processes share: else FAILED_PRECONDITION, reason NO_FLEET.
  /// Stores and closes the map if it is open, and passes it to a server, or with 0 to the first server that asks for
  /// it: see Fleet::GiveUp. Its streams end with NOT_OWNER. NOT_FOUND for an unknown server, FAILED_PRECONDITION for
  /// one that is dead or drains; nothing has changed then. OK if this process does not own the map. Blocks.
  Status HandOver(const std::string& name, std::int64_t to_server);
  /// Takes no more maps, and distributes the open ones evenly over the other servers. Blocks.
  Status HandAllOver();

  /// Stops all open maps: see OpenMap::Stop. They can still be read; others can no longer be opened (UNAVAILABLE).
  /// Returns the error of the first last state that could not be stored, or OK.
  Status Shutdown();
  /// OpenMap::GiveUpMapping of all open maps.
  void GiveUpMapping();

 private:
  friend class HeldName;
  friend class IncomingMap;
  mutable Mutex mutex_;

  /// A map that is open, or that is being opened, closed, repaired or deleted.
  struct Entry {
    Mutex busy;  ///< held while the map is loaded or deleted; locked before the registry's mutex
    int num_places DHPMAP_GUARDED_BY(&MapRegistry::mutex_) = 0;
    bool is_lost DHPMAP_GUARDED_BY(&MapRegistry::mutex_) = false;      ///< another process owns the map now
    bool is_repaired DHPMAP_GUARDED_BY(&MapRegistry::mutex_) = false;  ///< takes long: callers are refused
    std::shared_ptr<OpenMap> open_map DHPMAP_GUARDED_BY(&MapRegistry::mutex_);
    std::shared_ptr<const LostRevisions> lost_revisions DHPMAP_GUARDED_BY(&MapRegistry::mutex_);  ///< of the open map
    Clock::time_point last_used DHPMAP_GUARDED_BY(&MapRegistry::mutex_);
  };

  /// Finds or adds the entry of a name and keeps it. The destructor of the last place removes an entry without an open
  /// map. Declare it before the lock of `busy`, so that the lock is released first.
  class Place {
   public:
    Place(MapRegistry& registry, const std::string& name);
    ~Place();
    Place(const Place&) = delete;
    Place& operator=(const Place&) = delete;
    Entry& operator*() const { return *entry_; }
    Entry* operator->() const { return entry_.get(); }

   private:
    MapRegistry& registry_;
    const std::string name_;
    std::shared_ptr<Entry> entry_;
  };

  MapRegistry(MapStore& store, OpenMapOptions map_options, const RegistryOptions& options);
  /// Null if it is not open.
  [[nodiscard]] std::shared_ptr<OpenMap> FindOpen(const std::string& name) const;
  /// Asks the store about a closed map. Errors as MapStore::GetMap.
  Result<MapInStore> AskStore(const std::string& name) const;
  /// NOT_FOUND, with a suggestion from the first names of the store.
  [[nodiscard]] Status NoSuchMapAmongThese(const std::string& name) const;
  /// The same in place of a NOT_FOUND; returns other errors unchanged.
  [[nodiscard]] Status WithSuggestion(const Status& status, const std::string& name) const;
  [[nodiscard]] Status CheckIsFree(const std::string& name) const;
  [[nodiscard]] Status CheckIsNotThere(const std::string& name) const;
  /// ALREADY_EXISTS; UNAVAILABLE if the registry is shut down.
  Result<HeldName> HoldName(const std::string& name);
  void GiveBack(const std::string& name);
  Result<std::shared_ptr<OpenMap>> Load(const std::string& name, Entry& entry);
  /// Opens no map, but counts as use. Null if it is not open.
  std::shared_ptr<OpenMap> UseIfOpen(const std::string& name);
  void FollowOthers(Fleet& fleet);
  void CloseIfIdle(Entry& entry, Clock::time_point now);
  /// Whether closing may take evicted tiles away from holders of a state of the map.
  enum class Closing { kIfNotViewed, kEvenViewed };
  /// Closes it unless it was used after `used_until`.
  void CloseIfAtRest(Entry& entry, Clock::time_point used_until, Closing closing);
  void CloserLoop();
  /// Another process has taken or deleted the map. Quick.
  void NoteLoss(const std::string& name);
  void CloseLostMaps();
  /// Stops the open map, whose streams end with `why`. No effect if it is not open.
  void MoveAway(const std::string& name, Entry& entry, const Status& why) DHPMAP_REQUIRES(entry.busy);
  /// Opens the entry; null if the registry is shut down.
  std::shared_ptr<OpenMap> Install(Entry& entry, std::shared_ptr<const MapSnapshot> snapshot,
                                   std::shared_ptr<const LostRevisions> lost_revisions);

  static constexpr std::size_t kMaxSummaries = 1000;
  static constexpr std::size_t kMaxOutgoing = 4;
  static constexpr std::chrono::seconds kOutgoingIdle{30};

  MapStore& store_;
  const OpenMapOptions map_options_;
  const RegistryOptions options_;
  ChangeFeed changes_;
  SurfaceCache surfaces_;
  SurfaceKeeper keeper_{surfaces_};
  std::unique_ptr<FollowedMaps> followed_;  ///< constant; uses those above
  std::atomic<int> num_imports_ = 0;
  const std::shared_ptr<RunningExports> exports_ = RunningExports::Create();
  OutgoingFiles outgoing_{kMaxOutgoing, kOutgoingIdle};
  std::map<std::string, std::shared_ptr<Entry>> entries_ DHPMAP_GUARDED_BY(mutex_);
  std::set<std::string> held_names_ DHPMAP_GUARDED_BY(mutex_);
  mutable SummaryCache summaries_ DHPMAP_GUARDED_BY(mutex_);    ///< of closed maps
  std::set<std::string> lost_names_ DHPMAP_GUARDED_BY(mutex_);  ///< maps that the closer has to close
  bool is_shut_down_ DHPMAP_GUARDED_BY(mutex_) = false;
  CondVar closer_wake_;
  LazyThread closer_;  // joined by Shutdown
};

}  // namespace dhpmap

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "mapping/base/mutex.h"
#include "mapping/surfaces/surface_cache.h"
#include "server/app/edits/edit_undo.h"
#include "server/app/edits/map_edits.h"
#include "server/app/edits/revision_restore.h"
#include "server/app/maps/outgoing_files.h"
#include "server/app/maps/running_exports.h"
#include "server/app/maps/surface_keeper.h"
#include "server/app/session/map_session.h"
#include "server/app/watch/change_feed.h"
#include "storage/store.h"

namespace dhpmap {

/// Of all maps together.
struct RegistryOptions {
  double idle_close_s = 600;               ///< a map that nobody uses for so long is closed; 0: never
  std::size_t surface_bytes = 512u << 20;  ///< of surfaces that are kept for distances
  std::size_t max_watchers = 1000;
  std::int64_t max_import_bytes = std::int64_t{16} << 30;  ///< of the file of a map that comes in
  int max_imports = 2;                                     ///< maps that come in at once
};

struct MapSummary {
  MapInfo info;
  std::int64_t num_submaps = 0;  ///< the unknown submap included
  Status damage;                 ///< why the store cannot read the map; then of all else only info.name is valid
};

MapSummary SummaryOf(const MapSnapshot& snapshot);

class IncomingMap;
class MapRegistry;

/// A file with a map that is to come in.
struct ImportRequest {
  std::string name;              ///< of the new map; empty: the one that it had
  std::int64_t total_bytes = 0;  ///< of the file; 0: not known
  /// Whether the new map may have a name, asked once it is known, which may be after all of the file. Empty: any.
  std::function<Status(const std::string& name)> check_name = {};
};

/// A name under which its holder is about to add a map to the store: until then nobody else gets it, and nobody finds a
/// map there. Given back at the end if none was shown. Movable.
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

/// All maps of a store. A map is loaded when somebody first asks for more than its summary, and closed when nobody has
/// asked for RegistryOptions::idle_close_s.
/// Thread-safe; no call on one map waits for another map.
class MapRegistry {
 public:
  using Clock = std::chrono::steady_clock;

  /// Reads the list of maps. The store outlives the registry, and nobody else writes to it.
  static Result<std::unique_ptr<MapRegistry>> Open(MapStore& store, SessionOptions session,
                                                   const RegistryOptions& options = {});
  /// Shutdown().
  ~MapRegistry();

  /// Adds a map with `info`'s name, display name, config (must be valid) and label set. INVALID_ARGUMENT for a bad
  /// name, ALREADY_EXISTS.
  Result<MapSummary> Create(MapInfo info);
  /// Begins to take in a map that MapStore::ExportMap gave. ALREADY_EXISTS, which is looked at again at the end;
  /// INVALID_ARGUMENT for a bad name or size; RESOURCE_EXHAUSTED, reasons BODY_TOO_LARGE and TOO_BUSY.
  Result<std::unique_ptr<IncomingMap>> BeginImport(ImportRequest request);
  /// NOT_FOUND if there is no such map, DATA_LOSS if it is damaged.
  Result<MapSummary> Get(const std::string& name) const;
  /// Up to `max` of them, by name, from the first behind `after` on; damaged ones included.
  [[nodiscard]] std::vector<MapSummary> List(const std::string& after = "",
                                             std::size_t max = std::numeric_limits<std::size_t>::max()) const;
  /// Revisions of before a crash whose states were never stored; none of a map that is not there. Not null.
  [[nodiscard]] std::shared_ptr<const LostRevisions> LostRevisionsOf(const std::string& name) const;
  /// Returns the last revision. ABORTED for an etag that is not the present one, FAILED_PRECONDITION while frames are
  /// being streamed into the map. Blocks.
  Result<std::int64_t> Delete(const std::string& name, const std::string& etag = "");

  /// The open map; loads it, which blocks, if it is not open yet. Errors of MapStore::LoadMap are passed on, and the
  /// next call tries again. RESOURCE_EXHAUSTED, reason TOO_BUSY, while it is repaired.
  Result<std::shared_ptr<MapSession>> OpenSession(const std::string& name);
  /// There is such a map, but it is not open: whoever asks for it waits until it is loaded.
  [[nodiscard]] bool MustLoad(const std::string& name) const;
  /// The last published state of the map, which is opened if it is not open yet.
  Result<std::shared_ptr<const MapView>> ViewOf(const std::string& name);
  /// The state at a revision of the recent past, or the last published one; see dhpmap::ViewAt. `field` is what of a
  /// request names the revision. The map is opened if it is not open yet.
  Result<std::shared_ptr<const MapView>> ViewAt(const std::string& name, std::int64_t revision,
                                                const std::string& field);
  /// What becomes of the maps, as they are stored. Reading it opens none.
  [[nodiscard]] ChangeFeed& changes() { return changes_; }
  [[nodiscard]] const ChangeFeed& changes() const { return changes_; }
  /// For distances, of all maps.
  [[nodiscard]] SurfaceCache& surfaces() { return surfaces_; }
  /// What those take.
  [[nodiscard]] std::size_t surface_bytes() const { return surfaces_.bytes() + surfaces_.cell_bytes(); }
  /// See MapStore::ListEdits. Opens no map.
  Result<std::vector<LoggedEdit>> ListEdits(const std::string& name, const EditQuery& query) {
    return store_.ListEdits(name, query);
  }
  /// What is to be done on a map's writer to undo edits, or to do them again; see UndoEdits.
  std::function<Result<EditMade>(Map&)> UndoOf(UndoRequest request);
  /// Likewise, to bring back what was deleted; see UndeleteSubmap.
  std::function<Result<EditMade>(Map&)> UndeletionOf(SubmapId id, EditConditions conditions = {});
  /// Likewise, in a list of edits: EditList::undelete.
  std::function<Result<EditSummary>(SubmapId, const EditConditions&, Map&)> Undeletions();
  /// Likewise, to change a map itself; see PatchMap.
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
  /// How far those are. Knows no map but by its name.
  [[nodiscard]] const RunningExports& exports() const { return *exports_; }
  /// What is to be done on a map's writer to take it, or an object of it, back to a revision; see RestoreRevision.
  /// Opens the map.
  Result<std::function<Result<EditMade>(Map&)>> RestorationOf(const std::string& name, RestoreRequest request);
  /// See MapStore::VerifyMap. Repairs nothing of a map that is open: all of it could be read. Where voxels are left in
  /// the store that is not so: one that is damaged is closed first, if nobody is using it.
  Result<VerifyReport> Verify(const std::string& name, bool repair, const std::stop_token& stop);
  /// Bytes of encoded blocks in the store.
  Result<std::int64_t> DiskBytes(const std::string& name);
  [[nodiscard]] std::vector<std::shared_ptr<MapSession>> OpenSessions() const;
  /// See MapSession::Finishing; nothing if the map is not open. Opens none.
  [[nodiscard]] std::optional<FinishProgress> FinishingOf(const std::string& name) const;
  /// Of the map that `state` is of: the state of its revision, if that is one of its kept states, else the present one;
  /// null if the map is not open. Opens none.
  [[nodiscard]] std::shared_ptr<const MapSnapshot> PresentOf(const MapSnapshot& state) const;
  /// MapSession::KeepPagesInBounds of all that are open, where there is need. Who asks for a view does it first, and
  /// the registry from time to time.
  void KeepPagesInBounds();
  /// Closes the maps that are idle at the time `now`, as the registry does by itself from time to time. What views of
  /// them hold stays; where they may still have to read it from the store, so does the map.
  void CloseIdleMaps(Clock::time_point now);

  /// Stops every session: see MapSession::Stop. What is open can still be read; a map that is not open can no longer be
  /// opened (UNAVAILABLE). Returns why a map's last state could not be stored, or OK.
  Status Shutdown();
  /// MapSession::GiveUpMapping of all that are open.
  void GiveUpMapping();

 private:
  friend class HeldName;
  friend class IncomingMap;
  mutable Mutex mutex_;

  /// A map that is there, or is just being made.
  struct Entry {
    Mutex busy;  ///< held while the map is loaded or deleted; taken before the registry's
    std::shared_ptr<const LostRevisions> lost_revisions = std::make_shared<LostRevisions>();  ///< never changes
    bool exists DHPMAP_GUARDED_BY(&MapRegistry::mutex_) = false;
    bool is_repaired DHPMAP_GUARDED_BY(&MapRegistry::mutex_) = false;  ///< which may take minutes: nobody waits for it
    MapSummary stored DHPMAP_GUARDED_BY(&MapRegistry::mutex_);         ///< while there is no session
    std::shared_ptr<MapSession> session DHPMAP_GUARDED_BY(&MapRegistry::mutex_);
    Clock::time_point last_used DHPMAP_GUARDED_BY(&MapRegistry::mutex_);
  };

  MapRegistry(MapStore& store, SessionOptions session, const RegistryOptions& options);
  [[nodiscard]] std::shared_ptr<Entry> FindEntry(const std::string& name) const;
  [[nodiscard]] MapSummary Summarise(const Entry& entry) const DHPMAP_REQUIRES(mutex_);
  /// NOT_FOUND, with what is near among the maps that are there.
  [[nodiscard]] Status NoSuchMapAmongThese(const std::string& name) const DHPMAP_REQUIRES(mutex_);
  [[nodiscard]] Status CheckIsFree(const std::string& name) const;
  /// ALREADY_EXISTS; UNAVAILABLE if the registry is shut down.
  Result<HeldName> HoldName(const std::string& name);
  void GiveBack(const std::string& name);
  /// The map is in the store, and there for all.
  MapSummary Show(HeldName& held, MapSummary map);
  Result<MapSummary> ShowStored(HeldName& held);
  [[nodiscard]] bool IsOpen(const Entry& entry) const;
  void CloseIfIdle(Entry& entry, Clock::time_point now);
  /// Whether voxels that are left in the store may be lost to those who hold a state of the map.
  enum class Closing { kIfNotViewed, kEvenViewed };
  /// If nobody has asked for it after `used_until`.
  void CloseIfAtRest(Entry& entry, Clock::time_point used_until, Closing closing);
  void CloserLoop();
  /// Puts a session into the entry; null if the registry is shut down.
  std::shared_ptr<MapSession> Install(Entry& entry, std::shared_ptr<const MapSnapshot> snapshot);

  static constexpr std::size_t kMaxOutgoing = 4;
  static constexpr std::chrono::seconds kOutgoingIdle{30};

  MapStore& store_;
  const SessionOptions session_options_;
  const RegistryOptions options_;
  ChangeFeed changes_;
  SurfaceCache surfaces_;
  SurfaceKeeper keeper_{surfaces_};
  std::atomic<int> num_imports_ = 0;
  const std::shared_ptr<RunningExports> exports_ = RunningExports::Create();
  OutgoingFiles outgoing_{kMaxOutgoing, kOutgoingIdle};
  std::map<std::string, std::shared_ptr<Entry>> entries_ DHPMAP_GUARDED_BY(mutex_);
  bool is_shut_down_ DHPMAP_GUARDED_BY(mutex_) = false;
  CondVar shut_down_;
  LazyThread closer_;  // joined by Shutdown
};

}  // namespace dhpmap

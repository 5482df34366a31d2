// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <cstddef>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "mapping/base/mutex.h"
#include "server/app/states/map_view.h"
#include "server/base/byte_budget.h"
#include "storage/store.h"

namespace dhpmap {

struct FollowOptions {
  std::size_t max_maps = 64;
  std::size_t max_bytes = std::size_t{2} << 30;         ///< of all copies
  std::chrono::duration<double> idle_drop_s{600};       ///< unused copies are dropped after this; 0: never
  std::chrono::milliseconds look_every{2000};           ///< longest time between two checks of a copy
  std::function<std::vector<std::string>()> watched{};  ///< further maps whose commits the fleet reports; may be empty
  std::function<void(const std::string&)> on_commit{};  ///< the fleet reports a commit; quick; may be empty
  /// A copy has reached a newer state; quick, on the following thread; may be empty.
  std::function<void(const std::shared_ptr<const MapSnapshot>&)> on_state{};
};

/// Copies of maps that other processes of a fleet write. When the fleet reports a commit, one thread for all copies
/// reads the next committed state. Thread-safe.
class FollowedMaps {
 public:
  using View = std::shared_ptr<const MapView>;
  using Clock = std::chrono::steady_clock;

  /// Both outlive it, or Stop(). It alone calls `fleet`'s OnChange, MeasureFollowing and SetFollowed.
  FollowedMaps(MapStore& store, Fleet& fleet, FollowOptions options);
  /// Calls Stop().
  ~FollowedMaps();
  FollowedMaps(const FollowedMaps&) = delete;
  FollowedMaps& operator=(const FollowedMaps&) = delete;

  /// The present state of the copy. The first call reads the map, which blocks. The revision never falls while the map
  /// keeps its history. A copy older than revision `at_least` is updated first, to the last committed state. Errors:
  /// those of MapStore::LoadMap; RESOURCE_EXHAUSTED, reason TOO_BUSY, if one more copy does not fit; UNAVAILABLE after
  /// Stop().
  Result<View> ViewOf(const std::string& name, std::int64_t at_least = 0) DHPMAP_EXCLUDES(mutex_);
  /// The state of an existing copy, else null. Does not count as use.
  [[nodiscard]] View Find(const std::string& name) const DHPMAP_EXCLUDES(mutex_);
  /// Drops the copy of a map that was deleted, or that this process writes from now on. Views stay valid.
  void Drop(const std::string& name) DHPMAP_EXCLUDES(mutex_);
  /// Drops the copies that are idle at `now`. The thread does this by itself, too.
  void DropIdle(Clock::time_point now) DHPMAP_EXCLUDES(mutex_);

  /// Call it when the result of FollowOptions::watched has changed. Quick.
  void NoteWatched() DHPMAP_EXCLUDES(mutex_);
  /// Ends the thread. The fleet makes no further calls to it.
  void Stop() DHPMAP_EXCLUDES(mutex_);

  [[nodiscard]] std::size_t num_maps() const DHPMAP_EXCLUDES(mutex_);
  /// Memory of the copies, in bytes.
  [[nodiscard]] std::size_t bytes() const { return budget_.used_bytes(); }
  /// As of `now`. A copy whose first state is still being read is not behind.
  [[nodiscard]] FollowingState StateAt(Clock::time_point now) const DHPMAP_EXCLUDES(mutex_);

 private:
  struct Copy {
    explicit Copy(ByteBudget& budget) : share(&budget) {}
    Mutex busy;  ///< held while the store is read for this copy; locked before mutex_
    StateToRead state DHPMAP_GUARDED_BY(busy);
    ByteShare share DHPMAP_GUARDED_BY(busy);
    View view DHPMAP_GUARDED_BY(&FollowedMaps::mutex_);  ///< null: not read yet
    bool is_behind DHPMAP_GUARDED_BY(&FollowedMaps::mutex_) = false;
    /// When the oldest known commit that the view lacks was noticed; and the oldest since the last read began.
    std::optional<Clock::time_point> behind_since DHPMAP_GUARDED_BY(&FollowedMaps::mutex_), unread_since
        DHPMAP_GUARDED_BY(&FollowedMaps::mutex_);
    bool is_dropped DHPMAP_GUARDED_BY(&FollowedMaps::mutex_) = false;
    Clock::time_point last_used DHPMAP_GUARDED_BY(&FollowedMaps::mutex_);
    Clock::time_point look_at DHPMAP_GUARDED_BY(&FollowedMaps::mutex_);
  };
  /// The fleet's callback holds this; it may outlive the FollowedMaps.
  struct Listener {
    Mutex mutex;
    FollowedMaps* maps DHPMAP_GUARDED_BY(mutex);
  };
  using CopyPtr = std::shared_ptr<Copy>;

  void OnCommit(const std::string& name) DHPMAP_EXCLUDES(mutex_);
  Result<CopyPtr> FindOrAdd(const std::string& name) DHPMAP_EXCLUDES(mutex_);
  View ViewIn(const Copy& copy) const DHPMAP_EXCLUDES(mutex_);
  Result<View> Read(const std::string& name, Copy& copy) DHPMAP_EXCLUDES(mutex_);
  bool MakeRoomFor(Copy& copy, std::size_t bytes) DHPMAP_REQUIRES(copy.busy) DHPMAP_EXCLUDES(mutex_);
  CopyPtr TakeLeastUsed(const Copy* except) DHPMAP_REQUIRES(mutex_);
  void DropCopy(const std::string& name, const Copy& copy) DHPMAP_EXCLUDES(mutex_);
  void Loop() DHPMAP_EXCLUDES(mutex_);
  [[nodiscard]] bool HasWork() const DHPMAP_REQUIRES(mutex_);
  void TellInterest() DHPMAP_EXCLUDES(mutex_);
  std::vector<std::pair<std::string, CopyPtr>> TakeDue() DHPMAP_EXCLUDES(mutex_);
  void GoOn(const std::string& name, Copy& copy) DHPMAP_EXCLUDES(mutex_);
  Status GoOnFrom(Copy& copy) DHPMAP_REQUIRES(copy.busy) DHPMAP_EXCLUDES(mutex_);

  MapStore& store_;
  Fleet& fleet_;
  const FollowOptions options_;
  ByteBudget budget_;
  const std::shared_ptr<Listener> listener_;
  mutable Mutex mutex_;
  CondVar wake_;
  std::map<std::string, CopyPtr> copies_ DHPMAP_GUARDED_BY(mutex_);
  bool is_interest_new_ DHPMAP_GUARDED_BY(mutex_) = false;
  bool is_stopping_ DHPMAP_GUARDED_BY(mutex_) = false;
  std::vector<std::string> told_;  ///< names last passed to the fleet; used by the thread alone
  std::thread thread_;             // last: it uses the other members
};

}  // namespace dhpmap

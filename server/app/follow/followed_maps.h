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
  std::chrono::milliseconds look_every{2000};           ///< even if the fleet tells of no commit
  std::function<std::vector<std::string>()> watched{};  ///< maps that the fleet is to tell of, too; may be empty
  std::function<void(const std::string&)> on_commit{};  ///< the fleet tells of one; quick; may be empty
  /// A copy has gone on; quick, on the following thread; may be empty.
  std::function<void(const std::shared_ptr<const MapSnapshot>&)> on_state{};
};

/// Copies of maps that other processes of a fleet write. Each goes on, from committed state to committed state, as soon
/// as the fleet tells of a commit, on one thread for all. Thread-safe.
class FollowedMaps {
 public:
  using View = std::shared_ptr<const MapView>;
  using Clock = std::chrono::steady_clock;

  /// Both outlive it, or Stop(). Nobody else calls `fleet`'s OnChange, MeasureFollowing and SetFollowed.
  FollowedMaps(MapStore& store, Fleet& fleet, FollowOptions options);
  /// Stop().
  ~FollowedMaps();
  FollowedMaps(const FollowedMaps&) = delete;
  FollowedMaps& operator=(const FollowedMaps&) = delete;

  /// The present state of the copy; the first call reads the map, which blocks. Its revision never falls while the map
  /// keeps its history. One before revision `at_least` goes on first, to what is committed. Errors of
  /// MapStore::LoadMap; RESOURCE_EXHAUSTED, reason TOO_BUSY, if there is no room for one more copy; UNAVAILABLE after
  /// Stop().
  Result<View> ViewOf(const std::string& name, std::int64_t at_least = 0) DHPMAP_EXCLUDES(mutex_);
  /// The same if there is a copy already, which does not count as use; else null.
  [[nodiscard]] View Find(const std::string& name) const DHPMAP_EXCLUDES(mutex_);
  /// For a map that is gone, or that this process writes from now on. Views stay valid.
  void Drop(const std::string& name) DHPMAP_EXCLUDES(mutex_);
  /// Drops the copies that are idle at `now`, as the thread does by itself.
  void DropIdle(Clock::time_point now) DHPMAP_EXCLUDES(mutex_);

  /// What FollowOptions::watched returns has changed. Quick.
  void NoteWatched() DHPMAP_EXCLUDES(mutex_);
  /// Ends the thread; the fleet calls nothing any more.
  void Stop() DHPMAP_EXCLUDES(mutex_);

  [[nodiscard]] std::size_t num_maps() const DHPMAP_EXCLUDES(mutex_);
  /// Memory of the copies.
  [[nodiscard]] std::size_t bytes() const { return budget_.used_bytes(); }
  /// As of `now`. A copy whose first state is still being read is not behind.
  [[nodiscard]] FollowingState StateAt(Clock::time_point now) const DHPMAP_EXCLUDES(mutex_);

 private:
  struct Copy {
    explicit Copy(ByteBudget& budget) : share(&budget) {}
    Mutex busy;  ///< held by who reads the store for it; locked before mutex_
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
  /// What the fleet's callback holds: it may outlive this.
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
  std::vector<std::string> told_;  ///< to the fleet; the thread's alone
  std::thread thread_;             // last: it uses the others
};

}  // namespace dhpmap

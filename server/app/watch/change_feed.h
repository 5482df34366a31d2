// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "mapping/base/mutex.h"
#include "storage/store.h"

namespace dhpmap {

/// The watchers of all maps, and recent changes for them. A watcher is a position in the store's history, not a queue:
/// it is woken and reads on. Recent changes are cached while a map has watchers, so the store is read once for all of
/// them. Thread-safe.
class ChangeFeed {
 public:
  /// Cache limit of a map's newest changes.
  static constexpr std::size_t kKept_bytes = 1u << 20;
  /// Cache limit of all maps together; beyond it, each watcher reads from the store.
  static constexpr std::size_t kKeptOfAll_bytes = 32u << 20;
  /// Limit of one read, except for a single larger change.
  static constexpr std::size_t kPage_bytes = 128u << 10;

  /// The store outlives the feed.
  ChangeFeed(MapStore& store, std::size_t max_followers) : store_(store), max_followers_(max_followers) {}

  /// A watcher of a map, during its lifetime.
  class Follower {
   public:
    Follower(ChangeFeed& feed, std::string map, std::function<void()> wake)
        : feed_(feed), map_(std::move(map)), wake_(std::move(wake)) {}
    /// After it returns, `wake` never runs.
    ~Follower() { feed_.Remove(*this); }
    Follower(const Follower&) = delete;
    Follower& operator=(const Follower&) = delete;

   private:
    friend class ChangeFeed;
    ChangeFeed& feed_;
    const std::string map_;
    const std::function<void()> wake_;
  };

  /// `wake` runs whenever the map may have changed or was deleted, on the changing thread: it must be quick and not
  /// call the feed. RESOURCE_EXHAUSTED, reason TOO_MANY_WATCHERS.
  Result<std::unique_ptr<Follower>> Follow(const std::string& map, std::function<void()> wake) DHPMAP_EXCLUDES(mutex_);

  /// See MapStore::ListChanges, with at most a page. Reads the store only for changes that are not cached.
  Result<ChangeList> Read(const std::string& map, std::int64_t after_revision) DHPMAP_EXCLUDES(read_mutex_, mutex_);

  /// The store has a new state of the map, or no longer has the map.
  void Notify(const std::string& map) DHPMAP_EXCLUDES(mutex_);

  [[nodiscard]] std::size_t num_followers() const DHPMAP_EXCLUDES(mutex_);
  /// Maps that have followers, by name.
  [[nodiscard]] std::vector<std::string> WatchedMaps() const DHPMAP_EXCLUDES(mutex_);
  /// Called whenever WatchedMaps changes: must be quick and not call the feed. Once, before the first call of Follow.
  void OnWatched(std::function<void()> on_watched) { on_watched_ = std::move(on_watched); }

 private:
  /// A map with followers.
  struct Channel {
    std::set<Follower*> followers;
    /// Cached changes: of all revisions after complete_after, up to `revision`.
    bool is_fresh = false;  ///< no change since
    bool has_read = false;
    std::uint64_t history_id = 0;
    std::int64_t revision = 0;
    std::int64_t complete_after = 0;
    std::deque<std::shared_ptr<const MapChange>> kept;
    std::size_t kept_bytes = 0;
  };

  void Remove(Follower& follower) DHPMAP_EXCLUDES(mutex_);
  Status Refresh(const std::string& map) DHPMAP_REQUIRES(read_mutex_) DHPMAP_EXCLUDES(mutex_);
  void Take(Channel& channel, const ChangeList& list) DHPMAP_REQUIRES(mutex_);
  void DropKept(Channel& channel) DHPMAP_REQUIRES(mutex_);
  void DropOldest(Channel& channel) DHPMAP_REQUIRES(mutex_);
  static ChangeList ListKept(const Channel& channel, std::int64_t after_revision);

  MapStore& store_;
  const std::size_t max_followers_;
  std::function<void()> on_watched_;
  Mutex read_mutex_
      DHPMAP_ACQUIRED_BEFORE(mutex_);  // held while the store is read, so that concurrent watchers read it once
  mutable Mutex mutex_;
  std::map<std::string, Channel> channels_ DHPMAP_GUARDED_BY(mutex_);
  std::size_t num_followers_ DHPMAP_GUARDED_BY(mutex_) = 0;
  std::size_t kept_bytes_ DHPMAP_GUARDED_BY(mutex_) = 0;  ///< of all channels
};

}  // namespace dhpmap

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <vector>

#include "mapping/base/mutex.h"
#include "mapping/base/result.h"
#include "mapping/map/lost_revisions.h"
#include "server/app/states/map_view.h"
#include "server/base/byte_budget.h"

namespace dhpmap {

/// The last stored states of a map, for reads of past revisions and for restoring them. Limited in number, and in the
/// bytes that each does not share with the next; the oldest are evicted first. The newest costs nothing until there is
/// a later one. Thread-safe.
class SnapshotHistory {
 public:
  using State = std::shared_ptr<const MapSnapshot>;
  using View = std::shared_ptr<const MapView>;

  /// `budget` is shared with other maps: a map without room evicts its own states. 0 states: keeps none.
  SnapshotHistory(std::size_t max_states, std::shared_ptr<ByteBudget> budget);

  /// Adds a newly stored state; ignored unless it is later than the others. One thread at a time. If it throws
  /// std::bad_alloc, the state is not kept.
  void Keep(State state) DHPMAP_EXCLUDES(mutex_);

  /// Whether one of them has evictable voxels in memory: read from a store, or with `even_written` any that could be
  /// spilled. Visits up to each tile of each.
  [[nodiscard]] bool HoldBlocks(bool even_written) const DHPMAP_EXCLUDES(mutex_);

  /// `same` is the newest state with evicted voxels (Map::EvictPages); it replaces that state, and older ones, which
  /// hold voxels, are evicted. One thread at a time, possibly another than Keep's.
  void EvictPages(State same) DHPMAP_EXCLUDES(mutex_);

  /// Null if the state of this revision is not kept.
  [[nodiscard]] View Find(std::int64_t revision) const DHPMAP_EXCLUDES(mutex_);

  /// The same without its indexes.
  [[nodiscard]] State StateAt(std::int64_t revision) const DHPMAP_EXCLUDES(mutex_);

  /// All of them, the oldest first.
  [[nodiscard]] std::vector<State> All() const DHPMAP_EXCLUDES(mutex_);

  /// The nearest kept revisions before and after one that is not kept.
  struct Neighbours {
    std::optional<std::int64_t> before, after;
  };
  [[nodiscard]] Neighbours Around(std::int64_t revision) const DHPMAP_EXCLUDES(mutex_);

  [[nodiscard]] std::size_t size() const DHPMAP_EXCLUDES(mutex_);
  /// Bytes that these states do not share with later ones.
  [[nodiscard]] std::size_t bytes() const DHPMAP_EXCLUDES(mutex_);

 private:
  struct Kept {
    State state;
    std::size_t bytes = 0;  ///< not shared with the next state
  };
  [[nodiscard]] State Newest() const DHPMAP_EXCLUDES(mutex_);
  [[nodiscard]] std::deque<Kept>::const_iterator FirstFrom(std::int64_t revision) const DHPMAP_REQUIRES(mutex_);

  const std::size_t max_states_;
  const std::shared_ptr<ByteBudget> budget_;
  mutable Mutex mutex_;
  ByteShare share_ DHPMAP_GUARDED_BY(mutex_);
  std::deque<Kept> kept_ DHPMAP_GUARDED_BY(mutex_);  ///< by ascending revision
  /// The last requested one, so that readers of one revision share an index.
  mutable View last_view_ DHPMAP_GUARDED_BY(mutex_);
};

/// The state at `revision`: `present`, or a kept one. INVALID_ARGUMENT, reason BAD_REVISION, unless it is positive and
/// the map has reached it; OUT_OF_RANGE, reason HISTORY_LOST, for a lost one, and REVISION_NOT_KEPT, with
/// `revision_before` and `revision_after` in the metadata, for one that is not kept. `field`: the request's field with
/// the revision.
Result<SnapshotHistory::View> ViewAt(std::int64_t revision, const SnapshotHistory::View& present,
                                     const SnapshotHistory& kept, const LostRevisions& lost, const std::string& field);

}  // namespace dhpmap

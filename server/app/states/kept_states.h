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

/// The states of a map that were stored last, for who reads the recent past or goes back to it. As many as there may
/// be, and as there is room for what each has that the next one does not share; the oldest go first. The newest costs
/// nothing: it is counted once there is a later one. Thread-safe.
class KeptStates {
 public:
  using State = std::shared_ptr<const MapSnapshot>;
  using View = std::shared_ptr<const MapView>;

  /// `budget` is shared with other maps: one that finds no room lets go of its own states. 0 states: keeps none.
  KeptStates(std::size_t max_states, std::shared_ptr<ByteBudget> budget);

  /// Of a state that the store holds from now on. Nothing, unless it is later than those before. One thread at a time.
  /// If it throws, for want of memory, the state is not kept.
  void Keep(State state) DHPMAP_EXCLUDES(mutex_);

  /// Whether one of them holds voxels in memory: of what was read from a store, or with `even_written` of anything that
  /// could be left on the disk. Costs up to a look at each tile of each.
  [[nodiscard]] bool HoldBlocks(bool even_written) const DHPMAP_EXCLUDES(mutex_);

  /// `same` is the newest state again, with voxels left on the disk (Map::LetGoOfPages): it takes the place of that
  /// one, and older states, which hold voxels, go. One thread at a time, which may be another than that of Keep.
  void LetGoOfPages(State same) DHPMAP_EXCLUDES(mutex_);

  /// Null if the state of this revision is not kept.
  [[nodiscard]] View Find(std::int64_t revision) const DHPMAP_EXCLUDES(mutex_);

  /// The same without what is looked up in it.
  [[nodiscard]] State StateAt(std::int64_t revision) const DHPMAP_EXCLUDES(mutex_);

  /// All of them, the oldest first.
  [[nodiscard]] std::vector<State> All() const DHPMAP_EXCLUDES(mutex_);

  /// The nearest revisions that are kept before and after one that is not.
  struct Neighbours {
    std::optional<std::int64_t> before, after;
  };
  [[nodiscard]] Neighbours Around(std::int64_t revision) const DHPMAP_EXCLUDES(mutex_);

  [[nodiscard]] std::size_t size() const DHPMAP_EXCLUDES(mutex_);
  /// What these states have that no later one shares.
  [[nodiscard]] std::size_t bytes() const DHPMAP_EXCLUDES(mutex_);

 private:
  struct Kept {
    State state;
    std::size_t bytes = 0;  ///< that the next one does not share
  };
  [[nodiscard]] State Newest() const DHPMAP_EXCLUDES(mutex_);
  [[nodiscard]] std::deque<Kept>::const_iterator FirstFrom(std::int64_t revision) const DHPMAP_REQUIRES(mutex_);

  const std::size_t max_states_;
  const std::shared_ptr<ByteBudget> budget_;
  mutable Mutex mutex_;
  ByteShare share_ DHPMAP_GUARDED_BY(mutex_);
  std::deque<Kept> kept_ DHPMAP_GUARDED_BY(mutex_);  ///< by ascending revision
  /// That was asked for last: an index is made once for all who read one revision.
  mutable View last_view_ DHPMAP_GUARDED_BY(mutex_);
};

/// The state at `revision`: `present`, or one that is kept. INVALID_ARGUMENT, reason BAD_REVISION, for a revision that
/// is not above 0 or that the map has not reached; OUT_OF_RANGE, reason HISTORY_LOST, for one that was lost, and
/// REVISION_NOT_KEPT, the metadata with `revision_before` and `revision_after`, for one that is not kept. `field` is
/// what of the request names the revision.
Result<KeptStates::View> ViewAt(std::int64_t revision, const KeptStates::View& present, const KeptStates& kept,
                                const LostRevisions& lost, const std::string& field);

}  // namespace dhpmap

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <list>
#include <map>
#include <optional>

#include "mapping/base/mutex.h"
#include "mapping/submap/submap_outline.h"

namespace dhpmap {

/// Outlines of a map's objects over all states: computed once while the object's tiles are the same objects in memory
/// (PartId), at any pose, and shared by clones. Least recently used ones are evicted. Thread-safe.
class OutlineCache {
 public:
  explicit OutlineCache(std::size_t most = 4096) : most_(most) {}

  /// Whether voxels may be read from disk for an unknown outline.
  enum class Reading { kAllowed, kNever };
  /// OutlineInMap of a submap of a snapshot. Nothing also if it is unknown and must not be read. Throws StatusError if
  /// it cannot be read.
  [[nodiscard]] std::optional<SubmapOutline> Find(const Submap& submap, Reading reading) DHPMAP_EXCLUDES(mutex_);

  [[nodiscard]] std::size_t size() const DHPMAP_EXCLUDES(mutex_);

 private:
  /// The inputs of an outline.
  struct Key {
    std::uint64_t tiles = 0;                    ///< hash of their places and names
    std::int64_t up_x = 0, up_y = 0, up_z = 0;  ///< the map's vertical in the submap's frame, in billionths
    auto operator<=>(const Key&) const = default;
  };
  struct Kept {
    Key key;
    std::optional<SubmapOutline> outline;  ///< in the submap's frame, levelled
  };
  static Key KeyOf(const Submap& submap);

  const std::size_t most_;
  mutable Mutex mutex_;                             // not held during computations
  std::list<Kept> kept_ DHPMAP_GUARDED_BY(mutex_);  ///< most recently used first
  std::map<Key, std::list<Kept>::iterator> by_key_ DHPMAP_GUARDED_BY(mutex_);
};

}  // namespace dhpmap

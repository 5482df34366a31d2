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

/// Outlines of the objects of a map, of all its states: one is found once for as long as the object's tiles are the
/// same objects in memory (PartId), wherever it is put, and its clones have it, too. What was asked for least lately
/// goes. Thread-safe.
class OutlineCache {
 public:
  explicit OutlineCache(std::size_t most = 4096) : most_(most) {}

  /// Whether what is not known yet may be read from the disk.
  enum class Reading { kAllowed, kNever };
  /// OutlineInMap of a submap of a snapshot. Nothing, too, if that is not known and must not be read. Throws
  /// StatusError if it cannot be read.
  [[nodiscard]] std::optional<SubmapOutline> Find(const Submap& submap, Reading reading) DHPMAP_EXCLUDES(mutex_);

  [[nodiscard]] std::size_t size() const DHPMAP_EXCLUDES(mutex_);

 private:
  /// What an outline follows from.
  struct Key {
    std::uint64_t tiles = 0;                    ///< a sum over their places and names
    std::int64_t up_x = 0, up_y = 0, up_z = 0;  ///< the map's vertical in the submap's frame, in billionths
    auto operator<=>(const Key&) const = default;
  };
  struct Kept {
    Key key;
    std::optional<SubmapOutline> outline;  ///< in the submap's frame, levelled
  };
  static Key KeyOf(const Submap& submap);

  const std::size_t most_;
  mutable Mutex mutex_;                             // nothing is worked out under it
  std::list<Kept> kept_ DHPMAP_GUARDED_BY(mutex_);  ///< what was asked for last comes first
  std::map<Key, std::list<Kept>::iterator> by_key_ DHPMAP_GUARDED_BY(mutex_);
};

}  // namespace dhpmap

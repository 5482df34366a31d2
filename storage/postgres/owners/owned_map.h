// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "mapping/base/mutex.h"
#include "mapping/changes/state_marks.h"
#include "storage/commit/store_number.h"
#include "storage/history/seen_clock.h"

namespace dhpmap::postgres {

/// A commit whose outcome is unknown.
struct Doubt {
  std::int64_t commit_id = 0;  ///< the map's counter, if the commit was made
  std::int64_t revision_before = 0;
  bool is_edit = false;
  std::shared_ptr<const StateMarks> after;  ///< null: the commit changed no state
};

/// A map that this process owns. Immutable except for what its mutex guards.
struct OwnedMap {
  OwnedMap(std::string map, std::int64_t map_key, std::int64_t owner_epoch, std::int64_t seen_before_ns,
           PassingTime time)
      : name(std::move(map)),
        key(map_key),
        epoch(owner_epoch),
        before_ns(seen_before_ns),
        passing(std::move(time)),
        began_ns(passing()) {}

  const std::string name;
  const std::int64_t key;
  const std::int64_t epoch;
  const std::uint16_t number = NextStoreNumber();  ///< blobs are counted by map
  const std::int64_t before_ns;
  const PassingTime passing;
  const std::int64_t began_ns;
  Mutex mutex;  ///< held during a commit
  std::optional<Doubt> doubt DHPMAP_GUARDED_BY(mutex);

  /// As SeenClock, for this map.
  [[nodiscard]] std::int64_t Now_ns() const { return before_ns + passing() - began_ns; }
};

}  // namespace dhpmap::postgres

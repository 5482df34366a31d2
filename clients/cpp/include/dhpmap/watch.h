// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "dhpmap/geometry.h"
#include "dhpmap/object.h"
#include "dhpmap/result.h"

namespace dhpmap::client {

struct WatchOptions {
  std::vector<std::int64_t> objects;  ///< only of these; with none of the three: of all
  std::vector<std::string> classes;
  std::optional<Box> region;                   ///< only of what touches it, in the map frame
  std::optional<std::int64_t> after_revision;  ///< begin after it, such as that of a list; default: from now on
  std::string resume_after;                    ///< begin after the `position` of a Change, in place of after_revision
  double reconnect_s = 300;                    ///< so long a lost connection is waited for
};

/// What became of one object.
struct Change {
  enum class Kind { kCreated, kChanged, kRemoved, kMerged };
  enum class Part { kPose, kLabels, kName, kActivity, kGeometry, kVoxelLabels, kObservation, kLock };

  Kind kind = Kind::kChanged;
  std::vector<Part> parts;        ///< of kChanged
  Object object;                  ///< as it is at `revision`; one that is gone, as it was
  std::int64_t revision = 0;      ///< up to which this is told
  std::int64_t merged_into = -1;  ///< of kMerged
  std::vector<Box> boxes;         ///< of kChanged: where its surface has, in the map frame
  std::string position;           ///< where to go on after this, the same for all of one revision
};

/// Tells what becomes of objects, as it is stored. A lost connection, or a server that starts anew, is waited for, and
/// nothing is left out. For one thread, but Close.
class Watch {
 public:
  Watch(Watch&&) noexcept;
  Watch& operator=(Watch&&) noexcept;
  /// Waits for nothing but the end of its own call, which it cancels.
  ~Watch();

  /// The next change; nothing if there is none for idle_s (below 0: waits as long as it takes), or after Close. Errors
  /// end the watch: OutOfRange, reason COMPACTED or HISTORY_LOST, where changes are no longer kept (list the map, and
  /// watch anew); NotFound if the map is deleted; Unavailable after reconnect_s without a server.
  Result<std::optional<Change>> Next(double idle_s = -1);
  /// Everything up to this is told; 0: the watch has not begun.
  [[nodiscard]] std::int64_t revision() const;
  /// Ends it: Next, also one that waits on another thread, returns nothing from now on. Safe from any thread.
  void Close();

 private:
  friend class Map;
  struct Impl;
  explicit Watch(std::unique_ptr<Impl> impl);

  std::unique_ptr<Impl> impl_;
};

}  // namespace dhpmap::client

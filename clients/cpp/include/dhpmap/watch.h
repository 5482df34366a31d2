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
  std::vector<std::int64_t> objects;  ///< only these; without objects, classes and region: all
  std::vector<std::string> classes;
  std::optional<Box> region;                   ///< only objects that touch it, in the map frame
  std::optional<std::int64_t> after_revision;  ///< begin after this revision, such as that of a list; default: now
  std::string resume_after;                    ///< begin after the `position` of a Change, in place of after_revision
  double reconnect_s = 300;                    ///< how long to wait for a lost connection
};

/// The change of one object.
struct Change {
  enum class Kind { kCreated, kChanged, kRemoved, kMerged };
  enum class Part { kPose, kLabels, kName, kActivity, kGeometry, kVoxelLabels, kObservation, kLock };

  Kind kind = Kind::kChanged;
  std::vector<Part> parts;        ///< of kChanged
  Object object;                  ///< as it is at `revision`; a removed one as it was
  std::int64_t revision = 0;      ///< of the latest change that is included
  std::int64_t merged_into = -1;  ///< for kMerged
  std::vector<Box> boxes;         ///< for kChanged: where its surface changed, in the map frame
  std::string position;           ///< for resume_after; equal for all changes of one revision
};

/// Reports changes of objects as they are stored. After a lost connection or a restart of the server it reconnects, and
/// no change is lost. For one thread, except Close.
class Watch {
 public:
  Watch(Watch&&) noexcept;
  Watch& operator=(Watch&&) noexcept;
  /// Cancels its own call only, and waits for its end.
  ~Watch();

  /// The next change; nothing if there is none for idle_s (below 0: waits without limit), or after Close. Errors end
  /// the watch: OutOfRange, reason COMPACTED or HISTORY_LOST, if changes are no longer kept (list the map and watch
  /// again); NotFound if the map is deleted; Unavailable after reconnect_s without a server.
  Result<std::optional<Change>> Next(double idle_s = -1);
  /// All changes up to this revision were returned; 0: the watch has not begun.
  [[nodiscard]] std::int64_t revision() const;
  /// Ends the watch: Next returns nothing from now on, even if it is waiting on another thread. Thread-safe.
  void Close();

 private:
  friend class Map;
  struct Impl;
  explicit Watch(std::unique_ptr<Impl> impl);

  std::unique_ptr<Impl> impl_;
};

}  // namespace dhpmap::client

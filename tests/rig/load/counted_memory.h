// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <thread>
#include <vector>

#include "mapping/base/mutex.h"
#include "tests/rig/server_under_test.h"

namespace dhpmap::rig {

/// What a server says it has (dhpmap_memory_bytes, its own count) against what the kernel says (RssAnon).
struct MemoryLook {
  double anonymous_mib = 0;    ///< the kernel's
  double counted_mib = 0;      ///< the server's, all kinds
  double unexplained_mib = 0;  ///< between them, either way, but for what a server without maps has
  [[nodiscard]] double unexplained_percent() const { return 100 * unexplained_mib / anonymous_mib; }
};

/// Compares both. What libraries and threads take is in no count of the server's: it is measured once, before there is
/// any map, and left out of every comparison.
class CountedMemory {
 public:
  /// The server has no map yet, and outlives this.
  explicit CountedMemory(ServerUnderTest& server);

  /// Of a server that tells nothing, all is unexplained.
  [[nodiscard]] MemoryLook Look() const;
  /// Anonymous memory of a server without maps, beyond what it counts then.
  [[nodiscard]] double of_libraries_mib() const { return of_libraries_mib_; }
  /// Prints what the server counts, by kind.
  void Tell() const;

 private:
  ServerUnderTest& server_;
  double of_libraries_mib_ = 0;
};

/// Looks again and again while this lives, twice a second or so.
class MemoryLooks {
 public:
  explicit MemoryLooks(const CountedMemory& memory);
  /// The looks so far, and no more.
  std::vector<MemoryLook> End() DHPMAP_EXCLUDES(mutex_);

 private:
  Mutex mutex_;
  std::vector<MemoryLook> looks_ DHPMAP_GUARDED_BY(mutex_);
  std::jthread thread_;  // last: uses the others
};

/// What is unexplained in nine of ten looks, %. The kernel's number and the parts of the server's are read one after
/// the other, so a look may fall on a moment at which much comes or goes. 100 if there was no look.
double UnexplainedInMost_percent(std::vector<MemoryLook> looks);

}  // namespace dhpmap::rig

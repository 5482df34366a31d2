// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <thread>

#include "mapping/base/mutex.h"
#include "storage/sqlite/database.h"

namespace dhpmap {

/// Gives back to the file system what was deleted, in steps of some milliseconds between which commits go on, each a
/// transaction of its own: after a kill the next one goes on. Begins a thread when there is something to do.
class SpaceReclaimer {
 public:
  /// How it gets at the connection that writes. Both wait for a commit that runs and keep others waiting.
  struct Writer {
    /// Runs its argument as one transaction.
    std::function<Status(const std::function<Status(sqlite::Database&)>&)> write;
    /// Runs its argument while nothing is written.
    std::function<Status(const std::function<Status()>&)> hold;
  };

  /// Free pages up to `num_spare_pages` stay, for what is stored next. `log` is a connection of its own to the same
  /// database that never waits for others. All that is given here outlives it.
  SpaceReclaimer(Writer writer, sqlite::Database log, std::int64_t num_spare_pages);
  /// After the step that is being done.
  ~SpaceReclaimer();
  SpaceReclaimer(const SpaceReclaimer&) = delete;
  SpaceReclaimer& operator=(const SpaceReclaimer&) = delete;

  /// To be told of a commit's free pages. Thread-safe; may be called from within `writer.write`.
  void Notice(std::int64_t num_free_pages);

  enum class Progress {
    kMore,
    kBlocked,  ///< a reader, such as a backup, needs the log, or the disk is full: to be tried again later
    kDone,
  };
  /// One step; for the thread, and for tests that have none.
  Progress Step();

 private:
  void Loop();
  Progress EmptyLog(Progress then);

  const Writer writer_;
  const std::int64_t num_spare_pages_;

  // Of whoever steps.
  sqlite::Database log_;
  std::int64_t num_pages_a_step_;
  std::int64_t num_pages_in_log_ = 0;

  Mutex mutex_;
  CondVar wake_;
  bool has_work_ DHPMAP_GUARDED_BY(mutex_) = false;
  bool is_stopping_ DHPMAP_GUARDED_BY(mutex_) = false;
  std::thread thread_ DHPMAP_GUARDED_BY(mutex_);
};

}  // namespace dhpmap

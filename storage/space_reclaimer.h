// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <limits>
#include <thread>

#include "mapping/base/mutex.h"
#include "storage/rows/kept_blobs.h"
#include "storage/sqlite/database.h"

namespace dhpmap {

/// Deletes unreferenced blobs, returns free pages to the file system, and truncates the log, in steps of some
/// milliseconds between commits. Each step is a transaction, so after a kill the next process continues. Starts a
/// thread when there is work.
class SpaceReclaimer {
 public:
  /// Access to the writing connection. Both functions wait for a running commit and block others.
  struct Writer {
    /// Runs its argument as one transaction, in its turn even under continuous commits.
    std::function<Status(const std::function<Status(sqlite::Database&)>&)> write;
    /// Runs its argument while there is no write.
    std::function<Status(const std::function<Status()>&)> hold;
  };

  static constexpr std::int64_t kKeepAll = std::numeric_limits<std::int64_t>::max();
  /// A longer log is copied into the file and truncated: well below the length at which a commit would do it (see
  /// connection.cc). Some 1024 pages of 4 kB.
  static constexpr std::int64_t kMaxLogBytes = 4'200'000;
  // A step blocks commits, so it is limited to this amount and to the duration kStep.
  static constexpr std::int64_t kMaxAStep = 512;           ///< number of blobs, and of pages
  static constexpr std::int64_t kMaxBytesAStep = 2 << 20;  ///< bytes of blobs; a larger blob takes a step of its own
  static constexpr std::chrono::milliseconds kStep{10};

  /// Keeps `num_spare_pages` free pages for the next commits; kKeepAll if the file cannot shrink. `log` is a separate
  /// connection to the same database that never waits for locks. Does not delete `kept` blobs (may be null). All
  /// arguments outlive this.
  SpaceReclaimer(Writer writer, sqlite::Database log, std::int64_t num_spare_pages, const KeptBlobs* kept = nullptr);
  /// Ends after the running step.
  ~SpaceReclaimer();
  SpaceReclaimer(const SpaceReclaimer&) = delete;
  SpaceReclaimer& operator=(const SpaceReclaimer&) = delete;

  /// Work left by a commit.
  struct Left {
    std::int64_t num_free_pages = 0;
    bool has_dead_blobs = false;
    std::int64_t log_bytes = 0;  ///< of the log's file
  };
  /// Call after each commit. Thread-safe; may be called from within `writer.write`.
  void Notice(const Left& left);

  enum class Progress {
    kMore,
    kBlocked,  ///< a reader, such as a backup, pins the log, or the disk is full: retry later
    kDone,
  };
  /// One step; public for tests without a thread.
  Progress Step();

 private:
  struct Work {
    std::int64_t num_blobs = 0;  ///< deleted
    std::int64_t num_pages = 0;  ///< given back
  };
  Result<Work> CollectAndGiveBack(sqlite::Database& database);
  void Loop();
  Progress EmptyLog(Progress then);
  /// Copies most of the log while commits continue, if that is safe.
  Status CopyLog();

  const Writer writer_;
  const std::int64_t num_spare_pages_;
  const KeptBlobs none_kept_;
  const KeptBlobs& kept_;

  // Used by the thread that runs a step.
  sqlite::Database log_;
  std::chrono::steady_clock::duration kept_writer_{};  ///< duration of the last step
  bool is_log_new_ = false;                            ///< nothing of it was copied yet
  bool has_given_back_ = false;                        ///< the file is truncated when the log is copied

  Mutex mutex_;
  CondVar wake_;
  bool has_work_ DHPMAP_GUARDED_BY(mutex_) = false;
  bool is_stopping_ DHPMAP_GUARDED_BY(mutex_) = false;
  std::thread thread_ DHPMAP_GUARDED_BY(mutex_);
};

}  // namespace dhpmap

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

/// Deletes blobs that nothing refers to any more, then gives back to the file system what was deleted, and cuts the
/// log, whoever filled it: in steps of some milliseconds between which commits go on, each a transaction of its own, so
/// after a kill the next one goes on. Begins a thread when there is something to do.
class SpaceReclaimer {
 public:
  /// How it gets at the connection that writes. Both wait for a commit that runs and keep others waiting.
  struct Writer {
    /// Runs its argument as one transaction, in its turn even where commits follow upon each other.
    std::function<Status(const std::function<Status(sqlite::Database&)>&)> write;
    /// Runs its argument while nothing is written.
    std::function<Status(const std::function<Status()>&)> hold;
  };

  static constexpr std::int64_t kKeepAll = std::numeric_limits<std::int64_t>::max();
  /// A log beyond is copied into the file and cut to nothing: well below what would make a commit copy it itself (see
  /// connection.cc). Some 1024 pages of 4 kB.
  static constexpr std::int64_t kMaxLogBytes = 4'200'000;
  // A step keeps commits waiting: it does no more than this, and nothing more once it has taken kStep.
  static constexpr std::int64_t kMaxAStep = 512;           ///< blobs, and as many pages
  static constexpr std::int64_t kMaxBytesAStep = 2 << 20;  ///< of blobs; a larger one has a step of its own
  static constexpr std::chrono::milliseconds kStep{10};

  /// Free pages up to `num_spare_pages` stay, for what is stored next; kKeepAll where the file cannot shrink. `log` is
  /// a connection of its own to the same database that never waits for others. Leaves alone the blobs that are `kept`,
  /// if it is not null. All that is given here outlives it.
  SpaceReclaimer(Writer writer, sqlite::Database log, std::int64_t num_spare_pages, const KeptBlobs* kept = nullptr);
  /// After the step that is being done.
  ~SpaceReclaimer();
  SpaceReclaimer(const SpaceReclaimer&) = delete;
  SpaceReclaimer& operator=(const SpaceReclaimer&) = delete;

  /// What a commit left to do.
  struct Left {
    std::int64_t num_free_pages = 0;
    bool has_dead_blobs = false;
    std::int64_t log_bytes = 0;  ///< of the log's file
  };
  /// To be told of it after each commit. Thread-safe; may be called from within `writer.write`.
  void Notice(const Left& left);

  enum class Progress {
    kMore,
    kBlocked,  ///< a reader, such as a backup, needs the log, or the disk is full: to be tried again later
    kDone,
  };
  /// One step. For the thread, and for tests that have none.
  Progress Step();

 private:
  struct Work {
    std::int64_t num_blobs = 0;  ///< deleted
    std::int64_t num_pages = 0;  ///< given back
  };
  Result<Work> CollectAndGiveBack(sqlite::Database& database);
  void Loop();
  Progress EmptyLog(Progress then);
  /// Most of it, beside commits, where that is safe.
  Status CopyLog();

  const Writer writer_;
  const std::int64_t num_spare_pages_;
  const KeptBlobs none_kept_;
  const KeptBlobs& kept_;

  // Of whoever steps.
  sqlite::Database log_;
  std::chrono::steady_clock::duration kept_writer_{};  ///< by the last step
  bool is_log_new_ = false;                            ///< nothing of it was copied yet
  bool has_given_back_ = false;                        ///< the file is cut when the log is copied

  Mutex mutex_;
  CondVar wake_;
  bool has_work_ DHPMAP_GUARDED_BY(mutex_) = false;
  bool is_stopping_ DHPMAP_GUARDED_BY(mutex_) = false;
  std::thread thread_ DHPMAP_GUARDED_BY(mutex_);
};

}  // namespace dhpmap

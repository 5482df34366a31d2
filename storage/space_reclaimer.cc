// SPDX-License-Identifier: BSD-3-Clause
#include "storage/space_reclaimer.h"

#include <algorithm>
#include <chrono>
#include <exception>
#include <system_error>
#include <utility>

#include "mapping/base/this_thread.h"
#include "storage/rows/tile_rows.h"
#include "storage/sqlite/free_pages.h"

namespace dhpmap {
namespace {

using Clock = std::chrono::steady_clock;
using std::chrono::milliseconds;

// Between two looks at the clock. SQLite searches the list of free pages for each page at the file's end, so a page
// takes longer the more are free: 10 us with a hundred MB, 100 us with a GB.
constexpr std::int64_t kPagesAtATime = 8;
constexpr milliseconds kRetry{1000};
/// Smaller than the log at which commits copy it: 4096 pages (see connection.cc).
constexpr std::int64_t kCommitsCopyLogBytes = 12'000'000;

}  // namespace

SpaceReclaimer::SpaceReclaimer(Writer writer, sqlite::Database log, std::int64_t num_spare_pages, const KeptBlobs* kept)
    : writer_(std::move(writer)),
      num_spare_pages_(num_spare_pages),
      kept_(kept != nullptr ? *kept : none_kept_),
      log_(std::move(log)) {}

SpaceReclaimer::~SpaceReclaimer() {
  std::thread thread;
  {
    const MutexLock lock(mutex_);
    is_stopping_ = true;
    wake_.NotifyAll();
    thread = std::move(thread_);
  }
  if (thread.joinable()) thread.join();
}

void SpaceReclaimer::Notice(const Left& left) {
  if (left.num_free_pages <= num_spare_pages_ && !left.has_dead_blobs && left.log_bytes <= kMaxLogBytes) return;
  const MutexLock lock(mutex_);
  has_work_ = true;
  wake_.NotifyAll();
  if (thread_.joinable() || is_stopping_) return;
  try {
    thread_ = std::thread([this] { Loop(); });
  } catch (const std::system_error&) {
    return;  // the next commit tries again
  }
}

void SpaceReclaimer::Loop() {
  NameThisThread("reclaim-space");
  MutexLock lock(mutex_);
  for (;;) {
    wake_.Wait(mutex_, [this]() DHPMAP_REQUIRES(mutex_) { return has_work_ || is_stopping_; });
    has_work_ = false;
    for (Progress progress = Progress::kMore; progress != Progress::kDone;) {
      if (is_stopping_) return;
      lock.Unlock();
      try {
        progress = Step();
      } catch (const std::exception&) {
        progress = Progress::kBlocked;  // memory has run out: as on a full disk
      }
      // Pause as long as it used the writer, so that others get the disk half of the time.
      const Clock::duration pause = progress == Progress::kBlocked ? kRetry : kept_writer_;
      lock.Lock();
      wake_.WaitFor(mutex_, pause, [this]() DHPMAP_REQUIRES(mutex_) { return is_stopping_; });
    }
  }
}

SpaceReclaimer::Progress SpaceReclaimer::Step() {
  if (log_.NumLogBytes() > kMaxLogBytes) return EmptyLog(Progress::kMore);
  Work work;
  Clock::time_point begin = Clock::now();
  const Status done = writer_.write([&](sqlite::Database& database) -> Status {
    begin = Clock::now();
    DHPMAP_ASSIGN_OR_RETURN(work, CollectAndGiveBack(database));
    return Status::Ok();
  });
  kept_writer_ = Clock::now() - begin;
  if (!done.ok()) return EmptyLog(Progress::kBlocked);  // the disk may be full, and the log uses space
  if (work.num_pages > 0) has_given_back_ = true;
  if (work.num_blobs > 0 || work.num_pages > 0) return Progress::kMore;
  return has_given_back_ ? EmptyLog(Progress::kDone) : Progress::kDone;
}

Result<SpaceReclaimer::Work> SpaceReclaimer::CollectAndGiveBack(sqlite::Database& database) {
  const Clock::time_point end = Clock::now() + kStep;
  DHPMAP_ASSIGN_OR_RETURN(
      const Collected collected,
      CollectDeadBlobs(database, {.max_blobs = kMaxAStep, .max_bytes = kMaxBytesAStep, .end = end}, kept_));
  Work work{.num_blobs = collected.num_blobs};
  // Continue in the same step: if each commit leaves a few blobs, pages would otherwise never be freed.
  if (collected.has_more || num_spare_pages_ == kKeepAll) return work;
  DHPMAP_ASSIGN_OR_RETURN(const std::int64_t num_free, sqlite::NumFreePages(database));
  const std::int64_t num_pages = std::clamp<std::int64_t>(num_free - num_spare_pages_, 0, kMaxAStep);
  while (work.num_pages < num_pages) {
    const std::int64_t num_next = std::min(kPagesAtATime, num_pages - work.num_pages);
    DHPMAP_RETURN_IF_ERROR(sqlite::GiveBackPages(database, num_next));
    work.num_pages += num_next;
    if (Clock::now() >= end) break;
  }
  return work;
}

// SQLite before 3.51.3 may lose pages if a commit on one connection restarts the log, after all of it was copied, while
// another connection starts a checkpoint. So besides those of commits, start checkpoints only on a log of which nothing
// was copied.
Status SpaceReclaimer::CopyLog() {
  const bool is_safe = is_log_new_ && log_.NumLogBytes() < kCommitsCopyLogBytes;
  is_log_new_ = false;
  return is_safe ? sqlite::CopyLog(log_).status() : Status::Ok();
}

SpaceReclaimer::Progress SpaceReclaimer::EmptyLog(Progress then) {
  if (!CopyLog().ok()) return Progress::kBlocked;
  Result<sqlite::LogState> state = sqlite::LogState::kInUse;
  const Status cut = writer_.hold([&]() -> Status {
    const Clock::time_point begin = Clock::now();
    state = sqlite::CutLog(log_);
    is_log_new_ = state.ok() && *state == sqlite::LogState::kEmptied;
    kept_writer_ = Clock::now() - begin;
    return state.status();
  });
  if (!cut.ok() || *state == sqlite::LogState::kInUse) return Progress::kBlocked;
  has_given_back_ = false;
  return then;
}

}  // namespace dhpmap

// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/paging/page_reader.h"

#include <chrono>
#include <utility>

#include "mapping/base/mutex.h"
#include "mapping/base/status_error.h"

namespace dhpmap {
namespace {

struct Shared {
  Mutex mutex;
  CondVar has_changed;
  PageReaderLimit limit DHPMAP_GUARDED_BY(mutex);
  std::int64_t bytes DHPMAP_GUARDED_BY(mutex) = 0;
  int num_waiting DHPMAP_GUARDED_BY(mutex) = 0;
};
Shared& OfProcess() {
  static Shared shared;
  return shared;
}

thread_local PageHold* current = nullptr;

}  // namespace

void SetPageReaderLimit(const PageReaderLimit& limit) {
  Shared& shared = OfProcess();
  const MutexLock lock(shared.mutex);
  shared.limit = limit;
  shared.has_changed.NotifyAll();
}

std::int64_t PageReaderBytes() {
  Shared& shared = OfProcess();
  const MutexLock lock(shared.mutex);
  return shared.bytes;
}

int NumPageReadersWaiting() {
  Shared& shared = OfProcess();
  const MutexLock lock(shared.mutex);
  return shared.num_waiting;
}

PageHold::~PageHold() {
  if (bytes_ == 0) return;
  Shared& shared = OfProcess();
  const MutexLock lock(shared.mutex);
  shared.bytes -= bytes_;
  shared.has_changed.NotifyAll();
}

PageReader::PageReader(PageHold& hold) noexcept : outer_(std::exchange(current, &hold)) {}

PageReader::PageReader(PageHold* hold) noexcept : outer_(std::exchange(current, hold)) {}

PageReader::~PageReader() { current = outer_; }

PageHold* PageReader::Current() noexcept { return current; }

void PageReader::Admit() {
  const PageHold* const hold = current;
  if (hold == nullptr) return;
  Shared& shared = OfProcess();
  const MutexLock lock(shared.mutex);
  const auto has_room = [&]() DHPMAP_REQUIRES(shared.mutex) {
    return shared.limit.bytes <= 0 || shared.bytes < shared.limit.bytes;
  };
  if (has_room()) return;
  const auto others_hold_some = [&]() DHPMAP_REQUIRES(shared.mutex) { return shared.bytes > hold->bytes_; };
  const auto wait = std::chrono::duration_cast<CondVar::Clock::duration>(
      std::chrono::duration<double>(others_hold_some() ? shared.limit.wait_s : 0));
  ++shared.num_waiting;
  const bool is_admitted = shared.has_changed.WaitFor(shared.mutex, wait, has_room);
  --shared.num_waiting;
  if (is_admitted) return;
  throw StatusError(ResourceExhausted(others_hold_some()
                                          ? "other requests hold as many voxels in memory as they may: try again later"
                                          : "this needs more voxels in memory than requests may hold: ask for less at "
                                            "once, or raise store.memory_budget_mib")
                        .WithReason("OVER_MEMORY_BUDGET"));
}

void PageReader::Count(std::int64_t bytes) noexcept {
  if (current == nullptr) return;
  Shared& shared = OfProcess();
  const MutexLock lock(shared.mutex);
  shared.bytes += bytes;
  current->bytes_ += bytes;  // under the mutex, too: several threads may read for one request
}

PageReader::Passing::Passing() noexcept : suspended_(std::exchange(current, nullptr)) {}

PageReader::Passing::~Passing() { current = suspended_; }

}  // namespace dhpmap

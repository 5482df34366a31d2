// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/refinement/bounded_loop.h"

#include <list>
#include <numeric>
#include <optional>

#include "mapping/base/mutex.h"

namespace dhpmap {
namespace {

/// The waiting items, and the total size of the running ones. Thread-safe.
class Waiting {
 public:
  Waiting(std::span<const std::size_t> sizes, std::size_t most_at_once)
      : sizes_(sizes), most_at_once_(most_at_once), items_(sizes.size()) {
    std::iota(items_.begin(), items_.end(), std::size_t{0});
  }

  /// The next item that fits, waiting for one if necessary; nothing when all were taken.
  std::optional<std::size_t> Take() DHPMAP_EXCLUDES(mutex_) {
    const MutexLock lock(mutex_);
    while (!items_.empty()) {
      for (auto item = items_.begin(); item != items_.end(); ++item) {
        if (under_way_ != 0 && under_way_ + sizes_[*item] > most_at_once_) continue;
        const std::size_t taken = *item;
        items_.erase(item);
        under_way_ += sizes_[taken];
        return taken;
      }
      has_room_.Wait(mutex_);
    }
    return std::nullopt;
  }

  void Return(std::size_t item) DHPMAP_EXCLUDES(mutex_) {
    const MutexLock lock(mutex_);
    under_way_ -= sizes_[item];
    has_room_.NotifyAll();
  }

  void DropAll() DHPMAP_EXCLUDES(mutex_) {
    const MutexLock lock(mutex_);
    items_.clear();
    has_room_.NotifyAll();
  }

 private:
  const std::span<const std::size_t> sizes_;
  const std::size_t most_at_once_;
  Mutex mutex_;
  CondVar has_room_;
  std::list<std::size_t> items_ DHPMAP_GUARDED_BY(mutex_);
  std::size_t under_way_ DHPMAP_GUARDED_BY(mutex_) = 0;
};

}  // namespace

void BoundedParallelFor(ThreadPool& pool, std::span<const std::size_t> sizes, std::size_t most_at_once,
                        const std::function<void(std::size_t)>& body) {
  Waiting waiting(sizes, most_at_once);
  pool.ParallelFor(static_cast<std::size_t>(pool.num_threads()), [&](std::size_t) {
    while (const std::optional<std::size_t> item = waiting.Take()) {
      try {
        body(*item);
      } catch (...) {
        waiting.DropAll();
        waiting.Return(*item);
        throw;
      }
      waiting.Return(*item);
    }
  });
}

}  // namespace dhpmap

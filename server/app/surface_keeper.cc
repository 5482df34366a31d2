// SPDX-License-Identifier: BSD-3-Clause
#include "server/app/surface_keeper.h"

#include <exception>
#include <new>
#include <utility>

#include "mapping/base/this_thread.h"

namespace dhpmap {

void SurfaceKeeper::Note(std::shared_ptr<const MapSnapshot> state) {
  if (!cache_.IsWanted(state->info().name)) return;
  const MutexLock lock(mutex_);
  if (stopping_) return;
  try {
    if (!thread_.Start([this] { Loop(); }).ok()) return;
    newest_[state->info().name].swap(state);
  } catch (const std::bad_alloc&) {
    return;  // who asks makes it, or is told
  }
  wake_.NotifyOne();
}

void SurfaceKeeper::Stop() {
  {
    const MutexLock lock(mutex_);
    stopping_ = true;
    newest_.clear();
  }
  stop_.request_stop();
  wake_.NotifyAll();
  thread_.Join();
}

void SurfaceKeeper::Loop() {
  constexpr int kNiceness = 10;  // after frames and quick answers, before bulk ones
  NameThisThread("surfaces");
  MakeThisThreadNicer(kNiceness);
  MutexLock lock(mutex_);
  const auto has_work = [this]() DHPMAP_REQUIRES(mutex_) { return stopping_ || !newest_.empty(); };
  while (wake_.WaitFor(mutex_, LazyThread::kIdle, has_work) && !stopping_) {
    std::shared_ptr<const MapSnapshot> state = std::move(newest_.begin()->second);
    newest_.erase(newest_.begin());
    lock.Unlock();
    try {
      cache_.Freshen(state, stop_.get_token());
    } catch (const std::exception&) {
      // As above.
    }
    state.reset();
    lock.Lock();
  }
  thread_.Retire();
}

}  // namespace dhpmap

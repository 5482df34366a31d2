// SPDX-License-Identifier: BSD-3-Clause
#include "server/app/surface_keeper.h"

#include <new>
#include <utility>

#include "mapping/base/this_thread.h"

namespace dhpmap {

void SurfaceKeeper::Note(std::shared_ptr<const MapSnapshot> state) {
  const std::string name = state->info().name;
  if (!cache_.IsWanted(name)) return;
  const MutexLock lock(mutex_);
  if (stopping_) return;
  if (!thread_.Start([this] { Loop(); }).ok()) return;  // who asks makes it
  newest_[name].swap(state);
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
  constexpr int kNiceness = 10;  // as bulk answers: after frames and quick ones
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
    } catch (const std::bad_alloc&) {
      // Who asks makes it, or is told that there is no memory.
    }
    state.reset();
    lock.Lock();
  }
  thread_.Retire();
}

}  // namespace dhpmap

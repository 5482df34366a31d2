// SPDX-License-Identifier: BSD-3-Clause
#include "server/app/maps/surface_keeper.h"

#include <exception>
#include <new>
#include <utility>

#include "mapping/base/guarded.h"
#include "mapping/base/this_thread.h"

namespace dhpmap {

bool SurfaceKeeper::Note(std::shared_ptr<const MapSnapshot> state, std::function<void()> ready) {
  if (!cache_.IsWanted(state->info().name)) return false;
  Noted noted{std::move(state), std::move(ready)};
  const MutexLock lock(mutex_);
  if (stopping_) return false;
  try {
    if (!thread_.Start([this] { Loop(); }).ok()) return false;
    std::swap(newest_[noted.state->info().name], noted);
  } catch (const std::bad_alloc&) {
    return false;  // the query makes the surfaces, or gets the error
  }
  wake_.NotifyOne();
  return true;
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
  constexpr int kNiceness = 5;  // as for fusion: states are not visible before
  NameThisThread("surfaces");
  MakeThisThreadNicer(kNiceness);
  (void)TakeTurns(Turns::kOrdinary);  // a thread with quick turns may have started this one
  MutexLock lock(mutex_);
  const auto has_work = [this]() DHPMAP_REQUIRES(mutex_) { return stopping_ || !newest_.empty(); };
  std::string last;
  while (wake_.WaitFor(mutex_, LazyThread::kIdle, has_work) && !stopping_) {
    auto next = newest_.upper_bound(last);  // in turn, because there may be more work than time
    if (next == newest_.end()) next = newest_.begin();
    Noted noted = std::move(next->second);
    last = next->first;
    newest_.erase(next);
    lock.Unlock();
    try {
      cache_.Freshen(noted.state, stop_.get_token());
    } catch (const std::exception&) {
      // Queries make these surfaces.
    }
    if (noted.ready) TellSafely(noted.ready);
    noted = {};
    lock.Lock();
  }
  thread_.Retire();
}

}  // namespace dhpmap

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
    return false;  // who asks makes it, or is told
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
  constexpr int kNiceness = 5;  // as those that fuse: until it has made them, nobody sees a state
  NameThisThread("surfaces");
  MakeThisThreadNicer(kNiceness);
  (void)TakeTurns(Turns::kOrdinary);  // a quick thread may have begun it
  MutexLock lock(mutex_);
  const auto has_work = [this]() DHPMAP_REQUIRES(mutex_) { return stopping_ || !newest_.empty(); };
  std::string last;
  while (wake_.WaitFor(mutex_, LazyThread::kIdle, has_work) && !stopping_) {
    auto next = newest_.upper_bound(last);  // in turn: there may be more to do than time
    if (next == newest_.end()) next = newest_.begin();
    Noted noted = std::move(next->second);
    last = next->first;
    newest_.erase(next);
    lock.Unlock();
    try {
      cache_.Freshen(noted.state, stop_.get_token());
    } catch (const std::exception&) {
      // As above.
    }
    if (noted.ready) TellSafely(noted.ready);
    noted = {};
    lock.Lock();
  }
  thread_.Retire();
}

}  // namespace dhpmap

// SPDX-License-Identifier: BSD-3-Clause
#include "server/app/states/pinned_snapshots.h"

#include <algorithm>
#include <chrono>
#include <exception>
#include <numeric>
#include <tuple>
#include <utility>

#include "mapping/base/this_thread.h"
#include "server/app/states/state_bytes.h"

namespace dhpmap {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::chrono::milliseconds kBetweenLooks{200};
constexpr int kMostShareOfACore = 25;  // the pause between looks is at least this many times the duration of a look

/// Expected memory of old states until the next look: 1.5 times as much.
std::size_t WithGrowth(std::size_t bytes) { return bytes + bytes / 2; }

/// `now_of`: returns the submap in a later state, or null.
template <typename NowOf>
std::size_t BytesNotIn(const MapSnapshot& before, NowOf&& now_of) {
  std::size_t bytes = 0;
  for (const auto& submap : before.submaps()) {
    const Submap* now = now_of(submap->id());
    if (now != submap.get()) bytes += BlockBytesNotIn(*submap, now);
  }
  return bytes;
}

bool IsOfSameMap(const MapSnapshot& a, const MapSnapshot& b) {
  return a.info().history_id == b.info().history_id && a.info().name == b.info().name;
}

}  // namespace

std::shared_ptr<const MapSnapshot> OnlySubmap(const MapSnapshot& state, SubmapId submap) {
  for (const auto& each : state.submaps()) {
    if (each->id() == submap) return std::make_shared<const MapSnapshot>(state.info(), std::vector{each});
  }
  return nullptr;
}

struct PinnedSnapshots::Pin::Held {
  Held(State s, OnEvict how) : state(std::move(s)), on_evict(std::move(how)) {}

  void AskToLetGo() DHPMAP_EXCLUDES(mutex) {
    const MutexLock lock(mutex);
    if (on_evict) on_evict();
  }
  [[nodiscard]] bool CanLetGo() DHPMAP_EXCLUDES(mutex) {
    const MutexLock lock(mutex);
    return on_evict != nullptr;
  }

  const State state;
  Mutex mutex;
  OnEvict on_evict DHPMAP_GUARDED_BY(mutex);  ///< empty: cannot be evicted, or was already
};

PinnedSnapshots::Pin::Pin(std::shared_ptr<Held> held) : held_(std::move(held)) {}

PinnedSnapshots::Pin::~Pin() {
  const MutexLock lock(held_->mutex);  // waits for a running callback
  held_->on_evict = nullptr;
}

PinnedSnapshots::PinnedSnapshots(ByteBudget& budget, PresentOf present_of)
    : limit_bytes_(budget.limit_bytes()),
      present_of_(std::move(present_of)),
      share_(&budget),
      looker_([this] { LookAgainAndAgain(); }) {}

PinnedSnapshots::~PinnedSnapshots() {
  {
    const MutexLock lock(mutex_);
    stopping_ = true;
  }
  wake_.NotifyOne();
  looker_.join();
}

std::unique_ptr<PinnedSnapshots::Pin> PinnedSnapshots::TryPin(State state, OnEvict on_evict) {
  auto held = std::make_shared<Held>(std::move(state), std::move(on_evict));
  {
    const MutexLock lock(mutex_);
    if (bytes_ > limit_bytes_ / 2) return nullptr;
    held_.push_back(held);
    wake_.NotifyOne();
  }
  return std::unique_ptr<Pin>(new Pin(std::move(held)));
}

std::size_t PinnedSnapshots::bytes() const {
  const MutexLock lock(mutex_);
  return bytes_;
}

bool PinnedSnapshots::Count(std::size_t bytes) {
  const MutexLock lock(mutex_);
  bytes_ = bytes;
  const bool has_room = share_.Resize(WithGrowth(bytes));
  reserved_.Set(share_.bytes());
  return has_room;
}

std::vector<std::shared_ptr<PinnedSnapshots::Held>> PinnedSnapshots::StillHeld() {
  std::vector<std::shared_ptr<Held>> states;
  {
    const MutexLock lock(mutex_);
    std::erase_if(held_, [](const auto& held) { return held.expired(); });
    for (const auto& held : held_) {
      if (auto state = held.lock()) states.push_back(std::move(state));
    }
  }
  const auto order = [](const MapSnapshot& state) {
    return std::tuple(state.info().name, state.info().history_id, state.revision());
  };
  std::stable_sort(states.begin(), states.end(),
                   [&](const auto& a, const auto& b) { return order(*a->state) < order(*b->state); });
  return states;
}

/// The oldest evictable state of the map with most memory; held.size() if there is none.
std::size_t PinnedSnapshots::OldestEvictable(const std::vector<std::shared_ptr<Held>>& held,
                                             const std::vector<std::size_t>& bytes) {
  const auto most = static_cast<std::size_t>(std::max_element(bytes.begin(), bytes.end()) - bytes.begin());
  for (std::size_t i = 0; i < held.size(); ++i) {
    if (IsOfSameMap(*held[i]->state, *held[most]->state) && held[i]->CanLetGo()) return i;
  }
  return held.size();
}

/// The bytes of the i-th state that neither a later one nor the current one has: data that were replaced do not return.
/// 0 if the state is kept anyway.
std::size_t PinnedSnapshots::BytesAlone(const std::vector<std::shared_ptr<Held>>& held, std::size_t i) const {
  const MapSnapshot& state = *held[i]->state;
  std::size_t end = i + 1;
  while (end < held.size() && IsOfSameMap(state, *held[end]->state)) ++end;
  const State present = present_of_(state);
  const bool is_kept = present != nullptr && present->revision() == state.revision();
  if (is_kept) end = i + 1;
  return BytesNotIn(state, [&](SubmapId id) -> const Submap* {
    for (std::size_t later = i + 1; later < end; ++later) {
      if (const Submap* submap = held[later]->state->Find(id)) return submap;
    }
    return present != nullptr ? present->Find(id) : nullptr;
  });
}

void PinnedSnapshots::Look() {
  const MutexLock look(look_mutex_);
  std::vector<std::shared_ptr<Held>> held = StillHeld();
  std::vector<std::size_t> bytes;
  for (std::size_t i = 0; i < held.size(); ++i) bytes.push_back(BytesAlone(held, i));
  while (!Count(std::accumulate(bytes.begin(), bytes.end(), std::size_t{0}))) {
    const std::size_t oldest = OldestEvictable(held, bytes);
    if (oldest == held.size()) return;
    held[oldest]->AskToLetGo();
    // Count it as freed; if it is not, the next look asks again.
    held.erase(held.begin() + static_cast<std::ptrdiff_t>(oldest));
    bytes.erase(bytes.begin() + static_cast<std::ptrdiff_t>(oldest));
    if (oldest > 0) bytes[oldest - 1] = BytesAlone(held, oldest - 1);
  }
}

void PinnedSnapshots::LookAgainAndAgain() {
  NameThisThread("held-states");
  MutexLock lock(mutex_);
  while (true) {
    wake_.Wait(mutex_, [this]() DHPMAP_REQUIRES(mutex_) { return stopping_ || !held_.empty() || bytes_ > 0; });
    if (stopping_) return;
    lock.Unlock();
    const auto begin = Clock::now();
    try {
      Look();
    } catch (const std::exception&) {
      // Memory has run out: keep the current count and try again at the next look.
    }
    const auto pause = std::max<Clock::duration>(kBetweenLooks, kMostShareOfACore * (Clock::now() - begin));
    lock.Lock();
    wake_.WaitFor(mutex_, pause, [this]() DHPMAP_REQUIRES(mutex_) { return stopping_; });
  }
}

}  // namespace dhpmap

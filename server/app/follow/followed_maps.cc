// SPDX-License-Identifier: BSD-3-Clause
#include "server/app/follow/followed_maps.h"

#include <algorithm>
#include <utility>

#include "server/app/states/state_bytes.h"

namespace dhpmap {
namespace {

/// A copy that was read within this time is not evicted to make room for another.
constexpr std::chrono::seconds kInUse{10};

Status NoRoom() {
  return ResourceExhausted("the server has no room for a copy of one more map: ask its owner, without EVENTUAL")
      .WithReason("TOO_BUSY");
}

Status IsStopped() { return Unavailable("the server is shutting down").WithReason("SHUTTING_DOWN"); }

std::size_t BytesOf(const MapSnapshot& state) { return StateBytesNotIn(state, MapSnapshot(MapInfo(), {})); }

}  // namespace

FollowedMaps::FollowedMaps(MapStore& store, Fleet& fleet, FollowOptions options)
    : store_(store),
      fleet_(fleet),
      options_(std::move(options)),
      budget_(options_.max_bytes),
      listener_(std::make_shared<Listener>()) {
  {
    const MutexLock lock(listener_->mutex);
    listener_->maps = this;
  }
  fleet_.OnChange([listener = listener_](const std::string& map, std::int64_t) {
    const MutexLock lock(listener->mutex);
    if (listener->maps != nullptr) listener->maps->OnCommit(map);
  });
  fleet_.MeasureFollowing([listener = listener_] {
    const MutexLock lock(listener->mutex);
    return listener->maps != nullptr ? listener->maps->StateAt(Clock::now()) : FollowingState();
  });
  thread_ = std::thread([this] { Loop(); });
}

FollowedMaps::~FollowedMaps() { Stop(); }

void FollowedMaps::Stop() {
  {
    const MutexLock lock(listener_->mutex);
    listener_->maps = nullptr;
  }
  std::map<std::string, CopyPtr> gone;  // freed after the mutex is released, here and below: freeing a map takes long
  {
    const MutexLock lock(mutex_);
    is_stopping_ = true;
    gone.swap(copies_);
  }
  wake_.NotifyAll();
  if (thread_.joinable()) thread_.join();
}

Result<FollowedMaps::View> FollowedMaps::ViewOf(const std::string& name, std::int64_t at_least) {
  for (bool may_go_on = true;;) {
    DHPMAP_ASSIGN_OR_RETURN(const CopyPtr copy, FindOrAdd(name));
    View view = ViewIn(*copy);
    if (view == nullptr) {
      DHPMAP_ASSIGN_OR_RETURN(view, Read(name, *copy));
    } else if (may_go_on && view->snapshot().revision() < at_least) {
      may_go_on = false;
      GoOn(name, *copy);
      continue;
    }
    if (view != nullptr) return view;
  }
}

FollowedMaps::View FollowedMaps::ViewIn(const Copy& copy) const {
  const MutexLock lock(mutex_);
  return copy.view;
}

Result<FollowedMaps::CopyPtr> FollowedMaps::FindOrAdd(const std::string& name) {
  CopyPtr gone;
  const MutexLock lock(mutex_);
  if (is_stopping_) return IsStopped();
  auto found = copies_.find(name);
  if (found == copies_.end()) {
    if (copies_.size() >= options_.max_maps && (gone = TakeLeastUsed(nullptr)) == nullptr) return NoRoom();
    found = copies_.emplace(name, std::make_shared<Copy>(budget_)).first;
    is_interest_new_ = true;  // set before the map is read, so that no later commit is missed
    wake_.NotifyOne();
  }
  found->second->last_used = Clock::now();
  return found->second;
}

/// Reads a copy for the first time. Null: the copy was dropped while this call waited for another reader.
Result<FollowedMaps::View> FollowedMaps::Read(const std::string& name, Copy& copy) {
  const MutexLock busy(copy.busy);
  {
    const MutexLock lock(mutex_);
    if (copy.view != nullptr) return copy.view;
    if (copy.is_dropped) return View();
  }
  Result<StateToRead> read = store_.LoadToRead(name);
  Status status = read.status();
  if (status.ok() && !MakeRoomFor(copy, BytesOf(*read->snapshot))) status = NoRoom();
  if (!status.ok()) {
    DropCopy(name, copy);
    return status;
  }
  copy.state = *std::move(read);
  auto view = std::make_shared<const MapView>(copy.state.snapshot);
  const MutexLock lock(mutex_);
  copy.view = view;
  copy.is_behind = true;  // a commit may have come before the fleet knew of our interest
  wake_.NotifyOne();
  return View(std::move(view));
}

bool FollowedMaps::MakeRoomFor(Copy& copy, std::size_t bytes) {
  while (!copy.share.Resize(bytes)) {
    CopyPtr gone;
    const MutexLock lock(mutex_);
    gone = TakeLeastUsed(&copy);
    if (gone == nullptr) return false;
  }
  return true;
}

FollowedMaps::CopyPtr FollowedMaps::TakeLeastUsed(const Copy* except) {
  auto least = copies_.end();
  for (auto it = copies_.begin(); it != copies_.end(); ++it) {
    const bool is_older = least == copies_.end() || it->second->last_used < least->second->last_used;
    if (it->second.get() != except && it->second->view != nullptr && is_older) least = it;
  }
  if (least == copies_.end() || Clock::now() - least->second->last_used < kInUse) return nullptr;
  CopyPtr taken = std::move(least->second);
  taken->is_dropped = true;
  copies_.erase(least);
  is_interest_new_ = true;
  return taken;
}

void FollowedMaps::DropCopy(const std::string& name, const Copy& copy) {
  CopyPtr gone;
  const MutexLock lock(mutex_);
  const auto found = copies_.find(name);
  if (found == copies_.end() || found->second.get() != &copy) return;
  gone = std::move(found->second);
  gone->is_dropped = true;
  copies_.erase(found);
  is_interest_new_ = true;
}

void FollowedMaps::Drop(const std::string& name) {
  CopyPtr gone;
  const MutexLock lock(mutex_);
  const auto found = copies_.find(name);
  if (found == copies_.end()) return;
  gone = found->second;
  gone->is_dropped = true;
  copies_.erase(found);
  is_interest_new_ = true;
}

void FollowedMaps::DropIdle(Clock::time_point now) {
  if (options_.idle_drop_s.count() <= 0) return;
  std::vector<CopyPtr> gone;
  const MutexLock lock(mutex_);
  for (auto it = copies_.begin(); it != copies_.end();) {
    const bool is_idle = it->second->view != nullptr && now - it->second->last_used > options_.idle_drop_s;
    if (is_idle) {
      it->second->is_dropped = is_interest_new_ = true;
      gone.push_back(std::move(it->second));
    }
    it = is_idle ? copies_.erase(it) : std::next(it);
  }
}

FollowedMaps::View FollowedMaps::Find(const std::string& name) const {
  const MutexLock lock(mutex_);
  const auto found = copies_.find(name);
  return found != copies_.end() ? found->second->view : nullptr;
}

std::size_t FollowedMaps::num_maps() const {
  const MutexLock lock(mutex_);
  return copies_.size();
}

FollowingState FollowedMaps::StateAt(Clock::time_point now) const {
  const MutexLock lock(mutex_);
  FollowingState state{.num_copies = static_cast<std::int64_t>(copies_.size()),
                       .bytes = static_cast<std::int64_t>(bytes())};
  for (const auto& entry : copies_) {
    const auto& since = entry.second->behind_since;
    if (since) state.behind_s = std::max(state.behind_s, std::chrono::duration<double>(now - *since).count());
  }
  return state;
}

}  // namespace dhpmap

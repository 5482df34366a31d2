// SPDX-License-Identifier: BSD-3-Clause
// The thread of FollowedMaps. It updates the copies after commits.
#include <algorithm>
#include <utility>

#include "mapping/base/guarded.h"
#include "mapping/base/this_thread.h"
#include "server/app/follow/followed_maps.h"
#include "server/app/states/state_bytes.h"

namespace dhpmap {
namespace {

/// Pause after the store did not answer.
constexpr std::chrono::milliseconds kTryAgain{250};

}  // namespace

void FollowedMaps::OnCommit(const std::string& name) {
  if (options_.on_commit) options_.on_commit(name);
  const MutexLock lock(mutex_);
  const auto found = copies_.find(name);
  if (found == copies_.end()) return;
  Copy& copy = *found->second;
  copy.is_behind = true;
  if (copy.view != nullptr && !copy.unread_since) copy.unread_since = Clock::now();
  if (!copy.behind_since) copy.behind_since = copy.unread_since;
  wake_.NotifyOne();
}

void FollowedMaps::NoteWatched() {
  const MutexLock lock(mutex_);
  is_interest_new_ = true;
  wake_.NotifyOne();
}

bool FollowedMaps::HasWork() const {
  if (is_stopping_ || is_interest_new_) return true;
  for (const auto& entry : copies_) {
    if (entry.second->is_behind && entry.second->view != nullptr) return true;
  }
  return false;
}

void FollowedMaps::Loop() {
  NameThisThread("follower");
  for (;;) {
    {
      MutexLock lock(mutex_);
      const auto pause = copies_.empty() ? options_.look_every : std::min(options_.look_every, kTryAgain);
      (void)wake_.WaitFor(mutex_, pause, [this]() DHPMAP_REQUIRES(mutex_) { return HasWork(); });
      if (is_stopping_) return;
    }
    TellSafely([this] {
      TellInterest();
      DropIdle(Clock::now());
      for (const auto& [name, copy] : TakeDue()) GoOn(name, *copy);
    });
  }
}

void FollowedMaps::TellInterest() {
  std::vector<std::string> names;
  {
    const MutexLock lock(mutex_);
    if (!std::exchange(is_interest_new_, false)) return;
    for (const auto& entry : copies_) names.push_back(entry.first);
  }
  if (options_.watched) {
    for (std::string& name : options_.watched()) names.push_back(std::move(name));
  }
  std::sort(names.begin(), names.end());
  names.erase(std::unique(names.begin(), names.end()), names.end());
  if (names == told_) return;
  told_ = names;
  fleet_.SetFollowed(std::move(names));
}

/// Takes the copies with a known new commit, and those that were not checked for long.
std::vector<std::pair<std::string, FollowedMaps::CopyPtr>> FollowedMaps::TakeDue() {
  const auto now = Clock::now();
  std::vector<std::pair<std::string, CopyPtr>> due;
  const MutexLock lock(mutex_);
  for (const auto& [name, copy] : copies_) {
    if (copy->view == nullptr || (!copy->is_behind && now < copy->look_at)) continue;
    copy->is_behind = false;
    copy->look_at = now + options_.look_every;
    due.emplace_back(name, copy);
  }
  return due;
}

/// Drops a copy that cannot be updated. The next read then loads the map again, or returns the error.
void FollowedMaps::GoOn(const std::string& name, Copy& copy) {
  const auto gone_on = Guarded<Status>([&]() -> Status {
    const MutexLock busy(copy.busy);
    {
      const MutexLock lock(mutex_);
      copy.unread_since.reset();  // what is committed by now is read
    }
    return GoOnFrom(copy);
  });
  if (!gone_on.ok() && gone_on.code() != StatusCode::kUnavailable) return DropCopy(name, copy);
  const MutexLock lock(mutex_);
  if (gone_on.ok()) copy.behind_since = copy.unread_since;
  else copy.look_at = Clock::now() + kTryAgain;
}

Status FollowedMaps::GoOnFrom(Copy& copy) {
  DHPMAP_ASSIGN_OR_RETURN(StateToRead later, store_.ReadSince(copy.state));
  const auto before = copy.state.snapshot, after = later.snapshot;
  copy.state = std::move(later);
  if (after == before) return Status::Ok();
  const std::size_t bytes = copy.share.bytes() + StateBytesNotIn(*after, *before) -
                            std::min(copy.share.bytes(), StateBytesNotIn(*before, *after));
  if (!MakeRoomFor(copy, bytes)) return ResourceExhausted("there is no room for the copy any longer");
  auto view = std::make_shared<const MapView>(after, ViewIn(copy).get());
  {
    const MutexLock lock(mutex_);
    copy.view.swap(view);
  }
  if (options_.on_state) options_.on_state(after);
  return Status::Ok();
}

}  // namespace dhpmap

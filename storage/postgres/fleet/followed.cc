// SPDX-License-Identifier: BSD-3-Clause
// FleetMember's look for commits of other processes.
#include <utility>

#include "mapping/base/guarded.h"
#include "storage/postgres/fleet/fleet_member.h"

namespace dhpmap::postgres {

void FleetMember::OnChange(std::function<void(const std::string& map, std::int64_t revision)> on_change) {
  on_change_ = std::move(on_change);
}

void FleetMember::MeasureFollowing(std::function<FollowingState()> measure) {
  const MutexLock lock(mutex_);
  measure_ = std::move(measure);
}

std::optional<FollowingState> FleetMember::Following() const {
  if (!schema_.Has(kFollowingStep)) return std::nullopt;
  std::function<FollowingState()> measure;
  {
    const MutexLock lock(mutex_);
    measure = measure_;
  }
  return measure ? measure() : FollowingState();
}

void FleetMember::SetFollowed(std::vector<std::string> maps) {
  const MutexLock lock(mutex_);
  followed_ = std::move(maps);
  wake_.NotifyAll();
}

Status FleetMember::LookAtFollowed() {
  std::vector<std::string> followed;
  {
    const MutexLock lock(mutex_);
    followed = followed_;
  }
  std::map<std::string, std::int64_t> changed;
  {
    const MutexLock lock(connection_mutex_);
    std::map<std::string, PresentCommit> present;
    if (!followed.empty()) {
      DHPMAP_ASSIGN_OR_RETURN(Connection* const connection, Connected());
      DHPMAP_ASSIGN_OR_RETURN(present, ReadPresent(*connection, followed));
    }
    for (const std::string& map : followed) {
      const auto now = present.find(map);
      const auto before = seen_.find(map);
      const bool is_there = now != present.end(), was_there = before != seen_.end();
      if (is_there && (!was_there || !(before->second == now->second))) changed[map] = now->second.revision;
      if (!is_there && was_there) changed[map] = 0;
    }
    seen_ = std::move(present);
  }
  for (const auto& change : changed) {
    const bool is_ours = maps_.Find(change.first) != nullptr;  // its commits are reported where they are made
    if (!is_ours && on_change_) TellSafely([&] { on_change_(change.first, change.second); });
  }
  return Status::Ok();
}

}  // namespace dhpmap::postgres

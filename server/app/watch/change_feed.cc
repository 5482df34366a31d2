// SPDX-License-Identifier: BSD-3-Clause
#include "server/app/watch/change_feed.h"

#include <algorithm>
#include <limits>
#include <utility>

namespace dhpmap {

Result<std::unique_ptr<ChangeFeed::Follower>> ChangeFeed::Follow(const std::string& map, std::function<void()> wake) {
  auto follower = std::make_unique<Follower>(*this, map, std::move(wake));
  const MutexLock lock(mutex_);
  if (num_followers_ >= max_followers_) {
    return ResourceExhausted("as many watch maps as the server allows, " + std::to_string(max_followers_) +
                             ": try again later")
        .WithReason("TOO_MANY_WATCHERS");
  }
  std::set<Follower*>& followers = channels_[map].followers;
  followers.insert(follower.get());
  ++num_followers_;
  if (followers.size() == 1 && on_watched_) on_watched_();
  return follower;
}

void ChangeFeed::Remove(Follower& follower) {
  const MutexLock lock(mutex_);
  const auto channel = channels_.find(follower.map_);
  if (channel == channels_.end() || channel->second.followers.erase(&follower) == 0) return;  // it was refused
  --num_followers_;
  if (!channel->second.followers.empty()) return;
  DropKept(channel->second);
  channels_.erase(channel);
  if (on_watched_) on_watched_();
}

void ChangeFeed::Notify(const std::string& map) {
  const MutexLock lock(mutex_);
  const auto channel = channels_.find(map);
  if (channel == channels_.end()) return;
  channel->second.is_fresh = false;
  for (const Follower* follower : channel->second.followers) follower->wake_();
}

std::size_t ChangeFeed::num_followers() const {
  const MutexLock lock(mutex_);
  return num_followers_;
}

std::vector<std::string> ChangeFeed::WatchedMaps() const {
  const MutexLock lock(mutex_);
  std::vector<std::string> maps;
  for (const auto& channel : channels_) maps.push_back(channel.first);
  return maps;
}

void ChangeFeed::DropOldest(Channel& channel) {
  const MapChange& oldest = *channel.kept.front();
  channel.complete_after = oldest.last_revision;
  channel.kept_bytes -= BytesOf(oldest);
  kept_bytes_ -= BytesOf(oldest);
  channel.kept.pop_front();
}

void ChangeFeed::DropKept(Channel& channel) {
  channel.kept.clear();
  kept_bytes_ -= std::exchange(channel.kept_bytes, 0);
}

void ChangeFeed::Take(Channel& channel, const ChangeList& list) {
  if (!channel.has_read || channel.history_id != list.history_id || list.revision < channel.revision) {
    DropKept(channel);
    channel.complete_after = list.revision;  // earlier changes are read on demand
    if (!list.changes.empty()) channel.complete_after = list.changes.front()->first_revision - 1;
  }
  channel.has_read = true;
  channel.history_id = list.history_id;
  channel.revision = list.has_more ? list.changes.back()->last_revision : list.revision;
  for (const auto& change : list.changes) {
    channel.kept.push_back(change);
    channel.kept_bytes += BytesOf(*change);
    kept_bytes_ += BytesOf(*change);
  }
  while (!channel.kept.empty() && (channel.kept_bytes > kKept_bytes || kept_bytes_ > kKeptOfAll_bytes)) {
    DropOldest(channel);
  }
}

ChangeList ChangeFeed::ListKept(const Channel& channel, std::int64_t after_revision) {
  ChangeList list{.history_id = channel.history_id,
                  .revision = channel.revision,
                  .complete_after = channel.complete_after,
                  .changes = {}};
  const auto next =
      std::upper_bound(channel.kept.begin(), channel.kept.end(), after_revision,
                       [](std::int64_t revision, const auto& change) { return revision < change->last_revision; });
  std::size_t num_bytes = 0;
  for (auto change = next; change != channel.kept.end(); ++change) {
    if (num_bytes >= kPage_bytes) return list.has_more = true, list;
    num_bytes += BytesOf(**change);
    list.changes.push_back(*change);
  }
  return list;
}

/// Reads the stored changes after the last one read.
Status ChangeFeed::Refresh(const std::string& map) {
  std::int64_t after = -1;
  {
    const MutexLock lock(mutex_);
    const auto found = channels_.find(map);
    if (found == channels_.end() || found->second.is_fresh) return Status::Ok();
    found->second.is_fresh = true;  // unless another change occurs from now on
    if (found->second.has_read) after = found->second.revision;
  }
  if (after < 0) after = std::numeric_limits<std::int64_t>::max();  // start at the current state
  const Result<ChangeList> list = store_.ListChanges(map, after, kPage_bytes);
  const MutexLock lock(mutex_);
  const auto found = channels_.find(map);
  if (found == channels_.end()) return list.status();
  Channel& channel = found->second;
  if (!list.ok()) {
    channel.is_fresh = channel.has_read = false;
    const bool is_too_far_behind = list.status().code() == StatusCode::kOutOfRange;
    return is_too_far_behind ? Status::Ok() : list.status();  // each follower reads from its own position
  }
  if (list->has_more) channel.is_fresh = false;
  Take(channel, *list);
  return Status::Ok();
}

Result<ChangeList> ChangeFeed::Read(const std::string& map, std::int64_t after_revision) {
  const MutexLock read_lock(read_mutex_);
  DHPMAP_RETURN_IF_ERROR(Refresh(map));
  {
    const MutexLock lock(mutex_);
    const auto found = channels_.find(map);
    const bool has_all = found != channels_.end() && found->second.has_read &&
                         after_revision >= found->second.complete_after && found->second.revision > after_revision;
    if (has_all) return ListKept(found->second, after_revision);
    const bool is_at_end = found != channels_.end() && found->second.is_fresh && found->second.has_read &&
                           after_revision >= found->second.revision;
    if (is_at_end) return ListKept(found->second, after_revision);
  }
  return store_.ListChanges(map, after_revision, kPage_bytes);
}

}  // namespace dhpmap

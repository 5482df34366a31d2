// SPDX-License-Identifier: BSD-3-Clause
#include "server/app/feeds/session_list.h"

#include <algorithm>
#include <chrono>
#include <map>

namespace dhpmap {
namespace {

/// Remaining lease time; the full lease while a frame is being processed.
double LeaseLeft(const Feed& feed, const FeedSeats& seats) {
  using Seconds = std::chrono::duration<double>;
  const auto now = seats.Now(), end = feed.last_active() + seats.idle_limit();
  if (feed.IsIdle(now, seats.idle_limit())) return 0;
  return end <= now ? Seconds(seats.idle_limit()).count() : Seconds(end - now).count();
}

}  // namespace

std::vector<SessionStatus> ListSessions(
    const FeedSeats& seats, const SessionMarks& marks,
    const std::function<std::optional<std::int64_t>(const std::string& session, Feed* feed)>& stored,
    std::int64_t now_ns) {
  std::map<std::string, SessionStatus> by_name;
  std::map<std::string, std::shared_ptr<Feed>> feeds;
  for (const SessionMark& mark : marks.marks()) {
    SessionStatus& status = by_name[mark.session];
    status.accepted_sequence = mark.sequence;
    status.counts.last_seen_ns = mark.time_ns;
  }
  for (const auto& feed : seats.Feeds()) {
    SessionStatus& status = by_name[feed->session()];
    status.is_feeding = true;
    status.lease_left_s = LeaseLeft(*feed, seats);
    feeds[feed->session()] = feed;
  }
  for (const auto& [session, tally] : seats.Tallies()) {
    SessionStatus& status = by_name[session];
    const std::int64_t marked_ns = status.counts.last_seen_ns;
    status.counts = tally->Counts(now_ns);
    status.path = tally->Path();
    status.counts.last_seen_ns = std::max(status.counts.last_seen_ns, marked_ns);
    if (!session.empty() && status.counts.accepted_sequence) status.accepted_sequence = status.counts.accepted_sequence;
  }
  std::vector<SessionStatus> list;
  for (auto& [session, status] : by_name) {
    status.session = session;
    const auto feed = feeds.find(session);
    status.stored_sequence = stored(session, feed != feeds.end() ? feed->second.get() : nullptr);
    list.push_back(std::move(status));
  }
  return list;
}

}  // namespace dhpmap

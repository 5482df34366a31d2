// SPDX-License-Identifier: BSD-3-Clause
#include "storage/postgres/fleet/peers.h"

#include <cmath>
#include <utility>

namespace dhpmap::postgres {
namespace {

constexpr std::int64_t kLeasesUntilForgotten = 100;

}  // namespace

Peers::Peers(std::int64_t me, double lease_s, PassingTime time)
    : me_(me), lease_ns_(std::llround(lease_s * 1e9)), time_(OrSteadyClock(std::move(time))) {}

bool Peers::ComesLate(std::int64_t sent_ns) const {
  const MutexLock lock(mutex_);
  return last_sent_ns_ && sent_ns - *last_sent_ns_ >= lease_ns_ / 2;
}

void Peers::OnBeaten(std::int64_t sent_ns, const std::vector<ServerRow>& rows) {
  const std::int64_t now_ns = time_();
  const MutexLock lock(mutex_);
  // Silence counts only while rows were read.
  const bool begins_anew = last_sent_ns_ && sent_ns - *last_sent_ns_ >= lease_ns_ / 2;
  last_sent_ns_ = sent_ns;
  for (auto& [server, peer] : peers_) {
    ServerRow gone{.server = server, .beat = kNoRow};
    for (const ServerRow& row : rows) {
      if (row.server == server) gone = row;
    }
    See(gone, now_ns, begins_anew);
  }
  for (const ServerRow& row : rows) {
    if (!peers_.contains(row.server)) See(row, now_ns, begins_anew);
  }
  std::erase_if(peers_, [&](const auto& entry) {
    return entry.second.row.beat == kNoRow && now_ns - entry.second.changed_ns > kLeasesUntilForgotten * lease_ns_;
  });
}

void Peers::See(const ServerRow& row, std::int64_t now_ns, bool begins_anew) {
  const auto [place, is_new] = peers_.try_emplace(row.server);
  Peer& peer = place->second;
  const bool has_changed = is_new || row.beat != peer.row.beat;
  if (has_changed || begins_anew) peer.changed_ns = now_ns;
  peer.has_beaten = row.beat != kNoRow && ((has_changed && !is_new) || (peer.has_beaten && !begins_anew));
  peer.row = row;
}

bool Peers::IsFreshAt(std::int64_t now_ns) const { return last_sent_ns_ && now_ns - *last_sent_ns_ < lease_ns_ / 2; }

bool Peers::IsFresh() const {
  const std::int64_t now_ns = time_();
  const MutexLock lock(mutex_);
  return IsFreshAt(now_ns);
}

Peers::Verdict Peers::VerdictOf(const Peer& peer, std::int64_t now_ns) const {
  if (!IsFreshAt(now_ns)) return Verdict::kUnclear;
  if (now_ns - peer.changed_ns > lease_ns_) return Verdict::kDead;
  return peer.has_beaten ? Verdict::kAlive : Verdict::kUnclear;
}

Peers::Opinion Peers::OpinionOf(std::int64_t server) {
  const std::int64_t now_ns = time_();
  const MutexLock lock(mutex_);
  const auto [place, is_new] = peers_.try_emplace(server);
  if (is_new) place->second = {.row = {.server = server, .beat = kNoRow}, .changed_ns = now_ns};
  return {VerdictOf(place->second, now_ns), place->second.row.beat, now_ns - place->second.changed_ns};
}

std::vector<Peers::Judged> Peers::All() const {
  const std::int64_t now_ns = time_();
  const MutexLock lock(mutex_);
  std::vector<Judged> all;
  for (const auto& [server, peer] : peers_) {
    if (peer.row.beat != kNoRow) all.push_back({peer.row, VerdictOf(peer, now_ns)});
  }
  return all;
}

std::optional<ServerRow> Peers::Find(std::int64_t server) const {
  const MutexLock lock(mutex_);
  const auto found = peers_.find(server);
  if (found == peers_.end() || found->second.row.beat == kNoRow) return std::nullopt;
  return found->second.row;
}

std::vector<std::int64_t> Peers::LongDead() const {
  const std::int64_t now_ns = time_();
  const MutexLock lock(mutex_);
  std::vector<std::int64_t> dead;
  if (!IsFreshAt(now_ns)) return dead;
  for (const auto& [server, peer] : peers_) {
    const bool is_old = now_ns - peer.changed_ns > kLeasesUntilForgotten * lease_ns_;
    if (is_old && peer.row.beat != kNoRow && server != me_) dead.push_back(server);
  }
  return dead;
}

std::vector<std::int64_t> Peers::Takers() const {
  const std::int64_t now_ns = time_();
  const MutexLock lock(mutex_);
  std::vector<std::int64_t> takers;
  for (const auto& [server, peer] : peers_) {
    if (server != me_ && !peer.row.is_draining && VerdictOf(peer, now_ns) == Verdict::kAlive) takers.push_back(server);
  }
  return takers;
}

}  // namespace dhpmap::postgres

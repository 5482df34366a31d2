// SPDX-License-Identifier: BSD-3-Clause
#include "server/grpc/relay/peer_troubles.h"

#include <utility>

#include "server/log/log.h"

namespace dhpmap {

PeerTroubles::PeerTroubles(std::function<Clock::time_point()> now)
    : now_(now ? std::move(now) : [] { return Clock::now(); }) {}

void PeerTroubles::Note(const std::string& address, const std::string& why) {
  const auto now = now_();
  {
    const MutexLock lock(mutex_);
    const bool has_place = logged_at_.contains(address) || logged_at_.size() < kMostPeers;
    const auto [entry, is_new] = logged_at_.try_emplace(has_place ? address : std::string(), now);
    if (!is_new && now - entry->second < kPause) return;
    entry->second = now;
  }
  LogWarning("the server of the fleet at " + address + " cannot be reached: " + why);
}

}  // namespace dhpmap

// SPDX-License-Identifier: BSD-3-Clause
#include "server/net/peer_table.h"

#include <algorithm>

namespace dhpmap::net {
namespace {

/// Limit of disconnected peers whose limits have not recovered; beyond it they are dropped anyway.
constexpr std::size_t kMostGone = 16'384;

}  // namespace

bool PeerCounts::TakeReset(Time now) {
  const MutexLock lock(mutex_);
  return resets_.Take(now);
}

bool PeerCounts::TakeControl(Time now) {
  const MutexLock lock(mutex_);
  return control_.Take(now);
}

bool PeerCounts::IsAtRest(Time now) {
  const MutexLock lock(mutex_);
  resets_.Fill(now);
  control_.Fill(now);
  return resets_.is_full() && control_.is_full();
}

std::shared_ptr<PeerCounts> PeerTable::Join(const std::string& key, Time now) {
  const MutexLock lock(mutex_);
  if (peers_.size() >= forget_at_) Forget(now);
  std::shared_ptr<PeerCounts>& counts = peers_[key];
  if (counts == nullptr) counts = std::make_shared<PeerCounts>();
  if (static_cast<std::size_t>(counts.use_count() - 1) >= most_) return nullptr;  // one reference is ours
  return counts;
}

void PeerTable::Forget(Time now) {
  std::erase_if(peers_, [now](const auto& peer) { return peer.second.use_count() == 1 && peer.second->IsAtRest(now); });
  if (peers_.size() >= kMostGone) {
    std::erase_if(peers_, [](const auto& peer) { return peer.second.use_count() == 1; });
  }
  forget_at_ = 2 * std::max<std::size_t>(peers_.size(), 32);
}

std::size_t PeerTable::size() const {
  const MutexLock lock(mutex_);
  return peers_.size();
}

}  // namespace dhpmap::net

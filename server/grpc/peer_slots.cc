// SPDX-License-Identifier: BSD-3-Clause
#include "server/grpc/peer_slots.h"

namespace dhpmap {

std::size_t PeerSlots::Of(const std::string& peer_key) {
  if (peer_key.empty()) return 0;
  const MutexLock lock(mutex_);
  if (const auto found = by_peer_.find(peer_key); found != by_peer_.end()) return found->second;
  if (by_peer_.size() >= kMostPeers) by_peer_.clear();  // open connections keep their slots, which then may be shared
  const std::size_t slot = next_;
  next_ = next_ + 1 < kNum ? next_ + 1 : 1;
  by_peer_.emplace(peer_key, slot);
  if (slots_[slot].first.empty()) {
    slots_[slot].first = peer_key;
  } else {
    slots_[slot].is_shared = true;
  }
  return slot;
}

std::string PeerSlots::KeyOf(std::size_t slot) const {
  if (slot == 0) return {};
  const MutexLock lock(mutex_);
  return slots_[slot].is_shared ? "slot " + std::to_string(slot) : slots_[slot].first;
}

}  // namespace dhpmap

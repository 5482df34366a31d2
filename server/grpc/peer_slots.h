// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <map>
#include <string>

#include "mapping/base/mutex.h"

namespace dhpmap {

/// Assigns connections to gRPC's acceptors by peer. gRPC (1.51) tells the check of a call's key nothing about the
/// connection but its acceptor's credentials. So each peer gets an acceptor of its own until they run out; further
/// peers share them. Thread-safe.
class PeerSlots {
 public:
  static constexpr std::size_t kNum = 64;
  static constexpr std::size_t kMostPeers = 4096;  ///< remembered at most; then the table starts empty again

  /// The slot of a connection from that peer (net::PeerKey). An empty key has slot 0 to itself.
  std::size_t Of(const std::string& peer_key) DHPMAP_EXCLUDES(mutex_);
  /// The name under which wrong keys of the slot are counted: its only peer, or a name for all peers that share it;
  /// empty for 0.
  [[nodiscard]] std::string KeyOf(std::size_t slot) const DHPMAP_EXCLUDES(mutex_);

 private:
  struct Slot {
    std::string first;
    bool is_shared = false;
  };
  mutable Mutex mutex_;
  std::size_t next_ DHPMAP_GUARDED_BY(mutex_) = 1;
  std::map<std::string, std::size_t> by_peer_ DHPMAP_GUARDED_BY(mutex_);
  std::array<Slot, kNum> slots_ DHPMAP_GUARDED_BY(mutex_);
};

}  // namespace dhpmap

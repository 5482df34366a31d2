// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <map>
#include <string>

#include "mapping/base/mutex.h"

namespace dhpmap {

/// By which of gRPC's acceptors a connection comes in. What looks at a call's key learns nothing of the call's
/// connection from gRPC (1.51) but its acceptor's credentials: so peers get acceptors of their own, while there are
/// some, and share them beyond. Thread-safe.
class PeerSlots {
 public:
  static constexpr std::size_t kNum = 64;
  static constexpr std::size_t kMostPeers = 4096;  ///< that are remembered; then all begin anew

  /// Of a connection from there (net::PeerKey); empty: none, slot 0, which nobody else has.
  std::size_t Of(const std::string& peer_key) DHPMAP_EXCLUDES(mutex_);
  /// Under what wrong keys of the slot count: its only peer, or a name for all of it that is no address; empty for 0.
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

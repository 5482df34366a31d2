// SPDX-License-Identifier: BSD-3-Clause
#include "server/net/refusal_log.h"

#include <chrono>
#include <utility>

#include "server/log/log.h"

namespace dhpmap::net {

void RefusalLog::Note(Refusal why, const PeerIdentity& peer) {
  if (on_refused_) on_refused_(why);
  std::uint64_t num_others = 0;
  {
    const MutexLock lock(mutex_);
    if (!lines_.Take(std::chrono::steady_clock::now())) {
      ++num_untold_;
      return;
    }
    num_others = std::exchange(num_untold_, 0);
  }
  std::string line = door_ + ": closed the connection of " + peer.address + ": " + std::string(RefusalName(why));
  if (num_others > 0) line += " (and " + std::to_string(num_others) + " others since the last such line)";
  LogWarning(line);
}

}  // namespace dhpmap::net

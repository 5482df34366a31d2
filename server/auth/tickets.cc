// SPDX-License-Identifier: BSD-3-Clause
#include "server/auth/tickets.h"

#include <array>
#include <utility>

namespace dhpmap::auth {

std::shared_ptr<Tickets::Ticket> Tickets::Issue(PrincipalPtr principal) {
  std::array<unsigned char, 16> bytes{};
  randomness_(bytes);
  std::string text = HexOf(bytes);
  {
    const MutexLock lock(mutex_);
    issued_.emplace(text, std::move(principal));
  }
  return std::make_shared<Ticket>(*this, std::move(text));
}

PrincipalPtr Tickets::Take(std::string_view text) {
  const MutexLock lock(mutex_);
  const auto found = issued_.find(text);
  if (found == issued_.end()) return nullptr;
  PrincipalPtr principal = std::move(found->second);
  issued_.erase(found);
  return principal;
}

}  // namespace dhpmap::auth

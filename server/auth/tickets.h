// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <memory>
#include <string>
#include <string_view>

#include "mapping/base/mutex.h"
#include "server/auth/keys/key_text.h"
#include "server/auth/keys/principal.h"

namespace dhpmap::auth {

/// Metadata by which the REST door says for whom it calls, in place of `authorization`: gRPC asks no processor of calls
/// inside the process. From outside it is refused.
inline constexpr char kTicketKey[] = "dhpmap-ticket";

/// Names of calls that the REST door makes for somebody: random, good once, and no longer than the call. Thread-safe.
/// Outlives its tickets.
class Tickets {
 public:
  /// Good while it lives, or until it is taken.
  class Ticket {
   public:
    Ticket(Tickets& tickets, std::string text) : tickets_(tickets), text_(std::move(text)) {}
    ~Ticket() { (void)tickets_.Take(text_); }
    Ticket(const Ticket&) = delete;
    Ticket& operator=(const Ticket&) = delete;
    [[nodiscard]] const std::string& text() const { return text_; }

   private:
    Tickets& tickets_;
    const std::string text_;
  };

  explicit Tickets(Randomness randomness) : randomness_(std::move(randomness)) {}

  std::shared_ptr<Ticket> Issue(PrincipalPtr principal) DHPMAP_EXCLUDES(mutex_);
  /// For whom it was issued; null if it was not, or has been taken.
  PrincipalPtr Take(std::string_view text) DHPMAP_EXCLUDES(mutex_);

 private:
  const Randomness randomness_;
  Mutex mutex_;
  std::map<std::string, PrincipalPtr, std::less<>> issued_ DHPMAP_GUARDED_BY(mutex_);
};

}  // namespace dhpmap::auth

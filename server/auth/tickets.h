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

/// Metadata that names the ticket of a REST call, in place of `authorization`: gRPC runs no auth processor for
/// in-process calls. Refused in calls from outside.
inline constexpr char kTicketKey[] = "dhpmap-ticket";

/// One-time random tickets for calls that the REST door makes for a principal. A ticket ends with its call.
/// Thread-safe. Outlives its tickets.
class Tickets {
 public:
  /// Valid until it is destroyed or taken.
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
  /// The principal of a ticket; null if it is unknown or already taken.
  PrincipalPtr Take(std::string_view text) DHPMAP_EXCLUDES(mutex_);

 private:
  const Randomness randomness_;
  Mutex mutex_;
  std::map<std::string, PrincipalPtr, std::less<>> issued_ DHPMAP_GUARDED_BY(mutex_);
};

}  // namespace dhpmap::auth

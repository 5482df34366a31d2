// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "mapping/base/status.h"
#include "server/http/message.h"

namespace dhpmap::http {

struct Authority {
  std::string_view host;  ///< a name or an address, without brackets
  std::string_view port;  ///< empty if missing
};

/// "host", "host:port", "[::1]:port". Nothing for any other form.
std::optional<Authority> SplitAuthority(std::string_view text);

/// The host names of a server. By DNS rebinding a web page can make a browser send requests here under a name of its
/// own, or from its own origin: both are refused. Immutable, so thread-safe.
class HostNames {
 public:
  /// `bound_host`: the host it listens on; `allowed`: further names ("maps.example.com", without a port).
  HostNames(std::string bound_host, std::vector<std::string> allowed);

  /// Checks the Host of a request on a connection to `local_address`. INVALID_ARGUMENT for a missing (HTTP/1.0 may omit
  /// it), repeated or malformed Host; PERMISSION_DENIED, reason HOST_NOT_ALLOWED, for an unknown name.
  [[nodiscard]] Status Check(const RequestHead& head, bool is_http_1_1, std::string_view local_address) const;

  /// Whether a web page sent the request that is neither of this server nor of an allowed name. The request must have
  /// passed Check.
  [[nodiscard]] bool IsFromForeignPage(const RequestHead& head, std::string_view local_address) const;

 private:
  [[nodiscard]] bool IsAllowed(std::string_view host) const;
  [[nodiscard]] bool IsOurs(std::string_view host, std::string_view local_address) const;

  std::string bound_host_;
  std::vector<std::string> allowed_;
};

}  // namespace dhpmap::http

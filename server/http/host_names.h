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
  std::string_view port;  ///< empty if there is none
};

/// "host", "host:port", "[::1]:port". Nothing for anything else.
std::optional<Authority> SplitAuthority(std::string_view text);

/// The names by which a server may be called. A web page can make a browser send requests here under a name of its
/// own (DNS rebinding), and from its own origin: neither is answered. Immutable, so thread-safe.
class HostNames {
 public:
  /// `bound_host` is what the server listens on; `allowed` are further names ("maps.example.com", without a port).
  HostNames(std::string bound_host, std::vector<std::string> allowed);

  /// Of one request on a connection to `local_address`. INVALID_ARGUMENT for no Host (HTTP/1.0 may omit it), more than
  /// one, or one that is malformed; PERMISSION_DENIED, reason HOST_NOT_ALLOWED, for a name that is not ours.
  [[nodiscard]] Status Check(const RequestHead& head, bool is_http_1_1, std::string_view local_address) const;

  /// A web page sent the request that is neither from this server nor from an allowed name. Of a request that Check
  /// has passed.
  [[nodiscard]] bool IsFromForeignPage(const RequestHead& head, std::string_view local_address) const;

 private:
  [[nodiscard]] bool IsAllowed(std::string_view host) const;
  [[nodiscard]] bool IsOurs(std::string_view host, std::string_view local_address) const;

  std::string bound_host_;
  std::vector<std::string> allowed_;
};

}  // namespace dhpmap::http

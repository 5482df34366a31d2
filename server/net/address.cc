// SPDX-License-Identifier: BSD-3-Clause
#include "server/net/address.h"

#include <charconv>
#include <cstddef>

namespace dhpmap::net {

Result<Address> SplitAddress(const std::string& address) {
  const std::size_t colon = address.rfind(':');
  Address parts;
  const char* begin = address.data() + (colon == std::string::npos ? address.size() : colon + 1);
  const char* end = address.data() + address.size();
  const auto [stop, error] = std::from_chars(begin, end, parts.port);
  if (colon == std::string::npos || error != std::errc() || stop != end) {
    return InvalidArgument("'" + address + "' is no address: expected host:port");
  }
  parts.host = address.substr(0, colon);
  if (parts.host.size() > 1 && parts.host.front() == '[' && parts.host.back() == ']') {
    parts.host = parts.host.substr(1, parts.host.size() - 2);
  }
  return parts;
}

}  // namespace dhpmap::net

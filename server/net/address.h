// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>

#include "mapping/base/result.h"

namespace dhpmap::net {

struct Address {
  std::string host;  ///< an IPv6 address without its brackets
  std::uint16_t port = 0;
};

/// Splits "host:port" or "[v6]:port"; INVALID_ARGUMENT for any other form. Does not resolve the host.
Result<Address> SplitAddress(const std::string& address);

}  // namespace dhpmap::net

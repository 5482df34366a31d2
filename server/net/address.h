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

/// Of "host:port" and "[v6]:port"; INVALID_ARGUMENT for anything else. Whether there is such a host is not asked.
Result<Address> SplitAddress(const std::string& address);

}  // namespace dhpmap::net

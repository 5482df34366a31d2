// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "server/net/descriptor.h"

namespace dhpmap::net {

/// Two connected sockets. Both have abstract names that end with the number, so that either end identifies the
/// connection. The names are random: local users can read existing ones (/proc/net/unix), but cannot reserve future
/// ones.
struct NamedPair {
  Descriptor ours, theirs;
  std::string our_name;
};

/// Nothing if descriptors have run out, or another process has taken the names.
std::optional<NamedPair> MakeNamedPair(std::uint64_t number);

/// The number of the pair from the name of an end, as gRPC reports it ("unix-abstract:..."); nothing for other names.
std::optional<std::uint64_t> NumberOfPair(std::string_view name);

}  // namespace dhpmap::net

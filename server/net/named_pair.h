// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "server/net/descriptor.h"

namespace dhpmap::net {

/// Two sockets that are connected to each other. Both have abstract names that end with the number, so that whoever has
/// one can tell which connection it is. Each name is random: every user of the machine may read those that there are
/// (/proc/net/unix), but takes none that there will be.
struct NamedPair {
  Descriptor ours, theirs;
  std::string our_name;
};

/// Nothing if there are no descriptors left, or another process has taken the names.
std::optional<NamedPair> MakeNamedPair(std::uint64_t number);

/// The number of the pair whose end has this name, as gRPC tells it ("unix-abstract:..."), if it is one of ours.
std::optional<std::uint64_t> NumberOfPair(std::string_view name);

}  // namespace dhpmap::net

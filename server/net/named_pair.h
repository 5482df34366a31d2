// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "server/net/descriptor.h"

namespace dhpmap::net {

/// Two sockets that are connected to each other. Both have abstract names of this process that end with the number, so
/// that whoever has one can tell which connection it is.
struct NamedPair {
  Descriptor ours, theirs;
};

/// Nothing if there are no descriptors left, or another process has taken the names.
std::optional<NamedPair> MakeNamedPair(std::uint64_t number);

/// The number of the pair whose end has this name, as gRPC tells it ("unix-abstract:..."), if it is one of ours.
std::optional<std::uint64_t> NumberOfPair(std::string_view name);

}  // namespace dhpmap::net

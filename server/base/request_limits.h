// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <google/protobuf/descriptor.h>

#include <cstddef>

#include "mapping/base/status.h"
#include "server/base/byte_budget.h"

namespace dhpmap {

// How large requests may be, at whichever door.

/// Of one request of this method, where the door takes `most_bytes`: all of it if there are lists in it or it is one of
/// a stream, 1 MiB if it is names and numbers.
std::size_t MostRequestBytes(const google::protobuf::MethodDescriptor& method, std::size_t most_bytes);
/// As a message with its bytes: without a bound of its own if there are lists in it, else 4 MiB. A watch keeps its
/// request for hours: a few must not take what there is for all.
std::size_t MostMessageBytes(const google::protobuf::MethodDescriptor& method);
/// RESOURCE_EXHAUSTED, reason BODY_TOO_LARGE.
Status RequestTooLarge(std::size_t num_bytes, std::size_t most_bytes);
Status MessageTooLarge(std::size_t num_bytes, std::size_t most_bytes);

/// Whether a request is counted by its bytes alone, though lists of messages take several times that.
bool IsSmallRequest(std::size_t num_bytes, std::size_t message_bytes, const ByteBudget& budget);
/// RESOURCE_EXHAUSTED, reason BODY_TOO_LARGE, if there never are so many `bytes` for what a request takes.
Status CheckEverFits(std::size_t bytes, const ByteBudget& budget);

}  // namespace dhpmap

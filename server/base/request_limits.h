// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <google/protobuf/descriptor.h>

#include <cstddef>

#include "mapping/base/status.h"
#include "server/base/byte_budget.h"

namespace dhpmap {

// Size limits of requests at both doors.

/// Limit of one request of this method at a door with the limit `most_bytes`: that limit for requests with lists and
/// for streams, else 1 MiB.
std::size_t MostRequestBytes(const google::protobuf::MethodDescriptor& method, std::size_t most_bytes);
/// Limit of the parsed message: none for requests with lists, else 4 MiB. A watch keeps its request for hours, so a few
/// must not use up the budget.
std::size_t MostMessageBytes(const google::protobuf::MethodDescriptor& method);
/// RESOURCE_EXHAUSTED, reason BODY_TOO_LARGE.
Status RequestTooLarge(std::size_t num_bytes, std::size_t most_bytes);
Status MessageTooLarge(std::size_t num_bytes, std::size_t most_bytes);

/// Whether a request is so small that only its bytes count, although parsed lists of messages take several times that.
bool IsSmallRequest(std::size_t num_bytes, std::size_t message_bytes, const ByteBudget& budget);
/// RESOURCE_EXHAUSTED, reason BODY_TOO_LARGE, if a request of `bytes` can never fit into the budget.
Status CheckEverFits(std::size_t bytes, const ByteBudget& budget);

}  // namespace dhpmap

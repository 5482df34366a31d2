// SPDX-License-Identifier: BSD-3-Clause
#include "server/base/request_limits.h"

#include <algorithm>
#include <array>
#include <limits>
#include <string>
#include <string_view>

namespace dhpmap {
namespace {

/// Requests that may use the door's whole limit: those with lists of points, rays, bodies, edits or classes. The others
/// contain names and numbers.
constexpr std::array<std::string_view, 8> kLargeRequests = {"ApplyEdits",      "CastRays",  "CheckCollisions",
                                                            "CheckTrajectory", "CreateMap", "QueryDistances",
                                                            "QueryPoints",     "UpdateMap"};
constexpr std::size_t kMostOfTheRest_bytes = 1u << 20, kMostOfTheRestAsMessage_bytes = 4u << 20;

/// A request counts by its bytes alone, unless its message exceeds this many times the free bytes.
constexpr std::size_t kMostSmall = 8;

bool MayBeLarge(const google::protobuf::MethodDescriptor& method) {
  return method.client_streaming() ||
         std::find(kLargeRequests.begin(), kLargeRequests.end(), method.name()) != kLargeRequests.end();
}

}  // namespace

std::size_t MostRequestBytes(const google::protobuf::MethodDescriptor& method, std::size_t most_bytes) {
  return MayBeLarge(method) ? most_bytes : std::min(most_bytes, kMostOfTheRest_bytes);
}

std::size_t MostMessageBytes(const google::protobuf::MethodDescriptor& method) {
  return MayBeLarge(method) ? std::numeric_limits<std::size_t>::max() : kMostOfTheRestAsMessage_bytes;
}

Status MessageTooLarge(std::size_t num_bytes, std::size_t most_bytes) {
  return ResourceExhausted("as a message the request would take " + std::to_string(num_bytes) + " bytes, more than " +
                           std::to_string(most_bytes))
      .WithReason("BODY_TOO_LARGE");
}

Status RequestTooLarge(std::size_t num_bytes, std::size_t most_bytes) {
  return ResourceExhausted("the request has " + std::to_string(num_bytes) + " bytes, more than " +
                           std::to_string(most_bytes))
      .WithReason("BODY_TOO_LARGE");
}

bool IsSmallRequest(std::size_t num_bytes, std::size_t message_bytes, const ByteBudget& budget) {
  return num_bytes <= budget.free_bytes() && message_bytes <= kMostSmall * budget.free_bytes();
}

Status CheckEverFits(std::size_t bytes, const ByteBudget& budget) {
  if (bytes <= budget.limit_bytes()) return Status::Ok();
  return ResourceExhausted("as a message the request would take " + std::to_string(bytes >> 20) +
                           " MiB or more, which is more than there is for all calls")
      .WithReason("BODY_TOO_LARGE");
}

}  // namespace dhpmap

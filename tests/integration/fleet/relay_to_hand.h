// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>

#include <memory>
#include <string>

#include "proto/types/metadata_keys.h"
#include "tests/integration/fleet/calls_by_hand.h"
#include "tests/integration/fleet/fleet_of_two.h"

namespace dhpmap::testing {

/// A server that relays to an owner which the test plays. What is on its way has a budget that the test chooses.
class RelayToHand : public ::testing::Test {
 protected:
  static constexpr char kUnary[] = "/dhpmap.v1.QueryService/QueryPoints";
  static constexpr char kAnswers[] = "/dhpmap.v1.QueryService/QueryDistanceGrid";  // a stream of answers
  static constexpr char kBoth[] = "/dhpmap.v1.QueryService/StreamQueries";
  static constexpr char kFrames[] = "/dhpmap.v1.MappingService/IntegrateFrames";
  static constexpr std::size_t kLarge_bytes = 200u << 10;  // larger than what connections hold

  void Open(std::size_t budget_bytes = 256u << 20) {
    budget = std::make_shared<ByteBudget>(budget_bytes, 1u << 10);
    relay = std::make_unique<FleetMember>(room, GrpcOptions{.inflight = budget});
    room->AddMap("room", room->Join(owner.address()));
    (void)relay->fleet.OwnerOf("room");
  }
  static std::string Request() {
    v1::QueryPointsRequest request;
    request.set_map("maps/room");
    return request.SerializeAsString();
  }
  /// The first message of a stream; padded to a size by bytes that no server reads.
  static std::string FirstOfStream(std::size_t num_bytes = 0) {
    v1::StreamQueriesRequest request;
    request.mutable_query_points()->set_map("maps/room");
    request.GetReflection()->MutableUnknownFields(&request)->AddLengthDelimited(1000, std::string(num_bytes, 'x'));
    return request.SerializeAsString();
  }
  std::unique_ptr<CallByHand> Call(const std::string& path, const CallByHand::Fill& fill = {}) {
    return std::make_unique<CallByHand>(relay->server.channel(), path, fill);
  }
  static void NameRoom(grpc::ClientContext& context) { context.AddMetadata(kRouteMapKey, "room"); }
  bool IsAllGivenBack() {
    return Eventually([&] { return budget->used_bytes() == 0; });
  }

  const std::shared_ptr<FakeFleetRoom> room = std::make_shared<FakeFleetRoom>();
  OwnerByHand owner;
  std::shared_ptr<ByteBudget> budget;
  std::unique_ptr<FleetMember> relay;  // first to go
};

}  // namespace dhpmap::testing

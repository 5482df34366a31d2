// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <grpcpp/grpcpp.h>

#include <memory>
#include <string>

#include "server/auth/fleet_key.h"
#include "server/auth/gate.h"
#include "storage/store.h"
#include "tests/integration/test_server.h"
#include "tests/support/fake_fleet.h"

namespace dhpmap::testing {

inline constexpr char kFleetSecret[] = "0123456789abcdef0123456789abcdef-fleet";

/// A server of a fake fleet with its own store, so that answers about another server's map can only come from that
/// server.
struct FleetMember {
  explicit FleetMember(const std::shared_ptr<FakeFleetRoom>& room, GrpcOptions options = {}, GrpcObserver observer = {})
      : fleet(room), server(*store, {}, WithFleet(std::move(options), fleet), std::move(observer)) {
    room->SetAddress(fleet.me(), address());
  }
  [[nodiscard]] std::string address() { return "127.0.0.1:" + std::to_string(server.grpc().port()); }

  static GrpcOptions WithFleet(GrpcOptions options, FakeFleet& fleet) {
    options.fleet = &fleet;
    return options;
  }

  FakeFleet fleet;
  std::unique_ptr<MapStore> store = MakeMemoryStore();
  TestServer server;
};

/// The owner of maps/room, which has a mapped scene, and another server of the same fleet. Without keys.
class FleetOfTwo : public ::testing::Test {
 protected:
  void SetUp() override {
    ASSERT_OK(owner.server.Call(&MapStub::CreateMap, CreateRequest("room")));
    ASSERT_OK(Feed(owner.server, "room", 0, 3));
    room->AddMap("room", owner.fleet.me());
  }

  const std::shared_ptr<FakeFleetRoom> room = std::make_shared<FakeFleetRoom>();
  std::atomic<int> num_relayed = 0;
  GrpcObserver counting{.on_relayed = [this](std::string_view, StatusCode) { ++num_relayed; }};
  FleetMember owner{room};
  FleetMember other{room, {}, counting};
};

/// An initial metadata value of an answer.
inline std::string HeadOf(const grpc::ClientContext& context, const char* key) {
  const auto& head = context.GetServerInitialMetadata();
  const auto found = head.find(key);
  return found != head.end() ? std::string(found->second.data(), found->second.size()) : std::string();
}

}  // namespace dhpmap::testing

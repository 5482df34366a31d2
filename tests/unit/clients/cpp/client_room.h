// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>

#include <memory>
#include <string>

#include "dhpmap/client.h"
#include "tests/integration/test_server.h"

namespace dhpmap::testing {

inline client::Client ConnectTo(const std::string& address, const client::ConnectOptions& options = {}) {
  client::Result<client::Client> connected = client::Client::Connect(address, options);
  EXPECT_OK(connected);
  return *std::move(connected);
}

inline std::string AddressOf(TestServer& server) { return "127.0.0.1:" + std::to_string(server.grpc().port()); }

/// A server with "maps/room", a mapped TestScene (ball 1 and box 2 on floor 3), made anew for each test.
class ClientRoom : public ::testing::Test {
 protected:
  /// The one object of a class of TestScene.
  client::Object ObjectOf(int class_id) {
    const auto list = room.Objects();
    EXPECT_OK(list);
    for (const client::Object& object : list->objects) {
      if (object.class_id == class_id) return object;
    }
    ADD_FAILURE() << "no object of class " << class_id;
    return {};
  }

  std::unique_ptr<MapStore> store = MakeMemoryStore();
  TestServer server{*store};
  client::Client connection = ConnectTo(AddressOf(server), {.author = "anna"});
  client::Map room = MappedRoom();

 private:
  client::Map MappedRoom() {
    EXPECT_OK(server.Call(&MapStub::CreateMap, CreateRequest("room")));
    EXPECT_OK(testing::Feed(server, "room", 0, 12));
    EXPECT_OK(server.Call(&MappingStub::FinishMapping, "maps/room"));
    client::Result<client::Map> opened = connection.OpenMap("room");
    EXPECT_OK(opened);
    return *std::move(opened);
  }
};

}  // namespace dhpmap::testing

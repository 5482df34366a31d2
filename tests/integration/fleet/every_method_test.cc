// SPDX-License-Identifier: BSD-3-Clause
// Covers all rpcs, so that a new one cannot be forgotten. Calls about a map are relayed to its owner, over both doors;
// the table below lists all other calls.
#include <google/protobuf/descriptor.h>
#include <google/protobuf/dynamic_message.h>
#include <grpcpp/generic/generic_stub.h>
#include <gtest/gtest.h>

#include <regex>
#include <set>
#include <string>

#include "server/gateway/gateway.h"
#include "server/gateway/http_rule_router.h"
#include "tests/integration/auth/locked_server.h"
#include "tests/integration/fleet/fleet_of_two.h"

namespace dhpmap::testing {
namespace {

using google::protobuf::Descriptor;
using google::protobuf::FieldDescriptor;
using google::protobuf::Message;

/// Methods that every server answers itself, and why.
const std::map<std::string, std::string>& AnsweredHere() {
  static const std::map<std::string, std::string> here = {
      {"/dhpmap.v1.MapService/CreateMap", "makes the map here"},
      {"/dhpmap.v1.MapService/ImportMap", "makes the map here"},
      {"/dhpmap.v1.MapService/ListMaps", "is about all maps"},
      {"/dhpmap.v1.MapService/BackupMaps", "is about all maps"},
      {"/dhpmap.v1.WatchService/WatchMap", "reads what the owner has stored"},
      {"/dhpmap.v1.AuthService/WhoAmI", "is about the caller"},
      {"/dhpmap.v1.ServerService/GetServerStatus", "is about this server"},
      {"/dhpmap.v1.FleetService/GetFleet", "is about all servers"},
      {"/dhpmap.v1.FleetService/FinishUpgrade", "is about all servers"},
      {"/dhpmap.v1.FleetService/ListMapOwners", "is about all maps"},
  };
  return here;
}

/// Sets the field that names the map; of a oneof, the first branch.
void NameRoom(const auth::CallNeeds& needs, Message& request) {
  for (const auto& [meaning, path] : needs.fields) {
    if (meaning != v1::Access::MAP) continue;
    Message* holder = &request;
    for (std::size_t i = 0; i + 1 < path.size(); ++i) holder = holder->GetReflection()->MutableMessage(holder, path[i]);
    holder->GetReflection()->SetString(holder, path.back(), "maps/room");
    return;
  }
}

/// Sends one message to a method of any kind and reads all answers.
grpc::Status CallWith(const std::shared_ptr<grpc::Channel>& channel, const std::string& path, const Message& request) {
  grpc::ClientContext context;
  grpc::CompletionQueue queue;
  grpc::GenericStub stub(channel);
  const auto stream = stub.PrepareCall(&context, path, &queue);
  const auto wait = [&queue] {
    void* tag = nullptr;
    bool ok = false;
    return queue.Next(&tag, &ok) && ok;
  };
  stream->StartCall(nullptr);
  wait();
  const grpc::Slice bytes(request.SerializeAsString());
  stream->WriteLast(grpc::ByteBuffer(&bytes, 1), grpc::WriteOptions(), nullptr);
  wait();
  grpc::ByteBuffer answer;
  for (stream->Read(&answer, nullptr); wait(); stream->Read(&answer, nullptr)) answer.Clear();
  grpc::Status status;
  stream->Finish(&status, nullptr);
  wait();
  return status;
}

class EveryMethod : public FleetOfTwo {
 protected:
  void SetUp() override {
    FleetOfTwo::SetUp();
    (void)other.fleet.OwnerOf("room");
  }
  const auth::CallTable table = *auth::CallTable::OfLinkedServices();
};

TEST_F(EveryMethod, AboutAMapIsRelayedToItsOwner) {
  google::protobuf::DynamicMessageFactory messages;
  std::set<std::string> met;
  for (const auto& [path, needs] : table.calls()) {
    if (!path.starts_with("/dhpmap.v1.") || path.ends_with("/DeleteMap")) continue;
    const std::string method = std::regex_replace(path.substr(1), std::regex("/"), ".");
    const Descriptor* type = google::protobuf::DescriptorPool::generated_pool()->FindMethodByName(method)->input_type();
    const std::unique_ptr<Message> request(messages.GetPrototype(type)->New());
    NameRoom(needs, *request);
    if (AnsweredHere().contains(path)) {
      met.insert(path);
      if (path.ends_with("/WatchMap")) continue;  // does not end
    }
    const int before = num_relayed;
    const grpc::Status status = CallWith(other.server.channel(), path, *request);
    EXPECT_EQ(num_relayed - before, AnsweredHere().contains(path) ? 0 : 1) << path;
    EXPECT_NE(ReasonOf(status), "MAP_NOT_FOUND") << path << ": " << status.error_message();
    EXPECT_NE(status.error_code(), grpc::UNIMPLEMENTED) << path;
  }
  EXPECT_EQ(met.size(), AnsweredHere().size()) << "the table names rpcs that there are not";
  EXPECT_OK(other.server.Call(&MapStub::DeleteMap, "maps/room"));  // must be last
  EXPECT_EQ(owner.server.Call(&MapStub::GetMap, "maps/room").code(), grpc::NOT_FOUND);
}

TEST_F(EveryMethod, AboutAMapIsRelayedOverRestToo) {
  auto gateway = Gateway::Start({.address = "127.0.0.1:0"}, other.server.grpc().InProcessChannel(), {});
  ASSERT_OK(gateway);
  const auto router = gateway::HttpRuleRouter::FromLinkedServices();
  ASSERT_TRUE(router.ok());
  for (const gateway::Route& route : router->routes()) {
    if (AnsweredHere().contains(route.rpc_path) || route.rpc_path.ends_with("/DeleteMap")) continue;
    if (!route.path.text().starts_with("/v1/{")) continue;  // only the body names the map
    std::string target =
        std::regex_replace(route.path.text(), std::regex("\\{[a-z_.]+=maps/\\*/submaps/\\*\\}"), "maps/room/submaps/1");
    target = std::regex_replace(target, std::regex("\\{[a-z_.]+=maps/\\*\\}"), "maps/room");
    ASSERT_EQ(target.find('{'), std::string::npos) << target;
    http::HttpClient client((*gateway)->port());
    const std::string body = route.http_method == "GET" || route.http_method == "DELETE" ? "" : "{}";
    const int before = num_relayed;
    const http::HttpAnswer answer = client.Ask(route.http_method, target, body);
    // The call of a file may end after the file has arrived.
    EXPECT_TRUE(Eventually([&] { return num_relayed > before; })) << route.http_method << " " << target;
    EXPECT_EQ(answer.body.find("MAP_NOT_FOUND"), std::string::npos) << target << ": " << answer.body;
  }
  (*gateway)->Shutdown(1);
}

}  // namespace
}  // namespace dhpmap::testing

// SPDX-License-Identifier: BSD-3-Clause
// Servers with keys: on whose behalf calls are relayed, and clients that pretend to be servers.
#include <gtest/gtest.h>

#include <string>

#include "dhpmap/v1/auth_service.grpc.pb.h"
#include "proto/types/metadata_keys.h"
#include "server/auth/keys/key_book.h"
#include "server/auth/keys/key_file.h"
#include "tests/integration/auth/locked_server.h"
#include "tests/integration/fleet/fleet_of_two.h"

namespace dhpmap::testing {
namespace {

/// Two servers with the same keys, and maps/room at the owner.
class FleetWithKeys : public ::testing::Test {
 protected:
  std::shared_ptr<auth::Gate> MakeGate(const std::string& secret) {
    auto gate = *auth::Gate::WithKeys({.key_file = file_, .audit_file = file_ + ".audit", .look_s = 0});
    if (!secret.empty()) gate->TakeFleetKey(*auth::FleetKey::Make(secret, "a test"));
    return gate;
  }
  std::string MakeKey(const auth::NewKey& key) {
    std::string text;
    EXPECT_OK(auth::ChangeKeyFile(file_, [&](std::vector<auth::KeyRecord>& records) -> Status {
      DHPMAP_ASSIGN_OR_RETURN(const auth::ShownKey shown, AddKey(key, 0, auth::SystemRandomness(), records));
      text = shown.text;
      return Status::Ok();
    }));
    return text;
  }
  void SetUp() override {
    grpc::ClientContext context;
    LockedServer::Show(admin, context);
    v1::CreateMapResponse made;
    ASSERT_OK(owner.server.maps->CreateMap(&context, CreateRequest("room"), &made));
    room->AddMap("room", owner.fleet.me());
  }
  grpc::Status GetRoom(TestServer& server, const std::string& key,
                       const std::map<std::string, std::string>& metadata = {}) {
    grpc::ClientContext context;
    if (!key.empty()) LockedServer::Show(key, context);
    for (const auto& [name, value] : metadata) context.AddMetadata(name, value);
    v1::GetMapRequest request;
    request.set_name("maps/room");
    v1::GetMapResponse response;
    return server.maps->GetMap(&context, request, &response);
  }
  grpc::Status RenameRoom(TestServer& server, const std::string& key) {
    grpc::ClientContext context;
    LockedServer::Show(key, context);
    v1::UpdateMapRequest request;
    request.mutable_map()->set_name("maps/room");
    request.mutable_map()->set_display_name("Room");
    request.mutable_update_mask()->add_paths("display_name");
    v1::UpdateMapResponse response;
    return server.maps->UpdateMap(&context, request, &response);
  }

  TempDir folder_;
  const std::string file_ = (folder_.path() / "keys").string();
  const std::string admin = MakeKey({.name = "ann", .role = auth::Role::kAdmin, .sessions = {"*"}});
  const std::string viewer = MakeKey({.name = "vic", .role = auth::Role::kViewer});
  const std::string stranger = MakeKey({.name = "sam", .role = auth::Role::kEditor, .maps = {"hall*"}});
  const std::shared_ptr<FakeFleetRoom> room = std::make_shared<FakeFleetRoom>();
  const std::shared_ptr<auth::Gate> owner_gate = MakeGate(kFleetSecret), other_gate = MakeGate(kFleetSecret);
  FleetMember owner{room, {.gate = owner_gate}};
  FleetMember other{room, {.gate = other_gate}};
};

const std::map<std::string, std::string>& AsAdmin(const std::string& secret) {
  static std::map<std::string, std::string> metadata;
  metadata = {{kRelayedKey, kPassedOn},
              {auth::kFleetKeyKey, secret},
              {auth::kPrincipalKey, auth::TextOf({.name = "mallory",
                                                  .role = auth::Role::kAdmin,
                                                  .maps = auth::NamePatterns::All(),
                                                  .sessions = auth::NamePatterns::All()})}};
  return metadata;
}

TEST_F(FleetWithKeys, ARelayedCallIsMadeForTheOriginalCaller) {
  EXPECT_OK(GetRoom(other.server, viewer));
  EXPECT_OK(RenameRoom(other.server, admin));
  EXPECT_EQ(RenameRoom(other.server, viewer).error_code(), grpc::PERMISSION_DENIED);
  EXPECT_EQ(GetRoom(other.server, "").error_code(), grpc::UNAUTHENTICATED);
}

TEST_F(FleetWithKeys, MapPatternsOfKeysApplyThroughAnotherServer) {
  for (FleetMember* asked : {&owner, &other}) {
    const grpc::Status status = GetRoom(asked->server, stranger);
    EXPECT_EQ(status.error_code(), grpc::PERMISSION_DENIED);
    EXPECT_EQ(ReasonOf(status), "MAP_NOT_ALLOWED");
  }
  EXPECT_EQ(other.fleet.num_asked(), 0) << "who may not ask learns nothing, and asks nobody";
}

TEST_F(FleetWithKeys, AnEditIsLoggedUnderItsAuthorAtTheOwner) {
  ASSERT_OK(RenameRoom(other.server, admin));
  grpc::ClientContext context;
  LockedServer::Show(admin, context);
  v1::ListEditsRequest request;
  request.set_parent("maps/room");
  v1::ListEditsResponse response;
  v1::EditService::Stub edits(owner.server.channel());
  ASSERT_OK(edits.ListEdits(&context, request, &response));
  ASSERT_EQ(response.edits_size(), 1);
  EXPECT_EQ(response.edits(0).author(), "ann");
}

TEST_F(FleetWithKeys, AServerWithTheSecretMayActForAPrincipal) {
  EXPECT_OK(GetRoom(owner.server, "", AsAdmin(kFleetSecret)));  // shows that the refusals below are due to the secret
}

TEST_F(FleetWithKeys, AClientThatPretendsToBeAServerIsRefused) {
  for (const std::string& secret : {std::string("x"), std::string(kFleetSecret) + "x", std::string()}) {
    const grpc::Status status = GetRoom(owner.server, "", AsAdmin(secret));
    EXPECT_EQ(status.error_code(), grpc::UNAUTHENTICATED) << secret;
  }
  // A valid key of a client does not make it a server.
  EXPECT_EQ(GetRoom(owner.server, viewer, AsAdmin("wrong")).error_code(), grpc::UNAUTHENTICATED);
  EXPECT_EQ(GetRoom(other.server, viewer, {{kRelayedKey, kPassedOn}}).error_code(), grpc::UNAUTHENTICATED);
}

TEST_F(FleetWithKeys, APrincipalWithoutASecretIsIgnored) {
  auto metadata = AsAdmin("");
  metadata.erase(auth::kFleetKeyKey);
  metadata.erase(kRelayedKey);
  EXPECT_EQ(GetRoom(owner.server, "", metadata).error_code(), grpc::UNAUTHENTICATED);
  grpc::ClientContext context;
  LockedServer::Show(viewer, context);
  for (const auto& [name, value] : metadata) context.AddMetadata(name, value);
  v1::WhoAmIResponse who;
  v1::AuthService::Stub auth(owner.server.channel());
  ASSERT_OK(auth.WhoAmI(&context, {}, &who));
  EXPECT_EQ(who.principal(), "vic");
}

TEST_F(FleetWithKeys, AMalformedPrincipalIsRefused) {
  auto metadata = AsAdmin(kFleetSecret);
  for (const char* text : {"", "{}", "[1]", R"({"name":"a b","key":"","role":"admin","maps":["*"],"sessions":[]})",
                           R"({"name":"m","key":"","role":"god","maps":["*"],"sessions":[],"expires_s":1})"}) {
    metadata[auth::kPrincipalKey] = text;
    EXPECT_FALSE(GetRoom(owner.server, "", metadata).ok()) << text;
  }
}

TEST_F(FleetWithKeys, WrongSecretsCountAsWrongKeys) {
  grpc::Status last;
  for (int i = 0; i < 25; ++i) last = GetRoom(owner.server, "", AsAdmin("wrong"));
  EXPECT_EQ(last.error_code(), grpc::RESOURCE_EXHAUSTED);
}

TEST_F(FleetWithKeys, AServerWithoutTheSecretSendsClientsToTheOwner) {
  FleetMember third{room, {.gate = MakeGate("")}};
  const grpc::Status status = GetRoom(third.server, viewer);
  EXPECT_EQ(ReasonOf(status), "NOT_OWNER");
}

TEST_F(FleetWithKeys, AServerWithAnotherSecretCannotRelay) {
  FleetMember third{room, {.gate = MakeGate(std::string(kFleetSecret) + "-old")}};
  const grpc::Status status = GetRoom(third.server, viewer);
  EXPECT_EQ(status.error_code(), grpc::UNAVAILABLE) << "its own key is a good one";
  EXPECT_EQ(ReasonOf(status), "OWNER_UNREACHABLE");
}

}  // namespace
}  // namespace dhpmap::testing

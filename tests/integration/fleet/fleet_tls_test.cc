// SPDX-License-Identifier: BSD-3-Clause
// Servers of a fleet that reach each other over TLS.
#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "server/auth/keys/key_book.h"
#include "server/auth/keys/key_file.h"
#include "server/net/tls_context.h"
#include "tests/integration/fleet/fleet_of_two.h"
#include "tests/unit/server/net/test_certificates.h"

namespace dhpmap::testing {
namespace {

namespace fs = std::filesystem;

/// An owner of maps/room and servers that relay to it, with certificates. Clients come through the process.
class FleetWithTls : public ::testing::Test {
 protected:
  /// What a server is given: its certificate, who signs those of the others, and of whom it wants one.
  struct Wish {
    CertificateFiles own;
    std::string peers_ca;
    net::ClientAuth client_auth = net::ClientAuth::kRequired;
    std::shared_ptr<auth::Gate> gate = auth::Gate::Open();
  };
  std::unique_ptr<FleetMember> Start(const Wish& wish) {
    auto tls = net::TlsContext::Load(
        {.cert = wish.own.cert, .key = wish.own.key, .client_ca = ca.cert, .client_auth = wish.client_auth});
    EXPECT_OK(tls);
    return std::make_unique<FleetMember>(
        room,
        GrpcOptions{.tls = *tls,
                    .gate = wish.gate,
                    .peer_tls = {.is_on = true, .ca = wish.peers_ca, .cert = wish.own.cert, .key = wish.own.key}});
  }
  void StartOwner(const Wish& wish) {
    owner = Start(wish);
    room->AddMap("room", owner->fleet.me());
    ASSERT_OK(MapStub(owner->server.grpc().InProcessChannel()).CreateMap(&making_, CreateRequest("room"), &made_));
  }
  grpc::Status GetRoom(FleetMember& asked) {
    return Client(asked.server.grpc().InProcessChannel()).Call(&MapStub::GetMap, "maps/room").status();
  }
  CertificateFiles Signed(const std::string& name, const std::string& alt_names = "DNS:localhost,IP:127.0.0.1",
                          bool is_expired = false) {
    return MakeCertificate(folder.path(), name,
                           {.common_name = name, .alt_names = alt_names, .is_expired = is_expired, .signed_by = &ca});
  }
  /// OWNER_UNREACHABLE for the client, and a line in the log that says `why`.
  void ExpectRefused(FleetMember& asked, const std::string& why) {
    ::testing::internal::CaptureStderr();
    const grpc::Status status = GetRoom(asked);
    const std::string log = ::testing::internal::GetCapturedStderr();
    EXPECT_EQ(status.error_code(), grpc::UNAVAILABLE);
    EXPECT_EQ(ReasonOf(status), "OWNER_UNREACHABLE");
    EXPECT_NE(log.find(owner->address()), std::string::npos) << log;
    EXPECT_NE(log.find(why), std::string::npos) << log;
  }

  TempDir folder;
  const CertificateFiles ca = MakeCertificate(folder.path(), "ca");
  const CertificateFiles a = Signed("a"), b = Signed("b");
  const std::shared_ptr<FakeFleetRoom> room = std::make_shared<FakeFleetRoom>();
  std::unique_ptr<FleetMember> owner;

 private:
  grpc::ClientContext making_;
  v1::CreateMapResponse made_;
};

TEST_F(FleetWithTls, ServersWithCertificatesOfOneAuthorityReachEachOther) {
  StartOwner({.own = a, .peers_ca = ca.cert});
  const auto other = Start({.own = b, .peers_ca = ca.cert});
  EXPECT_OK(GetRoom(*other));
}

TEST_F(FleetWithTls, AnOwnerOfAnotherAuthorityIsRefused) {
  const CertificateFiles foreign = MakeCertificate(folder.path(), "foreign");
  StartOwner({.own = foreign, .peers_ca = ca.cert});
  const auto other = Start({.own = b, .peers_ca = ca.cert});
  ExpectRefused(*other, "certificate verify failed");
}

TEST_F(FleetWithTls, AnOwnerWhoseCertificateNamesAnotherAddressIsRefused) {
  StartOwner({.own = Signed("elsewhere", "DNS:elsewhere.example"), .peers_ca = ca.cert});
  const auto other = Start({.own = b, .peers_ca = ca.cert});
  ExpectRefused(*other, "is not in peer certificate");
}

TEST_F(FleetWithTls, AServerWhoseCertificateTheOwnerDoesNotTrustIsRefused) {
  StartOwner({.own = a, .peers_ca = ca.cert});
  const auto other = Start({.own = MakeCertificate(folder.path(), "foreign"), .peers_ca = ca.cert});
  ExpectRefused(*other, "cannot be reached");
}

TEST_F(FleetWithTls, AMissingFileOfAuthoritiesDoesNotMeanThoseOfTheSystem) {
  StartOwner({.own = a, .peers_ca = ca.cert});
  const std::string missing = (folder.path() / "missing.crt").string();
  const auto other = Start({.own = b, .peers_ca = missing});
  ExpectRefused(*other, missing);
}

TEST_F(FleetWithTls, ARenewedCertificateIsShownToTheOwnerWithoutARestart) {
  StartOwner({.own = a, .peers_ca = ca.cert});
  const CertificateFiles foreign = MakeCertificate(folder.path(), "foreign");
  const auto other = Start({.own = foreign, .peers_ca = ca.cert});
  EXPECT_FALSE(GetRoom(*other).ok());
  fs::copy_file(b.key, foreign.key, fs::copy_options::overwrite_existing);
  fs::copy_file(b.cert, foreign.cert, fs::copy_options::overwrite_existing);
  EXPECT_OK(GetRoom(*other));
}

TEST_F(FleetWithTls, TheFleetKeyIsAskedForOverTlsToo) {
  const std::string keys = (folder.path() / "keys").string();
  std::string admin;
  ASSERT_OK(auth::ChangeKeyFile(keys, [&](std::vector<auth::KeyRecord>& records) -> Status {
    DHPMAP_ASSIGN_OR_RETURN(const auth::ShownKey shown,
                            AddKey({.name = "ann", .role = auth::Role::kAdmin}, 0, auth::SystemRandomness(), records));
    admin = shown.text;
    return Status::Ok();
  }));
  const auto gate = [&](const std::string& secret) {
    std::shared_ptr<auth::Gate> made = *auth::Gate::WithKeys({.key_file = keys, .look_s = 0});
    made->TakeFleetKey(*auth::FleetKey::Make(secret, "a test"));
    return made;
  };
  owner = Start({.own = a, .peers_ca = ca.cert, .gate = gate(kFleetSecret)});
  room->AddMap("room", owner->fleet.me());
  const auto as_admin = [&](FleetMember& asked, const auto& call) {
    grpc::ClientContext context;
    context.AddMetadata("authorization", "Bearer " + admin);
    MapStub maps(asked.server.grpc().InProcessChannel());
    return call(maps, context);
  };
  ASSERT_OK(as_admin(*owner, [](MapStub& maps, grpc::ClientContext& context) {
    v1::CreateMapResponse made;
    return maps.CreateMap(&context, CreateRequest("room"), &made);
  }));
  const auto get = [](MapStub& maps, grpc::ClientContext& context) {
    v1::GetMapResponse response;
    return maps.GetMap(&context, About<v1::GetMapRequest>("maps/room"), &response);
  };
  EXPECT_OK(as_admin(*Start({.own = b, .peers_ca = ca.cert, .gate = gate(kFleetSecret)}), get));
  const std::string wrong = std::string(kFleetSecret) + "-old";
  EXPECT_EQ(ReasonOf(as_admin(*Start({.own = b, .peers_ca = ca.cert, .gate = gate(wrong)}), get)), "OWNER_UNREACHABLE");
}

}  // namespace
}  // namespace dhpmap::testing

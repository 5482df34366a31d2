// SPDX-License-Identifier: BSD-3-Clause
#include "server/net/door.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>

#include <algorithm>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "server/net/frame_limits.h"
#include "tests/support/scenes.h"
#include "tests/unit/server/http/http_client.h"
#include "tests/unit/server/net/door_fixture.h"
#include "tests/unit/server/net/http2_bytes.h"

namespace dhpmap::net {
namespace {

using namespace frame_flags;
using http::HttpClient;
using testing::FrameBytes;

const std::string kPreface(kHttp2Preface);

/// The bytes begin with the HTTP/2 preface, as on every connection.
std::string SentBy(const Behind::Inner& inner, std::size_t num_bytes) {
  EXPECT_EQ(inner.Read(kPreface.size()), kPreface);
  return inner.Read(num_bytes);
}

TEST_F(DoorTest, RelaysBytesBothWaysAndEndsWithTheServer) {
  OpenDoor({});
  HttpClient client(door_->port());
  const std::string ping = FrameBytes(FrameType::kPing, 0, 0, "12345678");
  ASSERT_TRUE(client.SendRaw(kPreface + ping));
  auto inner = behind_.Next();
  ASSERT_TRUE(inner);
  EXPECT_EQ(SentBy(*inner, ping.size()), ping);
  const std::string settings = FrameBytes(FrameType::kSettings, 0, 0);
  ASSERT_TRUE(inner->Say(settings));
  EXPECT_EQ(client.ReadSome(), settings);
  inner->socket = Descriptor();
  EXPECT_TRUE(client.IsClosedByServer());
}

TEST_F(DoorTest, CoexistsWithAnotherDoorOfTheProcess) {
  OpenDoor({});
  HttpClient client(door_->port());
  ASSERT_TRUE(client.SendRaw(kPreface));
  const auto inner = behind_.Next();
  ASSERT_TRUE(inner);
  auto other = Door::Open({.name = "other", .address = "127.0.0.1:0"});
  ASSERT_TRUE(other.ok());
  (*other)->Start([&](Passed passed) { behind_.Take(std::move(passed)); });
  HttpClient client_of_other((*other)->port());
  ASSERT_TRUE(client_of_other.SendRaw(kPreface));
  const auto inner_of_other = behind_.Next();  // its names are others
  ASSERT_TRUE(inner_of_other);
  EXPECT_NE(inner_of_other->peer.address, inner->peer.address);
}

TEST_F(DoorTest, PassesTheClientsEndToTheServer) {
  OpenDoor({});
  auto client = std::make_unique<HttpClient>(door_->port());
  ASSERT_TRUE(client->SendRaw(kPreface));
  const auto inner = behind_.Next();
  ASSERT_TRUE(inner);
  EXPECT_EQ(SentBy(*inner, 0), "");
  client.reset();
  EXPECT_TRUE(inner->IsAtEnd());
}

TEST_F(DoorTest, MapsTheInnerSocketsNameToTheClient) {
  OpenDoor({});
  HttpClient client(door_->port());
  ASSERT_TRUE(client.SendRaw(kPreface));
  auto inner = behind_.Next();
  ASSERT_TRUE(inner);
  EXPECT_TRUE(inner->peer.address.starts_with("127.0.0.1:"));
  EXPECT_EQ(inner->local_address, "127.0.0.1");
  sockaddr_un name{};
  socklen_t size = sizeof name;
  ASSERT_EQ(::getpeername(inner->socket.get(), reinterpret_cast<sockaddr*>(&name), &size), 0);
  const std::string as_grpc_says =
      "unix-abstract:" + std::string(&name.sun_path[1], size - offsetof(sockaddr_un, sun_path) - 1);
  const auto found = door_->Find(as_grpc_says);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->address, inner->peer.address);
  const std::size_t digits = as_grpc_says.rfind('c');
  EXPECT_FALSE(door_->Find("unix-abstract:dhpmap-guard-0000000000000000-" + as_grpc_says.substr(digits)));
  HttpClient other(door_->port());
  ASSERT_TRUE(other.SendRaw(kPreface));
  const auto inner_of_other = behind_.Next();
  ASSERT_TRUE(inner_of_other);
  ASSERT_EQ(::getpeername(inner_of_other->socket.get(), reinterpret_cast<sockaddr*>(&name), &(size = sizeof name)), 0);
  EXPECT_NE(std::string(&name.sun_path[1], 29), as_grpc_says.substr(14, 29)) << "no name tells the next";
  inner->socket = Descriptor();
  EXPECT_TRUE(testing::Eventually([&] { return !door_->Find(as_grpc_says); }));
}

TEST_F(DoorTest, MovesMegabytesThroughSmallBuffers) {
  OpenDoor({});
  HttpClient client(door_->port());
  const std::string frame = testing::FrameHeadBytes(16'384, FrameType::kData, 0, 1) + std::string(16'384, 'x');
  constexpr int kFrames = 1000;
  std::thread sender([&] {
    client.SendRaw(kPreface);
    for (int i = 0; i < kFrames; ++i) client.SendRaw(frame);
  });
  auto inner = behind_.Next();
  ASSERT_TRUE(inner);
  EXPECT_EQ(SentBy(*inner, 0), "");
  std::thread answerer([&] {
    for (int i = 0; i < kFrames; ++i) EXPECT_TRUE(inner->Say(frame));
  });
  std::size_t num_bytes = 0;
  while (num_bytes < kFrames * frame.size()) {  // the other end does not read yet: sent data waits
    const std::string part = client.ReadSome();
    if (part.empty()) break;
    num_bytes += part.size();
  }
  EXPECT_EQ(num_bytes, kFrames * frame.size());
  answerer.join();
  for (int i = 0; i < kFrames; ++i) EXPECT_TRUE(inner->Read(frame.size()) == frame) << i;
  sender.join();
}

TEST_F(DoorTest, EndsAFloodWithAReasonAndLeavesOthersAlone) {
  OpenDoor({});
  HttpClient other(door_->port()), attacker(door_->port());
  ASSERT_TRUE(other.SendRaw(kPreface));
  const auto inner_of_other = behind_.Next();
  ASSERT_TRUE(inner_of_other);
  std::string flood = kPreface;
  const auto num_resets = static_cast<std::uint32_t>(FrameLimits::kResets) + 100;
  for (std::uint32_t stream = 1; stream < 2 * num_resets; stream += 2) {
    flood += FrameBytes(FrameType::kHeaders, kEndHeaders, stream, testing::CallFields("/a/b"));
    flood += FrameBytes(FrameType::kReset, 0, stream, testing::BigEndianBytes(8, 4));
  }
  attacker.SendRaw(flood);
  EXPECT_TRUE(IsRefused(Refusal::kTooManyResets));
  EXPECT_TRUE(attacker.IsClosedByServer());
  const std::string settings = FrameBytes(FrameType::kSettings, 0, 0);
  ASSERT_TRUE(inner_of_other->Say(settings));
  EXPECT_EQ(other.ReadSome(), settings);
}

TEST_F(DoorTest, SendsGoAwayWithTheReason) {
  OpenDoor({});
  HttpClient client(door_->port());
  ASSERT_TRUE(client.SendRaw(kPreface));
  const auto inner = behind_.Next();
  ASSERT_TRUE(inner);
  ASSERT_TRUE(client.SendRaw(testing::FrameHeadBytes(100'000, FrameType::kSettings, 0, 0)));
  const std::string last = client.ReadSome();
  ASSERT_GE(last.size(), 17u);
  EXPECT_EQ(last[3], static_cast<char>(FrameType::kGoAway));
  EXPECT_EQ(last[16], 0xB);  // ENHANCE_YOUR_CALM
  EXPECT_EQ(last.substr(17), "frame_too_large");
}

TEST_F(DoorTest, RefusesClientsThatDoNotSpeakHttp2) {
  OpenDoor({});
  HttpClient client(door_->port());
  ASSERT_TRUE(client.SendRaw("GET / HTTP/1.1\r\nHost: localhost\r\n\r\n"));
  EXPECT_TRUE(client.IsClosedByServer());
  EXPECT_TRUE(IsRefused(Refusal::kNotHttp2));
}

TEST_F(DoorTest, AdmitsAClientWhileSilentOnesUseUpTheirLimit) {
  OpenDoor({});
  std::vector<std::unique_ptr<HttpClient>> silent;
  for (int i = 0; i < 150; ++i) silent.push_back(std::make_unique<HttpClient>(door_->port()));
  EXPECT_TRUE(IsRefused(Refusal::kTooManyNew, 150 - 64));
  HttpClient client(door_->port());
  ASSERT_TRUE(client.SendRaw(kPreface));
  EXPECT_TRUE(behind_.Next());
}

TEST_F(DoorTest, LimitsTheConnectionsOfOnePeer) {
  OpenDoor({.max_connections = 100});
  std::vector<std::unique_ptr<HttpClient>> clients;
  std::vector<std::optional<Behind::Inner>> inners;
  for (int i = 0; i < 76; ++i) {
    clients.push_back(std::make_unique<HttpClient>(door_->port()));
    clients.back()->SendRaw(kPreface);
    if (i == 75) break;
    inners.push_back(behind_.Next());
    ASSERT_TRUE(inners.back()) << i;
  }
  EXPECT_TRUE(IsRefused(Refusal::kTooManyConnections));
  EXPECT_TRUE(clients.back()->IsClosedByServer());
}

TEST_F(DoorTest, LimitsTheConnectionsOfOnePeerAtTheRestDoor) {
  OpenDoor({.max_connections = 100, .protocol = Protocol::kHttp11});
  std::vector<std::unique_ptr<HttpClient>> clients;
  std::vector<std::optional<Behind::Inner>> inners;
  for (int i = 0; i < 75; ++i) {
    clients.push_back(std::make_unique<HttpClient>(door_->port()));
    inners.push_back(behind_.Next());
    ASSERT_TRUE(inners.back()) << i;
  }
  const HttpClient beyond(door_->port());
  EXPECT_TRUE(IsRefused(Refusal::kTooManyConnections));
}

TEST_F(DoorTest, SendsTheServersLastBytesBeforeClosing) {
  OpenDoor({});
  HttpClient client(door_->port());
  ASSERT_TRUE(client.SendRaw(kPreface));
  auto inner = behind_.Next();
  ASSERT_TRUE(inner);
  const std::string last = FrameBytes(FrameType::kGoAway, 0, 0, "12345678");
  ASSERT_TRUE(inner->Say(last));
  inner->socket = Descriptor();
  door_.reset();
  EXPECT_EQ(client.ReadSome(), last);
  EXPECT_TRUE(client.IsClosedByServer());
}

class UnixDoorTest : public DoorTest {
 protected:
  [[nodiscard]] std::string path() const { return (folder_.path() / "door").string(); }
  static int Connect(const std::string& path) {
    const int socket = ::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0);
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    path.copy(address.sun_path, sizeof address.sun_path - 1);
    if (::connect(socket, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0) return socket;
    ::close(socket);
    return -1;
  }
  testing::TempDir folder_;
};

TEST_F(UnixDoorTest, KnowsTheConnectedUser) {
  OpenDoor({.address = "unix:" + path()});
  struct stat found {};
  ASSERT_EQ(::stat(path().c_str(), &found), 0);
  EXPECT_EQ(found.st_mode & 0777u, 0660u);
  const Descriptor client(Connect(path()));
  ASSERT_EQ(::send(client.get(), kPreface.data(), kPreface.size(), MSG_NOSIGNAL), std::ssize(kPreface));
  const auto inner = behind_.Next();
  ASSERT_TRUE(inner);
  EXPECT_EQ(inner->peer.address, "unix");
  ASSERT_TRUE(inner->peer.uid);
  EXPECT_EQ(*inner->peer.uid, ::getuid());
  EXPECT_EQ(inner->local_address, "");
  door_.reset();
  EXPECT_NE(::stat(path().c_str(), &found), 0);
}

TEST_F(UnixDoorTest, ReplacesOnlyAnUnusedSocket) {
  {
    const Descriptor dead(::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0));
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    path().copy(address.sun_path, sizeof address.sun_path - 1);
    ASSERT_EQ(::bind(dead.get(), reinterpret_cast<const sockaddr*>(&address), sizeof address), 0);
  }
  OpenDoor({.address = "unix:" + path()});
  EXPECT_FALSE(Door::Open({.address = "unix:" + path()}).ok());  // the socket is in use
  const std::string file = path() + ".txt";
  { const Descriptor kept(::open(file.c_str(), O_CREAT | O_WRONLY | O_CLOEXEC, 0600)); }
  EXPECT_FALSE(Door::Open({.address = "unix:" + file}).ok());
  EXPECT_EQ(::access(file.c_str(), F_OK), 0);
  EXPECT_EQ(Door::Open({.address = "unix:" + std::string(200, 'p')}).status().code(), StatusCode::kInvalidArgument);
}

TEST(PeerKey, IsTheAddressWithoutItsPort) {
  EXPECT_EQ(PeerKey({.address = "192.0.2.7:41000"}), "192.0.2.7");
  EXPECT_EQ(PeerKey({.address = "[2001:db8:1:2:3:4:5:6]:41000"}), "2001:db8:1:2::/64");
  EXPECT_EQ(PeerKey({.address = "[2001:db8:1:2::9]:41001"}), "2001:db8:1:2::/64");
  EXPECT_EQ(PeerKey({.address = "[::ffff:192.0.2.7]:41000"}), "192.0.2.7");
  EXPECT_EQ(PeerKey({.address = "unix", .uid = 1000}), "uid 1000");
}

}  // namespace
}  // namespace dhpmap::net

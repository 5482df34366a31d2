// SPDX-License-Identifier: BSD-3-Clause
// A server with more connections than a process may have at first.
#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cstddef>
#include <filesystem>
#include <iterator>
#include <memory>
#include <string>
#include <vector>

#include "dhpmap/v1/map_service.grpc.pb.h"
#include "tests/e2e/server_process.h"
#include "tests/integration/test_server.h"
#include "tests/support/eventually.h"
#include "tests/support/scenes.h"

namespace dhpmap::testing {
namespace {

/// Lowers the limit of file descriptors, of what is started too, while it lives.
class DescriptorLimit {
 public:
  explicit DescriptorLimit(rlim_t limit) {
    ::getrlimit(RLIMIT_NOFILE, &before_);
    rlimit lower = before_;
    lower.rlim_cur = limit;
    ::setrlimit(RLIMIT_NOFILE, &lower);
  }
  ~DescriptorLimit() { ::setrlimit(RLIMIT_NOFILE, &before_); }
  [[nodiscard]] rlim_t most() const { return before_.rlim_max; }

 private:
  rlimit before_{};
};

/// TCP connections to "host:port" on which nothing is said.
class SilentConnections {
 public:
  explicit SilentConnections(const std::string& address) {
    address_.sin_family = AF_INET;
    address_.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    address_.sin_port = htons(static_cast<std::uint16_t>(std::stoi(address.substr(address.rfind(':') + 1))));
  }
  ~SilentConnections() {
    for (const int socket : sockets_) ::close(socket);
  }
  SilentConnections(const SilentConnections&) = delete;
  SilentConnections& operator=(const SilentConnections&) = delete;

  /// Keeps the first `count`.
  void CloseAllBut(std::size_t count) {
    for (; sockets_.size() > count; sockets_.pop_back()) ::close(sockets_.back());
  }
  bool Open(int count) {
    for (; count > 0; --count) {
      sockets_.push_back(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0));
      if (::connect(sockets_.back(), reinterpret_cast<const sockaddr*>(&address_), sizeof address_) != 0) return false;
    }
    return true;
  }

 private:
  sockaddr_in address_{};
  std::vector<int> sockets_;
};

bool IsAnswering(const ServerProcess& server) {
  grpc::ClientContext context;
  context.set_deadline(std::chrono::system_clock::now() + kPatience);
  v1::ListMapsResponse response;
  return v1::MapService::NewStub(server.Connect())->ListMaps(&context, {}, &response).ok();
}

/// That a process has now.
std::ptrdiff_t NumDescriptors(pid_t pid) {
  const std::filesystem::directory_iterator first("/proc/" + std::to_string(pid) + "/fd");
  return std::distance(begin(first), end(first));
}

/// GetMap of "room".
grpc::Status AskForRoom(const std::shared_ptr<grpc::Channel>& channel) {
  grpc::ClientContext context;
  context.set_deadline(std::chrono::system_clock::now() + kPatience);
  v1::GetMapRequest request;
  request.set_name("maps/room");
  v1::GetMapResponse response;
  return v1::MapService::NewStub(channel)->GetMap(&context, request, &response);
}

TEST(Descriptors, MoreConnectionsThanAProcessMayHaveAtFirstAreNoHarmToEitherDoor) {
  constexpr int kAtFirst = 100;
  TempDir folder;
  std::unique_ptr<ServerProcess> server;
  {
    const DescriptorLimit limit(kAtFirst);
    ASSERT_GE(limit.most(), rlim_t{4} * kAtFirst) << "this process may not have more";
    server = std::make_unique<ServerProcess>(folder.path(), folder.path() / "maps.db");
  }
  ASSERT_TRUE(server->is_serving());
  SilentConnections silent(server->grpc_address());
  ASSERT_TRUE(silent.Open(2 * kAtFirst));
  EXPECT_TRUE(IsAnswering(*server));
  EXPECT_EQ(RunProgram(folder.path(), {"curl", "--silent", "--fail", server->http_url() + "/healthz"}).exit_code, 0);
}

TEST(Descriptors, WhenThereAreNoneForMoreConnectionsTheServerGoesOnAfterwards) {
  constexpr int kAtMost = 100;
  TempDir folder;
  ServerProcess server(folder.path(), folder.path() / "maps.db");
  ASSERT_TRUE(server.is_serving());
  const rlimit limit{.rlim_cur = kAtMost, .rlim_max = kAtMost};
  ASSERT_EQ(::prlimit(server.process().pid(), RLIMIT_NOFILE, &limit, nullptr), 0);
  {
    SilentConnections silent(server.grpc_address());
    ASSERT_TRUE(silent.Open(2 * kAtMost));
    EXPECT_EQ(RunProgram(folder.path(), {"curl", "--silent", "--fail", server.http_url() + "/healthz"}).exit_code, 0);
  }
  // Until the server has seen that they are gone, there are none and it refuses others.
  ASSERT_TRUE(Eventually([&] { return NumDescriptors(server.process().pid()) < kAtMost / 2; }));
  EXPECT_TRUE(IsAnswering(server));
}

TEST(Descriptors, WhenThereAreNoneWhoIsConnectedIsAnsweredOverGrpcAndOthersOnceThereAreSome) {
  constexpr int kAtMost = 100;
  TempDir folder;
  ServerProcess server(folder.path(), folder.path() / "maps.db");
  ASSERT_TRUE(server.is_serving());
  const auto before = server.Connect();
  {
    grpc::ClientContext context;
    v1::CreateMapResponse created;
    ASSERT_TRUE(v1::MapService::NewStub(before)->CreateMap(&context, CreateRequest("room"), &created).ok());
  }
  const rlimit limit{.rlim_cur = kAtMost, .rlim_max = kAtMost};
  ASSERT_EQ(::prlimit(server.process().pid(), RLIMIT_NOFILE, &limit, nullptr), 0);
  SilentConnections silent(server.grpc_address());
  ASSERT_TRUE(silent.Open(2 * kAtMost));
  for (int i = 0; i < 10; ++i) {
    const grpc::Status asked = AskForRoom(before);
    EXPECT_TRUE(asked.ok()) << asked.error_message();
  }
  EXPECT_EQ(RunProgram(folder.path(), {"curl", "--silent", "--fail", server.http_url() + "/healthz"}).exit_code, 0);

  silent.CloseAllBut(kAtMost / 10);
  EXPECT_TRUE(Eventually([&] { return AskForRoom(server.Connect()).ok(); })) << "a new connection";
  EXPECT_TRUE(AskForRoom(before).ok());
}

}  // namespace
}  // namespace dhpmap::testing

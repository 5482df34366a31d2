// SPDX-License-Identifier: BSD-3-Clause
#include "server/service/inherited_sockets.h"

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <cstring>
#include <string>
#include <vector>

#include "tests/support/assert_ok.h"
#include "tests/support/scenes.h"

namespace dhpmap::service {
namespace {

constexpr int kPid = 42;

Result<InheritedSockets> SocketsOf(const std::string& count, const std::string& names, const std::string& pid = "42") {
  return SocketsIn({"LISTEN_PID=" + pid, "LISTEN_FDS=" + count, "LISTEN_FDNAMES=" + names}, kPid);
}

TEST(InheritedSockets, AreTheDescriptorsFromThreeByName) {
  const auto sockets = SocketsOf("3", "rest:grpc:rest");
  ASSERT_OK(sockets);
  EXPECT_EQ(sockets->grpc, std::vector<int>{4});
  EXPECT_EQ(sockets->rest, (std::vector<int>{3, 5}));
}

TEST(InheritedSockets, AreNotThoseOfAnotherProcess) {
  for (const auto& sockets : {SocketsOf("2", "grpc:rest", "41"), SocketsOf("2", "grpc:rest", ""), SocketsOf("", ""),
                              SocketsOf("0", ""), SocketsIn({}, kPid)}) {
    ASSERT_OK(sockets);
    EXPECT_TRUE(sockets->empty());
  }
}

TEST(InheritedSockets, OfAnotherNameAreRefusedWithTheValidNames) {
  for (const auto& [count, names] : std::vector<std::pair<std::string, std::string>>{
           {"1", "dhpmap.socket"}, {"1", ""}, {"2", "grpc"}, {"1", "grpc:rest"}, {"x", "grpc"}, {"65", "grpc"}}) {
    const auto sockets = SocketsOf(count, names);
    EXPECT_EQ(sockets.status().code(), StatusCode::kInvalidArgument) << count << " " << names;
    EXPECT_NE(sockets.status().message(), "");
  }
  EXPECT_NE(SocketsOf("1", "dhpmap.socket").status().message().find("grpc or rest"), std::string::npos);
}

/// Sockets of the test, closed at its end.
class ListeningSockets : public ::testing::Test {
 protected:
  ~ListeningSockets() override {
    for (const int socket : opened_) ::close(socket);
  }
  int Open(const sockaddr* address, socklen_t size, bool listens = true, int type = SOCK_STREAM) {
    const int socket = ::socket(address->sa_family, type | SOCK_CLOEXEC, 0);
    opened_.push_back(socket);
    EXPECT_EQ(::bind(socket, address, size), 0) << std::strerror(errno);
    if (listens) {
      EXPECT_EQ(::listen(socket, 1), 0);
    }
    return socket;
  }
  int OpenV4(in_addr_t host, bool listens = true, int type = SOCK_STREAM) {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(host);
    return Open(reinterpret_cast<const sockaddr*>(&address), sizeof address, listens, type);
  }

 private:
  std::vector<int> opened_;
};

TEST_F(ListeningSockets, ReturnTheirAddress) {
  const auto v4 = AddressOf(OpenV4(INADDR_LOOPBACK));
  ASSERT_OK(v4);
  EXPECT_TRUE(v4->starts_with("127.0.0.1:")) << *v4;
  EXPECT_NE(*v4, "127.0.0.1:0");

  const testing::TempDir folder;
  const std::string path = (folder.path() / "door").string();
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  std::memcpy(address.sun_path, path.data(), path.size());
  const auto local = AddressOf(Open(reinterpret_cast<const sockaddr*>(&address), sizeof address));
  ASSERT_OK(local);
  EXPECT_EQ(*local, "unix:" + path);
}

TEST_F(ListeningSockets, AreDistinguishedFromOtherSockets) {
  for (const int socket : {OpenV4(INADDR_LOOPBACK, false), OpenV4(INADDR_LOOPBACK, false, SOCK_DGRAM), -1}) {
    EXPECT_EQ(AddressOf(socket).status().code(), StatusCode::kInvalidArgument);
  }
}

bool IsOfThisMachine(std::string_view address) { return address.starts_with("127."); }

TEST_F(ListeningSockets, AmongSeveralTheOneReachableFromOtherMachinesCounts) {
  const int near = OpenV4(INADDR_LOOPBACK), far = OpenV4(INADDR_ANY);
  for (const std::vector<int>& sockets : {std::vector<int>{near, far}, {far, near}, {near, far, near}}) {
    const auto address = AddressOf(sockets, IsOfThisMachine);
    ASSERT_OK(address);
    EXPECT_TRUE(address->starts_with("0.0.0.0:")) << *address;
  }
}

}  // namespace
}  // namespace dhpmap::service

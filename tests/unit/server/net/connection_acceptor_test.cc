// SPDX-License-Identifier: BSD-3-Clause
#include "server/net/connection_acceptor.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <condition_variable>
#include <mutex>
#include <vector>

#include "tests/support/eventually.h"

namespace dhpmap::net {
namespace {

constexpr int kPatience_ms = std::chrono::milliseconds(testing::kPatience).count();

/// Owns the sockets it is handed.
class Taken {
 public:
  ~Taken() {
    while (!sockets_.empty()) CloseOne();
  }
  void Take(int socket) {
    const std::lock_guard lock(mutex_);
    sockets_.push_back(socket);
    changed_.notify_all();
  }
  bool WaitFor(std::size_t count) {
    std::unique_lock lock(mutex_);
    return changed_.wait_for(lock, testing::kPatience, [&] { return sockets_.size() >= count; });
  }
  std::size_t size() {
    const std::lock_guard lock(mutex_);
    return sockets_.size();
  }
  int first() {
    const std::lock_guard lock(mutex_);
    return sockets_.front();
  }
  void CloseOne() {
    const std::lock_guard lock(mutex_);
    ::close(sockets_.back());
    sockets_.pop_back();
  }

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
  std::vector<int> sockets_;
};

class Client {
 public:
  Client() : socket_(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)) {}
  explicit Client(int port) : Client() { Connect(port); }
  ~Client() { ::close(socket_); }
  Client(const Client&) = delete;
  Client& operator=(const Client&) = delete;
  [[nodiscard]] int socket() const { return socket_; }
  [[nodiscard]] bool is_connected() const { return is_connected_; }
  /// Whether the server closes the connection within the test's timeout.
  [[nodiscard]] bool IsSentAway() const {
    pollfd end{.fd = socket_, .events = POLLIN, .revents = 0};
    char byte = 0;
    return ::poll(&end, 1, kPatience_ms) == 1 && ::recv(socket_, &byte, 1, 0) <= 0;
  }
  void Say(char byte) const { (void)!::write(socket_, &byte, 1); }

  void Connect(int port) {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    address.sin_port = htons(static_cast<std::uint16_t>(port));
    is_connected_ = ::connect(socket_, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0;
  }

 private:
  int socket_;
  bool is_connected_ = false;
};

std::unique_ptr<ConnectionAcceptor> ListenOnLoopback(int max_connections = 100) {
  auto acceptor = ConnectionAcceptor::Listen({.address = "127.0.0.1:0", .max_connections = max_connections});
  EXPECT_TRUE(acceptor.ok()) << acceptor.status().message();
  return acceptor.ok() ? std::move(*acceptor) : nullptr;
}

TEST(ConnectionAcceptor, HandsOverNonblockingCloseOnExecSockets) {
  Taken taken;
  const auto acceptor = ListenOnLoopback();
  const Client early(acceptor->port());  // waits to be accepted
  acceptor->Start([&](int socket) { taken.Take(socket); });
  ASSERT_TRUE(taken.WaitFor(1));
  EXPECT_TRUE(::fcntl(taken.first(), F_GETFL) & O_NONBLOCK);
  EXPECT_TRUE(::fcntl(taken.first(), F_GETFD) & FD_CLOEXEC);
  early.Say('x');
  pollfd readable{.fd = taken.first(), .events = POLLIN, .revents = 0};
  ASSERT_EQ(::poll(&readable, 1, kPatience_ms), 1);
  char byte = 0;
  EXPECT_EQ(::recv(taken.first(), &byte, 1, 0), 1);
  EXPECT_EQ(byte, 'x');
}

TEST(ConnectionAcceptor, RefusesConnectionsBeyondItsLimitUntilOneIsClosed) {
  Taken taken;
  const auto acceptor = ListenOnLoopback(2);
  acceptor->Start([&](int socket) { taken.Take(socket); });
  const Client first(acceptor->port()), second(acceptor->port());
  ASSERT_TRUE(taken.WaitFor(2));
  const Client third(acceptor->port());
  EXPECT_TRUE(third.IsSentAway());
  EXPECT_EQ(taken.size(), 2u);
  taken.CloseOne();
  const Client fourth(acceptor->port());
  EXPECT_TRUE(taken.WaitFor(2));
}

TEST(ConnectionAcceptor, CountsAReusedDescriptorAsClosed) {
  Taken taken;
  const auto acceptor = ListenOnLoopback(1);
  acceptor->Start([&](int socket) { taken.Take(socket); });
  const Client first(acceptor->port());
  ASSERT_TRUE(taken.WaitFor(1));
  const int reused = taken.first();
  const int other = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
  ASSERT_EQ(::dup2(other, reused), reused);  // closes the connection, and the number lives on
  const Client second(acceptor->port());
  EXPECT_TRUE(taken.WaitFor(2));
  ::close(other);
}

TEST(ConnectionAcceptor, ContinuesAfterAShortageOfDescriptors) {
  Taken taken;
  const auto acceptor = ListenOnLoopback();
  acceptor->Start([&](int socket) { taken.Take(socket); });
  std::array<Client, 20> clients;  // their descriptors are of this process, too
  rlimit before{};
  ASSERT_EQ(::getrlimit(RLIMIT_NOFILE, &before), 0);
  rlimit lower = before;
  lower.rlim_cur = static_cast<rlim_t>(clients.back().socket()) + 3;
  ASSERT_EQ(::setrlimit(RLIMIT_NOFILE, &lower), 0);
  for (Client& client : clients) client.Connect(acceptor->port());
  EXPECT_TRUE(clients.back().is_connected());
  EXPECT_TRUE(clients.back().IsSentAway());
  const std::size_t num_taken = taken.size();
  EXPECT_LT(num_taken, clients.size() / 2);
  ASSERT_EQ(::setrlimit(RLIMIT_NOFILE, &before), 0);
  // The first may still be refused by means of the reserved descriptor.
  EXPECT_TRUE(testing::Eventually([&] {
    const Client after(acceptor->port());
    return taken.size() > num_taken;
  }));
}

TEST(ConnectionAcceptor, LeavesSomeDescriptorsUnused) {
  Taken taken;
  const auto acceptor = ListenOnLoopback();
  acceptor->Start([&](int socket) { taken.Take(socket); });
  std::array<Client, 20> clients;
  rlimit before{};
  ASSERT_EQ(::getrlimit(RLIMIT_NOFILE, &before), 0);
  rlimit lower = before;
  lower.rlim_cur = static_cast<rlim_t>(clients.back().socket()) + 16;
  ASSERT_EQ(::setrlimit(RLIMIT_NOFILE, &lower), 0);
  for (Client& client : clients) client.Connect(acceptor->port());
  EXPECT_TRUE(clients.back().IsSentAway());
  const int free_one = ::open("/dev/null", O_RDONLY | O_CLOEXEC);
  EXPECT_GE(free_one, 0);
  ::close(free_one);
  EXPECT_GT(taken.size(), 0u);
  ASSERT_EQ(::setrlimit(RLIMIT_NOFILE, &before), 0);
}

TEST(ConnectionAcceptor, StopsAtOnceAndKeepsHandedOverSockets) {
  Taken taken;
  const auto acceptor = ListenOnLoopback();
  acceptor->Start([&](int socket) { taken.Take(socket); });
  const Client client(acceptor->port());
  ASSERT_TRUE(taken.WaitFor(1));
  acceptor->Stop();
  EXPECT_FALSE(Client(acceptor->port()).is_connected());
  client.Say('x');
  pollfd readable{.fd = taken.first(), .events = POLLIN, .revents = 0};
  EXPECT_EQ(::poll(&readable, 1, kPatience_ms), 1);
  acceptor->Stop();
}

TEST(ConnectionAcceptor, ReportsWhyItCannotListen) {
  const auto first = ListenOnLoopback();
  const std::string same = "127.0.0.1:" + std::to_string(first->port());
  const auto second = ConnectionAcceptor::Listen({.address = same});
  ASSERT_FALSE(second.ok());
  EXPECT_EQ(second.status().code(), StatusCode::kUnavailable);
  EXPECT_NE(second.status().message().find(same), std::string::npos);
  const auto nowhere = ConnectionAcceptor::Listen({.address = "no such host:1"});
  ASSERT_FALSE(nowhere.ok());
  EXPECT_EQ(nowhere.status().code(), StatusCode::kInvalidArgument);
}

TEST(ConnectionAcceptor, ListensOnAllAddressesOfAName) {
  const auto one = ListenOnLoopback();
  const std::string port = std::to_string(one->port());
  // Taken on one of the addresses of localhost: it must not get half of the clients.
  EXPECT_FALSE(ConnectionAcceptor::Listen({.address = "localhost:" + port}).ok());
  EXPECT_FALSE(ConnectionAcceptor::Listen({.address = ":" + port}).ok());
}

}  // namespace
}  // namespace dhpmap::net

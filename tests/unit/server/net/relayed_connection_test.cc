// SPDX-License-Identifier: BSD-3-Clause
#include "server/net/relayed_connection.h"

#include <gtest/gtest.h>
#include <sys/epoll.h>
#include <sys/socket.h>

#include <algorithm>
#include <array>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace dhpmap::net {
namespace {

using Clock = RelayedConnection::Clock;

struct Pair {
  Descriptor near, far;
};

Pair MakePair() {
  std::array<int, 2> ends{};
  EXPECT_EQ(::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0, ends.data()), 0);
  return {.near = Descriptor(ends[0]), .far = Descriptor(ends[1])};
}

/// A connection that moves bytes on the test's request.
class RelayedConnectionTest : public ::testing::Test {
 protected:
  RelayedConnectionTest() {
    Pair client = MakePair(), inner = MakePair();
    client_ = std::move(client.far);
    door_ = std::move(inner.far);
    relayed_ = std::make_unique<RelayedConnection>(ClientSocket(std::move(client.near), nullptr), std::move(inner.near),
                                                   nullptr, poller_);
    EXPECT_TRUE(relayed_->Begin());
  }
  /// Moves bytes until nothing is ready; returns the number of moves.
  int MoveAll() {
    for (int rounds = 0;; ++rounds) {
      if (relayed_->is_over()) return rounds;
      const auto ready = poller_.Wait(0);
      if (ready.empty() && !relayed_->has_more()) return rounds;
      if (ready.empty()) relayed_->Continue(scratch_);
      for (const Poller::Ready& one : ready) relayed_->OnReady(one.descriptor, one.events, scratch_);
      if (rounds > 100'000) {
        ADD_FAILURE() << "it is ready for ever";
        return rounds;
      }
    }
  }
  /// Writes as much as is accepted; returns the total.
  std::size_t Fill(const Descriptor& from) {
    const std::string part(10'000, 'x');
    std::size_t num_bytes = 0;
    while (true) {
      const ssize_t sent = ::send(from.get(), part.data(), part.size(), MSG_NOSIGNAL);
      if (sent > 0) num_bytes += static_cast<std::size_t>(sent);
      if (sent <= 0 && MoveAll() == 0) return num_bytes;
      if (num_bytes > (64u << 20)) return num_bytes;
    }
  }
  std::size_t Drain(const Descriptor& at) {
    std::array<char, 65'536> bytes;
    std::size_t num_bytes = 0;
    while (true) {
      const ssize_t got = ::recv(at.get(), bytes.data(), bytes.size(), 0);
      if (got > 0) num_bytes += static_cast<std::size_t>(got);
      if (got == 0) return num_bytes;
      if (got < 0 && MoveAll() == 0) return num_bytes;
    }
  }
  static bool IsAtEnd(const Descriptor& at) {
    char byte = 0;
    return ::recv(at.get(), &byte, 1, 0) == 0;
  }
  void SayFrom(const Descriptor& from, const std::string& text) {
    EXPECT_EQ(::send(from.get(), text.data(), text.size(), MSG_NOSIGNAL), std::ssize(text));
  }

  static constexpr std::size_t kMost_bytes = 4u << 20;  // two sockets' buffers and a scratch

  Poller poller_;
  std::vector<char> scratch_ = std::vector<char>(65'536);
  Descriptor client_, door_;
  std::unique_ptr<RelayedConnection> relayed_;
};

TEST_F(RelayedConnectionTest, StopsReadingAClientWhoseServerDoesNotRead) {
  const std::size_t num_bytes = Fill(client_);
  EXPECT_LT(num_bytes, kMost_bytes);
  EXPECT_EQ(Drain(door_), num_bytes);
  EXPECT_GT(Fill(client_), 0u);  // relaying continues
}

TEST_F(RelayedConnectionTest, StopsReadingAServerWhoseClientDoesNotRead) {
  const std::size_t num_bytes = Fill(door_);
  EXPECT_LT(num_bytes, kMost_bytes);
  EXPECT_EQ(Drain(client_), num_bytes);
}

TEST_F(RelayedConnectionTest, IsNotReadyWhileBothSidesAreBlocked) {
  Fill(client_);
  Fill(door_);
  EXPECT_EQ(MoveAll(), 0);
}

TEST_F(RelayedConnectionTest, ClosesAfterTheServerOnceTheClientHasAllBytes) {
  const std::size_t num_bytes = Fill(door_);
  door_ = Descriptor();
  MoveAll();
  EXPECT_FALSE(relayed_->is_over());  // there are last words
  EXPECT_EQ(Drain(client_), num_bytes);
  EXPECT_TRUE(relayed_->is_over());
}

TEST_F(RelayedConnectionTest, PassesAnEndThatArrivesWithTheLastBytes) {
  SayFrom(door_, "bye");
  door_ = Descriptor();
  MoveAll();
  EXPECT_EQ(Drain(client_), 3u);
  EXPECT_TRUE(relayed_->is_over()) << "without waiting for the time of last words";
}

TEST_F(RelayedConnectionTest, WaitsALimitedTimeForTheLastBytes) {
  Fill(door_);
  door_ = Descriptor();
  MoveAll();
  relayed_->AtTime(Clock::now());
  EXPECT_FALSE(relayed_->is_over());
  relayed_->AtTime(Clock::now() + std::chrono::minutes(1));
  EXPECT_TRUE(relayed_->is_over());
}

TEST_F(RelayedConnectionTest, LetsEitherSideEndWhileTheOtherContinues) {
  SayFrom(client_, "all");
  ::shutdown(client_.get(), SHUT_WR);
  MoveAll();
  EXPECT_EQ(Drain(door_), 3u);
  EXPECT_TRUE(IsAtEnd(door_));
  EXPECT_FALSE(relayed_->is_over());
  SayFrom(door_, "answer");
  MoveAll();
  EXPECT_EQ(Drain(client_), 6u);
  ::shutdown(door_.get(), SHUT_WR);
  MoveAll();
  EXPECT_TRUE(IsAtEnd(client_));
  EXPECT_TRUE(relayed_->is_over());
}

TEST_F(RelayedConnectionTest, LetsTheServerEndItsAnswerAndContinueReading) {
  ::shutdown(door_.get(), SHUT_WR);
  MoveAll();
  EXPECT_TRUE(IsAtEnd(client_));
  SayFrom(client_, "rest");
  MoveAll();
  EXPECT_FALSE(relayed_->is_over());
  EXPECT_EQ(Drain(door_), 4u);
}

TEST_F(RelayedConnectionTest, EndsWhenTheClientDisconnects) {
  client_ = Descriptor();
  MoveAll();
  EXPECT_TRUE(relayed_->is_over());
  relayed_.reset();
  EXPECT_TRUE(IsAtEnd(door_));
}

}  // namespace
}  // namespace dhpmap::net

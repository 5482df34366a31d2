// SPDX-License-Identifier: BSD-3-Clause
#include "server/grpc/entrance.h"

#include <gtest/gtest.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>

#include "server/net/door.h"

namespace dhpmap {
namespace {

TEST(Entrance, ClosesConnectionsAfterTheServerHasEnded) {
  grpc::ServerBuilder builder;
  Entrance entrance(auth::Gate::Open(), builder);
  entrance.Close();
  std::array<int, 2> ends{};
  ASSERT_EQ(::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()), 0);
  entrance.Let({.socket = ends[0], .peer = {.address = "192.0.2.7:41000"}});
  char byte = 0;
  EXPECT_EQ(::recv(ends[1], &byte, 1, MSG_DONTWAIT), 0) << "the end of the stream";
  ::close(ends[1]);
}

}  // namespace
}  // namespace dhpmap

// SPDX-License-Identifier: BSD-3-Clause
#include "server/net/address.h"

#include <gtest/gtest.h>

namespace dhpmap::net {
namespace {

TEST(Address, HasAHostAndAPort) {
  const auto plain = SplitAddress("127.0.0.1:50051");
  ASSERT_TRUE(plain.ok());
  EXPECT_EQ(plain->host, "127.0.0.1");
  EXPECT_EQ(plain->port, 50051);
  const auto v6 = SplitAddress("[::1]:0");
  ASSERT_TRUE(v6.ok());
  EXPECT_EQ(v6->host, "::1");
  EXPECT_EQ(v6->port, 0);
  const auto everywhere = SplitAddress(":8080");
  ASSERT_TRUE(everywhere.ok());
  EXPECT_EQ(everywhere->host, "");
}

TEST(Address, WithoutAValidPortIsInvalid) {
  for (const char* text :
       {"", "localhost", "localhost:", "localhost:http", "localhost:65536", "localhost:-1", "a:1 "}) {
    const auto address = SplitAddress(text);
    ASSERT_FALSE(address.ok()) << text;
    EXPECT_EQ(address.status().code(), StatusCode::kInvalidArgument) << text;
  }
}

}  // namespace
}  // namespace dhpmap::net

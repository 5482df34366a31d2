// SPDX-License-Identifier: BSD-3-Clause
// Call headers that no gRPC client would send.
#include <gtest/gtest.h>

#include <memory>
#include <string>

#include "tests/integration/auth/locked_server.h"
#include "tests/unit/server/net/http2_bytes.h"

namespace dhpmap::testing {
namespace {

TEST(AttacksByHeaders, EndOnlyTheirOwnConnection) {
  LockedServer locked;
  const auto asked = [&](const std::shared_ptr<grpc::Channel>& channel, const std::string& metadata) {
    return CallRawAs(channel, "/dhpmap.v1.MapService/ListMaps", locked.key_of("viewer"), {{"x-large", metadata}});
  };
  const auto honest = locked.server().channel();
  EXPECT_OK(asked(honest, "small"));
  grpc::ChannelArguments own;
  own.SetInt(GRPC_ARG_USE_LOCAL_SUBCHANNEL_POOL, 1);  // a connection of its own
  const auto attacker = grpc::CreateCustomChannel("127.0.0.1:" + std::to_string(locked.server().grpc().port()),
                                                  grpc::InsecureChannelCredentials(), own);
  EXPECT_NE(asked(attacker, std::string(64 << 10, 'x')).error_code(), grpc::OK);

  http::HttpClient raw(locked.server().grpc().port());
  std::string fields = CallFields("/dhpmap.v1.MapService/ListMaps") +
                       LiteralField("authorization", "Bearer " + locked.key_of("viewer").substr(0, 90)) +
                       LiteralField("x-bin", "!!! no base64 \x01");
  ASSERT_TRUE(raw.SendRaw(std::string(net::kHttp2Preface) + FrameBytes(net::FrameType::kSettings, 0, 0) +
                          FrameBytes(net::FrameType::kHeaders, net::frame_flags::kEndHeaders, 1, fields)));
  EXPECT_FALSE(raw.ReadSome().empty()) << "it is answered, or told why not";
  EXPECT_OK(asked(honest, "small")) << "and the server stands";
}

}  // namespace
}  // namespace dhpmap::testing

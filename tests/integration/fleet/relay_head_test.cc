// SPDX-License-Identifier: BSD-3-Clause
// What goes through a relay beside the messages: deadline and metadata, and bytes that are no legal metadata.
#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <sys/socket.h>
#include <unistd.h>

#include <string>

#include "tests/integration/fleet/relay_to_hand.h"
#include "tests/unit/server/net/http2_bytes.h"

namespace dhpmap::testing {
namespace {

class RelayHead : public RelayToHand {
 protected:
  /// Sends bytes to the relay's door on a connection of its own, which it returns.
  int SendRaw(const std::string& bytes) {
    const int to = ::socket(AF_INET, SOCK_STREAM, 0);
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    address.sin_port = htons(static_cast<std::uint16_t>(relay->server.grpc().port()));
    EXPECT_EQ(::connect(to, reinterpret_cast<sockaddr*>(&address), sizeof address), 0);
    EXPECT_EQ(::send(to, bytes.data(), bytes.size(), MSG_NOSIGNAL), static_cast<ssize_t>(bytes.size()));
    return to;
  }
};

TEST_F(RelayHead, TheDeadlineOfTheClientReachesTheOwner) {
  Open();
  const auto deadline = std::chrono::system_clock::now() + std::chrono::hours(1);
  const auto call = Call(kUnary, [&](grpc::ClientContext& context) { context.set_deadline(deadline); });
  ASSERT_TRUE(call->WriteLast(Request()));
  HeldCall& held = owner.Accept();
  EXPECT_LT(held.deadline, deadline + std::chrono::minutes(1));
  EXPECT_GT(held.deadline, deadline - std::chrono::minutes(10));
}

TEST_F(RelayHead, MetadataPassBothWaysButForCredentials) {
  Open();
  const auto call = Call(kAnswers, [](grpc::ClientContext& context) {
    context.AddMetadata("x-robot", "7");
    context.AddMetadata("x-bytes-bin", std::string("\0\xff", 2));
    context.AddMetadata("authorization", "Bearer secret");
    context.AddMetadata("cookie", "secret");
  });
  ASSERT_TRUE(call->WriteLast(Request()));
  HeldCall& held = owner.Accept();
  EXPECT_EQ(held.metadata.find("x-robot")->second, "7");
  EXPECT_EQ(held.metadata.find("x-bytes-bin")->second, std::string("\0\xff", 2));
  EXPECT_FALSE(held.metadata.contains("authorization"));
  EXPECT_FALSE(held.metadata.contains("cookie"));
  held.context->AddInitialMetadata("x-head", "head");
  held.context->AddTrailingMetadata("x-end", "end");
  ASSERT_TRUE(held.Write("answer"));
  held.End({grpc::NOT_FOUND, "nothing", "details"});
  EXPECT_TRUE(call->Read());
  EXPECT_EQ(call->Finish().error_details(), "details");
  EXPECT_EQ(HeadOf(call->context, "x-head"), "head");
  EXPECT_TRUE(call->context.GetServerTrailingMetadata().contains("x-end"));
}

TEST_F(RelayHead, BytesThatAreNoLegalMetadataDoNotEndTheServer) {
  Open();
  const std::string request = Request();
  const std::string message =
      std::string(1, '\0') + BigEndianBytes(static_cast<std::uint32_t>(request.size()), 4) + request;
  constexpr int kEndHeaders = 4, kEndStream = 1;
  const std::string fields = CallFields(kUnary) + LiteralField("x-value", "\x01\xff\x7f") +
                             LiteralField("x key!", "1") + LiteralField("x-good", "1") +
                             LiteralField("user-agent", "\xff\xfe");
  const int connection = SendRaw(std::string(net::kHttp2Preface) + FrameBytes(net::FrameType::kSettings, 0, 0) +
                                 FrameBytes(net::FrameType::kHeaders, kEndHeaders, 1, fields) +
                                 FrameBytes(net::FrameType::kData, kEndStream, 1, message));
  HeldCall& held = owner.Accept();
  EXPECT_TRUE(held.metadata.contains("x-good"));
  EXPECT_FALSE(held.metadata.contains("x-value"));
  EXPECT_FALSE(held.metadata.contains("x key!"));
  held.End(grpc::Status::OK);
  ::close(connection);
}

TEST_F(FleetOfTwo, TooMuchMetadataFailsOneCallAndNoOther) {
  grpc::ClientContext streams;
  const auto stream = other.server.queries->StreamQueries(&streams);
  v1::StreamQueriesRequest query;
  *query.mutable_query_points() = TestQuery("room");
  v1::StreamQueriesResponse answer;
  ASSERT_TRUE(stream->Write(query) && stream->Read(&answer));
  for (const std::size_t num_bytes : {3000u, 5000u, 7400u, 7600u}) {
    grpc::ClientContext context;
    context.AddMetadata("x-much", std::string(num_bytes, 'm'));
    v1::GetMapRequest request;
    request.set_name("maps/room");
    v1::GetMapResponse response;
    const grpc::Status status = other.server.maps->GetMap(&context, request, &response);
    const bool is_passed_on = num_bytes < 4000;
    EXPECT_EQ(status.error_code(), is_passed_on ? grpc::OK : grpc::RESOURCE_EXHAUSTED) << status.error_message();
    ASSERT_TRUE(stream->Write(query) && stream->Read(&answer)) << "the connection between the servers, " << num_bytes;
  }
  stream->WritesDone();
  EXPECT_OK(stream->Finish());
}

}  // namespace
}  // namespace dhpmap::testing

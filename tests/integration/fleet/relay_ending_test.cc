// SPDX-License-Identifier: BSD-3-Clause
// How relayed calls end when the client cancels, or the owner dies in their middle: in each shape that calls have.
#include <arpa/inet.h>
#include <google/rpc/error_details.pb.h>
#include <gtest/gtest.h>
#include <sys/socket.h>
#include <unistd.h>

#include <thread>

#include "server/grpc/status_conversion.h"
#include "tests/integration/fleet/relay_to_hand.h"

namespace dhpmap::testing {
namespace {

/// What a client gets that is to try again.
void ExpectUnreachable(const grpc::Status& status, const std::string& path) {
  EXPECT_EQ(status.error_code(), grpc::UNAVAILABLE) << path << ": " << status.error_message();
  EXPECT_EQ(ReasonOf(status), "OWNER_UNREACHABLE") << path;
  google::rpc::Status details;
  ASSERT_TRUE(details.ParseFromString(status.error_details())) << path;
  EXPECT_GT(DetailOf<google::rpc::RetryInfo>(details).retry_delay().seconds(), 0) << path;
}

class RelayEnding : public RelayToHand {
 protected:
  struct Begun {
    std::unique_ptr<CallByHand> call;
    HeldCall* held;
  };
  /// In the middle: the owner has the request, and of a stream the client has an answer.
  Begun Begin(const std::string& path) {
    auto call = Call(path, path == kFrames ? &NameRoom : CallByHand::Fill());
    if (path == kBoth) EXPECT_TRUE(call->Write(FirstOfStream()));
    else if (path == kFrames) EXPECT_TRUE(call->Write(FrameOfRoom()));
    else EXPECT_TRUE(call->WriteLast(Request()));
    HeldCall& held = owner.Accept();
    EXPECT_TRUE(held.Read()) << path;
    if (path == kAnswers || path == kBoth) {
      EXPECT_TRUE(held.Write("answer")) << path;
      EXPECT_TRUE(call->Read()) << path;
    }
    return {std::move(call), &held};
  }
  static std::string FrameOfRoom() {
    v1::IntegrateFramesRequest request;
    request.set_map("maps/room");
    return request.SerializeAsString();
  }
  const std::vector<std::string> paths{kUnary, kAnswers, kFrames, kBoth};
};

TEST_F(RelayEnding, AClientThatCancelsCancelsTheOwnersCall) {
  Open();
  for (const std::string& path : paths) {
    const Begun begun = Begin(path);
    begun.call->context.TryCancel();
    EXPECT_TRUE(begun.held->IsCancelledSoon()) << path;
    EXPECT_EQ(begun.call->Finish().error_code(), grpc::CANCELLED) << path;
  }
  EXPECT_TRUE(IsAllGivenBack());
}

TEST_F(RelayEnding, AnOwnerThatDiesInTheMiddleIsUnreachable) {
  Open();
  std::vector<Begun> begun;
  for (const std::string& path : paths) begun.push_back(Begin(path));
  owner.Die();
  for (std::size_t i = 0; i < paths.size(); ++i) ExpectUnreachable(begun[i].call->Finish(), paths[i]);
  EXPECT_TRUE(IsAllGivenBack());
}

TEST_F(RelayEnding, AnOwnerThatCancelsACallIsUnreachable) {
  Open();
  for (const std::string& path : paths) {
    const Begun begun = Begin(path);
    begun.held->context->TryCancel();
    ExpectUnreachable(begun.call->Finish(), path);
  }
}

TEST_F(RelayEnding, AnOwnerThatEndsEarlyEndsAClientThatStillWrites) {
  Open();
  const auto call = Call(kBoth);
  ASSERT_TRUE(call->Write(FirstOfStream()));
  HeldCall& held = owner.Accept();
  ASSERT_TRUE(held.Read());
  std::thread writer([&] {
    while (call->Write(std::string(kLarge_bytes, 'q'))) {
    }
  });
  held.End({grpc::ABORTED, "enough", "details"});
  writer.join();
  const grpc::Status status = call->Finish();
  EXPECT_EQ(status.error_code(), grpc::ABORTED);
  EXPECT_EQ(status.error_message(), "enough");
  EXPECT_EQ(status.error_details(), "details");
}

TEST_F(RelayEnding, AnOwnerThatAcceptsAndNeverSpeaksIsUnreachable) {
  const int listener = ::socket(AF_INET, SOCK_STREAM, 0);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  socklen_t size = sizeof address;
  ASSERT_EQ(::bind(listener, reinterpret_cast<sockaddr*>(&address), size), 0);
  ASSERT_EQ(::listen(listener, 8), 0);
  ASSERT_EQ(::getsockname(listener, reinterpret_cast<sockaddr*>(&address), &size), 0);
  Open();
  room->AddMap("hall", room->Join("127.0.0.1:" + std::to_string(ntohs(address.sin_port))));
  ExpectUnreachable(relay->server.Call(&MapStub::GetMap, "maps/hall").status(), "a silent owner");
  ::close(listener);
}

TEST_F(RelayEnding, TwoServersThatTakeEachOtherForTheOwnerEndInOneHop) {
  // The owner answers NOT_OWNER, the database still names it: one more question, one more call, and then an error.
  Open();
  const int asked = relay->fleet.num_asked();
  const auto call = Call(kUnary);
  ASSERT_TRUE(call->WriteLast(Request()));
  const grpc::Status not_owner = ToGrpc(Unavailable("not mine").WithReason("NOT_OWNER"));
  for (int i = 0; i < 2; ++i) {
    HeldCall& held = owner.Accept();
    EXPECT_EQ(held.metadata.find(kRelayedKey)->second, kPassedOn);
    EXPECT_TRUE(held.Read());
    held.End(not_owner);
  }
  EXPECT_EQ(ReasonOf(call->Finish()), "NOT_OWNER");
  EXPECT_EQ(relay->fleet.num_asked(), asked + 1);
}

}  // namespace
}  // namespace dhpmap::testing

// SPDX-License-Identifier: BSD-3-Clause
// IntegrateFrames with messages given as bytes.
#include <grpcpp/generic/generic_stub.h>
#include <gtest/gtest.h>

#include <chrono>
#include <memory>
#include <string>
#include <vector>

#include "server/wire/frame_conversion.h"
#include "tests/integration/feeder.h"
#include "tests/integration/test_server.h"
#include "tests/support/eventually.h"
#include "tests/support/status_reason.h"

namespace dhpmap::testing {
namespace {

/// The final status of a stream that sends these messages only.
grpc::Status SendBytes(TestServer& server, const std::vector<std::string>& messages) {
  grpc::CompletionQueue queue;
  grpc::ClientContext context;
  context.set_deadline(std::chrono::system_clock::now() + kPatience);
  grpc::GenericStub stub(server.channel());
  const auto call = stub.PrepareCall(&context, "/dhpmap.v1.MappingService/IntegrateFrames", &queue);
  const auto wait = [&queue] {
    void* tag = nullptr;
    bool is_well = false;
    return queue.Next(&tag, &is_well) && is_well;
  };
  call->StartCall(&context);
  bool goes_on = wait();
  for (std::size_t i = 0; goes_on && i < messages.size(); ++i) {
    const grpc::Slice slice(messages[i]);
    call->Write(grpc::ByteBuffer(&slice, 1), &context);
    goes_on = wait();
    grpc::ByteBuffer answer;
    if (goes_on) call->Read(&answer, &context), goes_on = wait();
  }
  if (goes_on) call->WritesDone(&context), (void)wait();
  grpc::Status status;
  call->Finish(&status, &context);
  (void)wait();
  queue.Shutdown();
  while (wait()) {
  }
  return status;
}

class FrameBytes : public ::testing::Test {
 protected:
  void SetUp() override { ASSERT_OK(server_.Call(&MapStub::CreateMap, CreateRequest("room"))); }
  static std::string FrameAsBytes(int frame) {
    v1::IntegrateFramesRequest request;
    request.set_map("maps/room");
    request.set_sequence(frame);
    *request.mutable_frame() = TestFrame(frame);
    return request.SerializeAsString();
  }
  std::int64_t NumFrames() { return store_->GetMap("room")->info.num_frames; }

  std::unique_ptr<MapStore> store_ = MakeMemoryStore();
  TestServer server_{*store_};
};

TEST_F(FrameBytes, OfAValidMessageAreFused) {
  const grpc::Status status = SendBytes(server_, {FrameAsBytes(0)});
  EXPECT_OK(status);
  EXPECT_EQ(NumFrames(), 1);
}

TEST_F(FrameBytes, OfAnInvalidMessageEndTheStreamWithAReason) {
  const std::string cut = FrameAsBytes(1).substr(0, 1000);
  for (const std::string& bytes : {std::string("\xff\xff\xff", 3), cut, std::string(100'000, '\x07')}) {
    const grpc::Status status = SendBytes(server_, {FrameAsBytes(0), bytes});
    EXPECT_EQ(status.error_code(), grpc::StatusCode::INVALID_ARGUMENT) << status.error_message();
    EXPECT_EQ(ReasonOf(status), "MALFORMED_PROTOBUF");
  }
  EXPECT_EQ(NumFrames(), 3) << "what came before is fused, and stored";
  EXPECT_TRUE(Eventually([&] { return server_.grpc().frame_bytes() == 0; })) << server_.grpc().frame_bytes();
  EXPECT_OK(Feed(server_, "room", 3, 4)) << "the map is free again";
}

TEST_F(FrameBytes, AreNotDecodedForAStreamThatMayNotFeedItsMap) {
  v1::IntegrateFramesRequest head;
  head.set_map("maps/nowhere");
  // An invalid frame: decoding it would be reported.
  const grpc::Status status = SendBytes(server_, {head.SerializeAsString() + std::string("\x1a\x01\xff", 3)});
  EXPECT_EQ(status.error_code(), grpc::StatusCode::NOT_FOUND) << status.error_message();
  EXPECT_EQ(ReasonOf(status), "MAP_NOT_FOUND");
  EXPECT_TRUE(Eventually([&] { return server_.grpc().frame_bytes() == 0; })) << server_.grpc().frame_bytes();
}

TEST_F(FrameBytes, OfCancelledStreamsAreFreed) {
  constexpr int kStreams = 50;
  for (int i = 0; i < kStreams; ++i) {
    Feeder feeder(server_, "room", {.session = "robot"});
    ASSERT_TRUE(feeder.Send(i, i % 8));
  }  // cancelled, at any stage of its frame
  EXPECT_TRUE(Eventually([&] { return server_.grpc().frame_bytes() == 0; })) << server_.grpc().frame_bytes();
  Feeder feeder(server_, "room", {.session = "robot"});
  const auto fused = feeder.Feed(kStreams + 1);
  ASSERT_TRUE(fused) << "the next one has the map";
  EXPECT_EQ(fused->outcome(), v1::IntegrateFramesResponse::FUSED);
  feeder.HalfClose();
  EXPECT_OK(feeder.Finish());
  EXPECT_OK(server_.Stop()) << "nothing is left that would hold up the end";
}

TEST_F(FrameBytes, ThatAreCompressedAreRefusedBecauseTheirSizeIsUnbounded) {
  for (const grpc_compression_algorithm algorithm : {GRPC_COMPRESS_DEFLATE, GRPC_COMPRESS_GZIP}) {
    grpc::ClientContext context;
    context.set_compression_algorithm(algorithm);
    const auto stream = server_.mapping->IntegrateFrames(&context);
    v1::IntegrateFramesRequest request;
    request.set_map("maps/room");
    request.mutable_frame()->mutable_lidar()->set_rgb(std::string(16 << 20, '\0'));
    stream->Write(request);
    stream->WritesDone();
    v1::IntegrateFramesResponse answer;
    while (stream->Read(&answer)) {
    }
    EXPECT_EQ(stream->Finish().error_code(), grpc::StatusCode::UNIMPLEMENTED);
  }
  EXPECT_OK(Feed(server_, "room", 0, 1)) << "uncompressed all is well";
}

TEST_F(FrameBytes, OfAFirstFrameThatDoesNotFitAreRefusedAndNotTakenForAGreeting) {
  const std::unique_ptr<MapStore> store = MakeMemoryStore();
  const std::size_t too_few_bytes = DecodedBytes(TestFrame(5));  // the message itself is counted, too
  TestServer server(*store, {}, {.inflight = std::make_shared<ByteBudget>(too_few_bytes)});
  ASSERT_OK(server.Call(&MapStub::CreateMap, CreateRequest("room")));
  Feeder feeder(server, "room", {.session = "robot"});
  const auto answer = feeder.Feed(5);
  ASSERT_TRUE(answer);
  EXPECT_EQ(answer->sequence(), 5);
  EXPECT_EQ(answer->outcome(), v1::IntegrateFramesResponse::REFUSED);
  EXPECT_EQ(ReasonOf(answer->error()), "TOO_MANY_BYTES");
  feeder.HalfClose();
  EXPECT_OK(feeder.Finish());
}

}  // namespace
}  // namespace dhpmap::testing

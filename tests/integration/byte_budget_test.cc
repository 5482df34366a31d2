// SPDX-License-Identifier: BSD-3-Clause
// One budget bounds the memory of requests and answers, over every door.
#include <gtest/gtest.h>

#include <memory>

#include "server/wire/frame_conversion.h"
#include "tests/integration/feeder.h"
#include "tests/integration/test_server.h"
#include "tests/support/eventually.h"
#include "tests/support/status_reason.h"

namespace dhpmap::testing {
namespace {

constexpr std::size_t kLimit_bytes = 32u << 20, kSmall_bytes = 16u << 10;

class InflightBytes : public ::testing::Test {
 protected:
  explicit InflightBytes(double to_take_last_s = GrpcOptions().to_take_last_s)
      : server_(*store_, KeepsNoPast(), {.inflight = budget_, .to_take_last_s = to_take_last_s}) {}

  void SetUp() override {
    ASSERT_OK(server_.Call(&MapStub::CreateMap, CreateRequest("room")));
    ASSERT_OK(Feed(server_, "room", 0, 3));
    ExpectNothingKept();
  }

  /// Past states are not kept, so an old state is held by its readers only.
  static OpenMapOptions KeepsNoPast() {
    OpenMapOptions options;
    options.history.max_states = 0;
    return options;
  }

  /// The server frees a call a moment after the client has the answer.
  void ExpectNothingKept() {
    EXPECT_TRUE(Eventually([&] { return budget_->used_bytes() == 0; })) << budget_->used_bytes();
  }

  grpc::Status Ask(int num_points, bool is_packed = true) {
    v1::QueryPointsRequest request;
    request.set_map("maps/room");
    request.set_packed(is_packed);
    for (int i = 0; i < 3 * num_points; ++i) request.add_packed_points_m(0.001f * static_cast<float>(i % 997));
    return server_.Call(&QueryStub::QueryPoints, request).status();
  }

  grpc::Status Mesh() { return server_.Call(&SubmapStub::GetSubmapMesh, "maps/room").status(); }

  const std::shared_ptr<ByteBudget> budget_ = std::make_shared<ByteBudget>(kLimit_bytes, kSmall_bytes);
  std::unique_ptr<MapStore> store_ = MakeMemoryStore();
  TestServer server_;
};

TEST_F(InflightBytes, LargeRequestsAreRefusedWithoutMemoryAndSmallOnesAnswered) {
  ByteShare others(budget_.get());
  ASSERT_TRUE(others.Resize(kLimit_bytes));
  EXPECT_OK(Ask(100));
  for (const grpc::Status& refused : {Ask(100'000), Mesh()}) {
    EXPECT_EQ(refused.error_code(), grpc::StatusCode::RESOURCE_EXHAUSTED) << refused.error_message();
    EXPECT_EQ(ReasonOf(refused), "TOO_MANY_BYTES");
  }
  others.Release();
  EXPECT_OK(Ask(100'000));
  EXPECT_OK(Mesh());
  ExpectNothingKept();
}

TEST_F(InflightBytes, AnAnswerThatCannotFitSaysWhatToDo) {
  const grpc::Status refused = Ask(100'000, /*is_packed=*/false);
  EXPECT_EQ(refused.error_code(), grpc::StatusCode::INVALID_ARGUMENT);
  EXPECT_EQ(ReasonOf(refused), "BAD_POINTS");
  EXPECT_OK(Ask(100'000)) << "packed they do";
}

TEST_F(InflightBytes, AnAnswerIsCountedUntilTheClientHasReadIt) {
  grpc::ClientContext context;
  v1::GetSubmapMeshRequest request;
  request.set_name("maps/room");
  const auto mesh = server_.submaps->GetSubmapMesh(&context, request);
  v1::GetSubmapMeshResponse part;
  ASSERT_TRUE(mesh->Read(&part));
  EXPECT_GT(budget_->used_bytes(), 0u);
  while (mesh->Read(&part)) {
  }
  EXPECT_OK(mesh->Finish());
  ExpectNothingKept();
}

/// A mesh is streamed while its map changes, so the state that it shows needs memory of its own.
class InflightStates : public InflightBytes {
 protected:
  explicit InflightStates(double to_take_last_s = 1e6) : InflightBytes(to_take_last_s) {}

  void SetUp() override {
    InflightBytes::SetUp();
    v1::CreateMapRequest fine = CreateRequest("fine");
    fine.mutable_config()->set_voxel_size_m(0.025);
    EXPECT_OK(server_.Call(&MapStub::CreateMap, fine));
    EXPECT_OK(Feed(server_, "fine", 0, 12));
    v1::GetSubmapMeshRequest request;
    request.set_name("maps/fine");
    grpc::ChannelArguments arguments;
    arguments.SetInt(GRPC_ARG_HTTP2_BDP_PROBE, 0);  // else gRPC buffers megabytes for a client that does not read
    arguments.SetInt(GRPC_ARG_USE_LOCAL_SUBCHANNEL_POOL, 1);
    const auto stub = v1::SubmapService::NewStub(grpc::CreateCustomChannel(
        "127.0.0.1:" + std::to_string(server_.grpc().port()), grpc::InsecureChannelCredentials(), arguments));
    mesh_ = stub->GetSubmapMesh(&context_, request);
    EXPECT_TRUE(mesh_->Read(&part_));
  }
  /// Takes all memory that the pinned state leaves.
  void TakeAllRoom() {
    const std::size_t stream_bytes = budget_->used_bytes();
    ASSERT_GT(stream_bytes, 0u);
    ASSERT_OK(Feed(server_, "fine", 0, 3));  // creates many blocks
    EXPECT_TRUE(Eventually([&] { return budget_->used_bytes() > stream_bytes; }))
        << "what only the old state has is counted";
    ASSERT_TRUE(Eventually([&] { return others_.Grow(kLimit_bytes - budget_->used_bytes()); }))
        << "a look may take some of it first";
  }
  /// Memory for the state was refused: then only the rest is counted.
  [[nodiscard]] bool IsAskedToLetGo() const { return budget_->used_bytes() < kLimit_bytes; }

  ByteShare others_{budget_.get()};
  grpc::ClientContext context_;
  std::unique_ptr<grpc::ClientReader<v1::GetSubmapMeshResponse>> mesh_;
  v1::GetSubmapMeshResponse part_;
};

TEST_F(InflightStates, AreReleasedWithAReasonWhenTheMapOfAStreamedMeshChanges) {
  TakeAllRoom();
  ASSERT_OK(Feed(server_, "fine", 3, 12));
  ASSERT_TRUE(Eventually([&] { return IsAskedToLetGo(); }));
  while (mesh_->Read(&part_)) {
  }
  const grpc::Status ended = mesh_->Finish();
  EXPECT_EQ(ended.error_code(), grpc::StatusCode::RESOURCE_EXHAUSTED) << ended.error_message();
  EXPECT_EQ(ReasonOf(ended), "TOO_MANY_BYTES");
  others_.Release();
  ExpectNothingKept();
}

class InflightStatesNobodyTakes : public InflightStates {
 protected:
  InflightStatesNobodyTakes() : InflightStates(/*to_take_last_s=*/0) {}
};

TEST_F(InflightStatesNobodyTakes, AreReleasedWhenTheMapChanges) {
  TakeAllRoom();
  ASSERT_OK(Feed(server_, "fine", 0, 6));
  EXPECT_TRUE(Eventually([&] { return budget_->used_bytes() == others_.bytes(); }))
      << budget_->used_bytes() << " of " << others_.bytes();
  while (mesh_->Read(&part_)) {
  }
  const grpc::Status ended = mesh_->Finish();
  EXPECT_TRUE(ended.error_code() == grpc::StatusCode::CANCELLED ||
              ended.error_code() == grpc::StatusCode::RESOURCE_EXHAUSTED)
      << ended.error_code() << " " << ended.error_message();
  others_.Release();
  ExpectNothingKept();
}

TEST_F(InflightBytes, ARefusedStreamOfQueriesReadsOnAndHoldsNothingForASilentClient) {
  ByteShare others(budget_.get());
  ASSERT_TRUE(others.Resize(kLimit_bytes));
  grpc::ClientContext context;
  const auto stream = server_.queries->StreamQueries(&context);
  v1::StreamQueriesRequest request;
  v1::QueryPointsRequest& points = *request.mutable_query_points();
  points.set_map("maps/room");
  points.set_packed(true);
  for (int i = 0; i < 3 * 100'000; ++i) points.add_packed_points_m(0.001f * static_cast<float>(i % 997));
  v1::StreamQueriesResponse answer;
  ASSERT_TRUE(stream->Write(request));
  ASSERT_TRUE(stream->Read(&answer));
  EXPECT_EQ(answer.error().code(), static_cast<int>(grpc::StatusCode::RESOURCE_EXHAUSTED));
  EXPECT_EQ(budget_->used_bytes(), others.bytes());

  others.Release();
  ASSERT_TRUE(stream->Write(request));
  ASSERT_TRUE(stream->Read(&answer));
  EXPECT_EQ(answer.query_points().packed().near_surface_size(), 100'000);
  ExpectNothingKept();
  ASSERT_TRUE(others.Resize(kLimit_bytes));
  ASSERT_TRUE(stream->Write(request));
  ASSERT_TRUE(stream->Read(&answer));
  EXPECT_TRUE(answer.has_error());
  others.Release();
  ExpectNothingKept();
  stream->WritesDone();
  EXPECT_OK(stream->Finish());
}

TEST_F(InflightBytes, AFrameThatDoesNotFitIsRefusedAndTheStreamContinues) {
  const std::unique_ptr<MapStore> store = MakeMemoryStore();
  const std::size_t too_few_bytes = DecodedBytes(TestFrame(0));  // the message itself is counted, too
  TestServer server(*store, {}, {.inflight = std::make_shared<ByteBudget>(too_few_bytes)});
  ASSERT_OK(server.Call(&MapStub::CreateMap, CreateRequest("room")));
  Feeder feeder(server, "room");
  for (int i = 0; i < 3; ++i) {
    const auto answer = feeder.Feed(i);
    ASSERT_TRUE(answer) << "the stream goes on";
    EXPECT_EQ(answer->outcome(), v1::IntegrateFramesResponse::REFUSED);
    EXPECT_EQ(answer->error().code(), static_cast<int>(grpc::StatusCode::RESOURCE_EXHAUSTED));
    EXPECT_EQ(ReasonOf(answer->error()), "TOO_MANY_BYTES");
  }
  feeder.HalfClose();
  EXPECT_OK(feeder.Finish());
}

TEST_F(InflightBytes, FramesHaveABudgetOfTheirOwn) {
  ByteShare others(budget_.get());
  ASSERT_TRUE(others.Resize(kLimit_bytes));
  const FeedResult fed = Feed(server_, "room", 3, 20);
  EXPECT_OK(fed);
  ASSERT_EQ(fed.acks.size(), 17u);
  for (const auto& ack : fed.acks)
    EXPECT_EQ(ack.outcome(), v1::IntegrateFramesResponse::FUSED) << ack.error().message();
}

}  // namespace
}  // namespace dhpmap::testing

// SPDX-License-Identifier: BSD-3-Clause
#include "tests/integration/failing_store.h"

#include <gtest/gtest.h>

#include "tests/integration/test_server.h"
#include "tests/support/eventually.h"

namespace dhpmap::testing {
namespace {

class FailingStoreTest : public ::testing::Test {
 protected:
  void SetUp() override { ASSERT_OK(server.Call(&MapStub::CreateMap, CreateRequest("room"))); }

  grpc::Status Rename(const std::string& submap, const std::string& name) {
    v1::UpdateSubmapRequest request;
    request.mutable_submap()->set_name(submap);
    request.mutable_submap()->set_display_name(name);
    return server.Call(&SubmapStub::UpdateSubmap, request).status();
  }

  FailingStore store;
  // Every frame is committed, and retries follow at once, so the test does not wait.
  TestServer server{store, {.publish = {.frames = 1}, .commit = {.frames = 1, .retry_s = 0.01}}};
};

TEST_F(FailingStoreTest, AFullDiskIsReportedAndNothingIsLost) {
  ASSERT_OK(Feed(server, "room", 0, 4));
  store.set_full(true);
  const FeedResult fed = Feed(server, "room", 4, 12);
  EXPECT_EQ(fed.status.error_code(), grpc::RESOURCE_EXHAUSTED) << fed.status.error_message();
  ASSERT_EQ(fed.acks.size(), 8u);
  for (const auto& ack : fed.acks) {
    EXPECT_EQ(ack.error().code(), 0);  // fused nevertheless
    EXPECT_FALSE(ack.committed());
  }
  EXPECT_EQ(store.GetMap("room")->info.num_frames, 4);
  EXPECT_EQ(server.registry().Get("room")->info.num_frames, 12);

  const grpc::Status edit = Rename("maps/room/submaps/1", "one");
  EXPECT_EQ(edit.error_code(), grpc::RESOURCE_EXHAUSTED);
  EXPECT_NE(edit.error_message().find("nothing was changed"), std::string::npos) << edit.error_message();

  store.set_full(false);
  EXPECT_OK(Rename("maps/room/submaps/2", "two"));
  EXPECT_EQ(store.GetMap("room")->info.num_frames, 12);
  const auto stored = store.LoadMap("room");
  EXPECT_NE((*stored)->Find(SubmapId(1))->info().display_name, "one") << "it was refused";
  EXPECT_EQ((*stored)->Find(SubmapId(2))->info().display_name, "two");
}

TEST_F(FailingStoreTest, AcknowledgementsSayThatTheStoreIsBehind) {
  store.set_full(true);
  grpc::ClientContext context;
  const auto stream = server.mapping->IntegrateFrames(&context);
  v1::IntegrateFramesRequest request;
  request.set_map("maps/room");
  *request.mutable_frame() = TestFrame(0);
  EXPECT_TRUE(Eventually([&] {
    v1::IntegrateFramesResponse ack;
    EXPECT_TRUE(stream->Write(request) && stream->Read(&ack));
    return ack.commit_error().code() == grpc::RESOURCE_EXHAUSTED && !ack.commit_error().message().empty();
  }));
  store.set_full(false);
  stream->WritesDone();
  EXPECT_OK(stream->Finish());
}

TEST_F(FailingStoreTest, IsRetriedByTheServerItself) {
  store.set_full(true);
  EXPECT_FALSE(Feed(server, "room", 0, 2).status.ok());
  const int refused = store.num_refused();
  EXPECT_TRUE(Eventually([&] { return store.num_refused() >= refused + 2; }));
  store.set_full(false);
  EXPECT_TRUE(Eventually([&] { return store.GetMap("room")->info.num_frames == 2; }));
}

TEST_F(FailingStoreTest, AFailedCreationOrDeletionChangesNothing) {
  store.set_full(true);
  EXPECT_EQ(server.Call(&MapStub::CreateMap, CreateRequest("hall")).code(), grpc::RESOURCE_EXHAUSTED);
  EXPECT_EQ(server.Call(&MapStub::DeleteMap, "maps/room").code(), grpc::RESOURCE_EXHAUSTED);
  store.set_full(false);
  EXPECT_OK(server.Call(&MapStub::CreateMap, CreateRequest("hall")));
  EXPECT_OK(Feed(server, "room", 0, 1));
}

TEST_F(FailingStoreTest, ShutdownReportsThatTheLastStateIsLost) {
  ASSERT_OK(Feed(server, "room", 0, 1));
  store.set_full(true);
  EXPECT_FALSE(Feed(server, "room", 1, 2).status.ok());
  EXPECT_EQ(server.Stop().code(), StatusCode::kResourceExhausted);
}

}  // namespace
}  // namespace dhpmap::testing

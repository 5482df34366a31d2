// SPDX-License-Identifier: BSD-3-Clause
// Answers to clients that stream frames: how far the frames are stored, and where a session resumes.
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <vector>

#include "storage/sqlite_store.h"
#include "tests/integration/busy_writer.h"
#include "tests/integration/failing_store.h"
#include "tests/integration/feeder.h"
#include "tests/integration/tcp_proxy.h"
#include "tests/integration/test_store.h"
#include "tests/support/eventually.h"
#include "tests/support/status_reason.h"

namespace dhpmap::testing {
namespace {

void Create(TestServer& server, const std::string& map_id) {
  ASSERT_OK(server.Call(&MapStub::CreateMap, CreateRequest(map_id)));
}

grpc::Status Delete(TestServer& server, const std::string& map_id) {
  return server.Call(&MapStub::DeleteMap, "maps/" + map_id).status();
}

/// Only the full sync at a stream's end stores anything.
const OpenMapOptions kLazy{.publish = {.frames = 1}, .commit = {.frames = 1000, .delay_s = 1000}};

TEST(Feeds, AcknowledgementsClaimOnlyStoredFrames) {
  FailingStore store;
  TestServer server(store, {.publish = {.frames = 1}, .commit = {.frames = 2, .retry_s = 0.01}});
  Create(server, "room");
  Feeder feeder(server, "room");
  std::int64_t told = -1;
  const auto check = [&](const Feeder::Ack& ack) {
    const std::int64_t committed = ack.has_committed_sequence() ? ack.committed_sequence() : -1;
    EXPECT_GE(committed, told) << "it never falls";
    EXPECT_LT(committed, store.GetMap("room")->info.num_frames);
    told = committed;
  };
  for (int i = 0; i < 12; ++i) {
    store.set_full(i >= 6);
    const auto ack = feeder.Feed(i);
    ASSERT_TRUE(ack);
    EXPECT_EQ(ack->outcome(), v1::IntegrateFramesResponse::FUSED);
    check(*ack);
  }
  EXPECT_LE(told, 6);
  store.set_full(false);
  for (int i = 12; told < 11; ++i) {
    const auto ack = feeder.Feed(i);
    ASSERT_TRUE(ack);
    check(*ack);
  }
  feeder.HalfClose();
  EXPECT_OK(feeder.Finish());
}

TEST(Feeds, TheLastFramesAcknowledgementComesWhenAllIsStored) {
  const auto store = MakeTestStore();
  TestServer server(*store, kLazy, {.max_frames_in_flight = 8});
  Create(server, "room");
  Feeder feeder(server, "room");
  ASSERT_FALSE(feeder.Feed(0)->has_committed_sequence());
  {
    const BusyWriter busy(**server.registry().GetOpen("room"));
    for (int i = 1; i < 4; ++i) ASSERT_TRUE(feeder.Send(i, i, /*is_last=*/i == 3));
    // Meanwhile other calls run, so the server has long seen the end of the stream.
    for (int i = 0; i < 100; ++i) {
      ASSERT_OK(server.Call(&MapStub::ListMaps));
    }
  }
  int num_answers = 0;
  Feeder::Ack last;
  while (const auto ack = feeder.Read()) last = *ack, ++num_answers;
  EXPECT_OK(feeder.Finish());
  EXPECT_EQ(num_answers, 3) << "one for each frame";
  EXPECT_EQ(last.sequence(), 3);
  EXPECT_EQ(last.outcome(), v1::IntegrateFramesResponse::FUSED);
  EXPECT_GT(last.num_points(), 1000);
  EXPECT_TRUE(last.committed());
  EXPECT_EQ(last.committed_sequence(), 3);
  EXPECT_EQ(store->GetMap("room")->info.num_frames, 4);
}

TEST(Feeds, IfTheLastCommitFailsTheLastFrameIsAcknowledgedAndTheStreamFails) {
  FailingStore store;
  TestServer server(store, kLazy);
  Create(server, "room");
  for (int round = 0; round < 5; ++round) {
    store.set_full(true);
    Feeder feeder(server, "room");
    ASSERT_TRUE(feeder.Send(7, round, /*is_last=*/true));
    const auto ack = feeder.Read();
    ASSERT_TRUE(ack);
    EXPECT_EQ(ack->sequence(), 7);
    EXPECT_FALSE(ack->has_committed_sequence());
    EXPECT_FALSE(ack->committed());
    EXPECT_EQ(feeder.Finish().error_code(), grpc::RESOURCE_EXHAUSTED);
    EXPECT_FALSE(feeder.last()) << "no second answer";
    store.set_full(false);
  }
}

/// A client that counts answers calls Finish at once. gRPC would wait for ever if another answer were unread.
TEST(Feeds, AnUnnamedStreamThatHalfClosesLateEndsWithoutAnotherAnswerOnceAllIsStored) {
  const auto store = MakeTestStore();
  TestServer server(*store, kLazy);
  Create(server, "room");
  grpc::ClientContext context;
  context.set_deadline(std::chrono::system_clock::now() + kPatience);
  const auto stream = server.mapping->IntegrateFrames(&context);
  for (int i = 0; i < 3; ++i) {
    v1::IntegrateFramesRequest request;
    request.set_map("maps/room");
    request.set_sequence(i);
    *request.mutable_frame() = TestFrame(i);
    ASSERT_TRUE(stream->Write(request));
    v1::IntegrateFramesResponse ack;
    ASSERT_TRUE(stream->Read(&ack));
    EXPECT_EQ(ack.outcome(), v1::IntegrateFramesResponse::FUSED);
    EXPECT_FALSE(ack.has_committed_sequence());
  }
  EXPECT_EQ(store->GetMap("room")->info.num_frames, 0);
  stream->WritesDone();
  const grpc::Status status = stream->Finish();
  EXPECT_OK(status);
  EXPECT_EQ(store->GetMap("room")->info.num_frames, 3);
}

TEST(Feeds, ASessionsLastAnswerBelongsToNoFrame) {
  const auto store = MakeTestStore();
  TestServer server(*store, kLazy);
  Create(server, "room");
  Feeder feeder(server, "room", {.session = "robot-7"});
  for (int i = 3; i < 6; ++i) {
    const auto ack = feeder.Feed(i);
    ASSERT_TRUE(ack);
    EXPECT_EQ(ack->outcome(), v1::IntegrateFramesResponse::FUSED);
    EXPECT_FALSE(ack->has_committed_sequence());
  }
  feeder.HalfClose();
  ASSERT_OK(feeder.Finish());
  ASSERT_TRUE(feeder.last());
  EXPECT_EQ(feeder.last()->outcome(), v1::IntegrateFramesResponse::FRAME_OUTCOME_UNSPECIFIED);
  EXPECT_EQ(feeder.last()->committed_sequence(), 5);
  EXPECT_TRUE(feeder.last()->committed());
  EXPECT_EQ(store->GetMap("room")->info.num_frames, 3);
}

TEST(Feeds, ASessionsClientLearnsWhereToResumeAndMayResendFrames) {
  const auto store = MakeTestStore();
  TestServer server(*store, kLazy);
  Create(server, "room");
  {
    Feeder first(server, "room", {.session = "robot"});
    const auto greeting = first.Greet();
    ASSERT_TRUE(greeting);
    EXPECT_FALSE(greeting->has_committed_sequence()) << "a new session";
    EXPECT_EQ(greeting->outcome(), v1::IntegrateFramesResponse::FRAME_OUTCOME_UNSPECIFIED);
    EXPECT_EQ(greeting->error().code(), 0);
    for (int i = 0; i < 4; ++i) ASSERT_TRUE(first.Feed(i));
    first.HalfClose();
    ASSERT_OK(first.Finish());
  }
  Feeder second(server, "room", {.session = "robot"});
  EXPECT_EQ(second.Greet()->committed_sequence(), 3);
  for (const int sequence : {3, 0, 2}) {
    const auto ack = second.Feed(sequence);
    ASSERT_TRUE(ack);
    EXPECT_EQ(ack->outcome(), v1::IntegrateFramesResponse::DUPLICATE) << sequence;
    EXPECT_EQ(ack->error().code(), 0);
    EXPECT_EQ(ack->sequence(), sequence);
    EXPECT_EQ(ack->num_points(), 0);
  }
  EXPECT_EQ(second.Feed(4)->outcome(), v1::IntegrateFramesResponse::FUSED);
  second.HalfClose();
  ASSERT_OK(second.Finish());
  EXPECT_EQ(store->GetMap("room")->info.num_frames, 5);

  // Another session has its own numbers; streams without a session are never deduplicated.
  Feeder other(server, "room", {.session = "other"});
  EXPECT_EQ(other.Feed(0)->outcome(), v1::IntegrateFramesResponse::FUSED);
  other.HalfClose();
  ASSERT_OK(other.Finish());
  for (int i = 0; i < 2; ++i) ASSERT_OK(Feed(server, "room", 0, 2));
  EXPECT_EQ(store->GetMap("room")->info.num_frames, 10);
}

TEST(Feeds, AnAcceptedUnstoredFrameIsADuplicateAndReportedAsStoredLater) {
  FailingStore store;
  TestServer server(store, {.publish = {.frames = 1}, .commit = {.frames = 1, .retry_s = 0.01}});
  Create(server, "room");
  store.set_full(true);
  {
    Feeder first(server, "room", {.session = "robot"});
    for (int i = 0; i < 3; ++i) ASSERT_FALSE(first.Feed(i)->has_committed_sequence());
  }  // the connection is lost
  Feeder second(server, "room", {.session = "robot"});
  const auto greeting = second.Greet();
  ASSERT_TRUE(greeting) << "its own old stream is not in its way";
  EXPECT_FALSE(greeting->has_committed_sequence());
  EXPECT_EQ(second.Feed(1)->outcome(), v1::IntegrateFramesResponse::DUPLICATE);
  EXPECT_FALSE(second.Feed(2)->has_committed_sequence());
  store.set_full(false);
  second.HalfClose();
  ASSERT_OK(second.Finish());
  EXPECT_EQ(second.last()->committed_sequence(), 2);
  EXPECT_EQ(store.GetMap("room")->info.num_frames, 3);
}

TEST(Feeds, SessionNamesAreValidAndDoNotChangeWithinAStream) {
  const auto store = MakeTestStore();
  TestServer server(*store);
  Create(server, "room");
  for (const std::string& bad : {std::string("a b"), std::string(65, 'x'), std::string("a/b"), std::string("a:b")}) {
    Feeder feeder(server, "room", {.session = bad});
    EXPECT_FALSE(feeder.Feed(0));
    const grpc::Status status = feeder.Finish();
    EXPECT_EQ(status.error_code(), grpc::INVALID_ARGUMENT);
    EXPECT_EQ(ReasonOf(status), "BAD_SESSION");
  }
  for (const char* first : {"robot", ""}) {
    grpc::ClientContext context;
    const auto stream = server.mapping->IntegrateFrames(&context);
    v1::IntegrateFramesRequest request;
    request.set_map("maps/room");
    *request.mutable_frame() = TestFrame(0);
    for (const char* session : {first, "", "another"}) {
      request.set_session(session);
      request.set_sequence(request.sequence() + 1);
      stream->Write(request);
    }
    int num_answers = 0;
    for (v1::IntegrateFramesResponse ack; stream->Read(&ack);) ++num_answers;
    EXPECT_EQ(num_answers, 2);
    EXPECT_EQ(ReasonOf(stream->Finish()), "BAD_SESSION");
  }
  // Only the first message of a session may lack a frame.
  Feeder unnamed(server, "room");
  const auto ack = unnamed.Greet();
  ASSERT_TRUE(ack);
  EXPECT_EQ(ack->outcome(), v1::IntegrateFramesResponse::REFUSED);
  EXPECT_EQ(ReasonOf(ack->error()), "BAD_FRAME");
}

TEST(Feeds, ATakeoverFeedsAtOnceAndTheOtherStreamEndsWithTheReason) {
  const auto store = MakeTestStore();
  TestServer server(*store, {.feeds = {.idle_s = 1000}}, {.max_frames_in_flight = 8});
  Create(server, "room");
  Feeder first(server, "room", {.session = "first"});
  ASSERT_EQ(first.Feed(0)->outcome(), v1::IntegrateFramesResponse::FUSED);
  {
    Feeder polite(server, "room");
    EXPECT_FALSE(polite.Feed(0));
    const grpc::Status refused = polite.Finish();
    EXPECT_EQ(refused.error_code(), grpc::ABORTED);
    EXPECT_EQ(ReasonOf(refused), "MAP_IS_FED");
  }
  const auto session = *server.registry().GetOpen("room");
  {
    const BusyWriter busy(*session);
    for (int i = 1; i < 4; ++i) ASSERT_TRUE(first.Send(i, i));
    const auto feed = session->BeginFeed({.session = "second", .take_over = true});
    ASSERT_OK(feed);
    session->EndFeed(*feed);
  }
  Feeder second(server, "room", {.session = "second", .take_over = true});
  EXPECT_EQ(second.Feed(10)->outcome(), v1::IntegrateFramesResponse::FUSED);

  while (const auto ack = first.Read()) {
    EXPECT_EQ(ack->outcome(), v1::IntegrateFramesResponse::REFUSED) << "what waited is not fused";
    EXPECT_EQ(ack->error().code(), grpc::ABORTED);
    EXPECT_EQ(ReasonOf(ack->error()), "FEED_TAKEN_OVER");
  }
  const grpc::Status status = first.Finish();
  EXPECT_EQ(status.error_code(), grpc::ABORTED) << status.error_message();
  EXPECT_EQ(ReasonOf(status), "FEED_TAKEN_OVER");
  EXPECT_EQ(second.Feed(11)->outcome(), v1::IntegrateFramesResponse::FUSED);
  second.HalfClose();
  EXPECT_OK(second.Finish());
  const MapInfo stored = store->GetMap("room")->info;
  EXPECT_EQ(stored.num_frames, 3);
  EXPECT_EQ(stored.sessions.LastOf("first"), 0);
  EXPECT_EQ(stored.sessions.LastOf("second"), 11);
}

TEST(Feeds, AnIdleFeederIsReplacedByAnother) {
  const auto store = MakeTestStore();
  TestServer server(*store, {.feeds = {.idle_s = 0}});
  Create(server, "room");
  Feeder first(server, "room");
  ASSERT_TRUE(first.Feed(0));
  Feeder second(server, "room");
  EXPECT_EQ(second.Feed(1)->outcome(), v1::IntegrateFramesResponse::FUSED);
  const grpc::Status status = first.Finish();
  EXPECT_EQ(status.error_code(), grpc::ABORTED);
  EXPECT_EQ(ReasonOf(status), "FEED_IDLE");
  second.HalfClose();
  EXPECT_OK(second.Finish());
  EXPECT_EQ(store->GetMap("room")->info.num_frames, 2);
}

TEST(Feeds, AMapWhoseFeederIsIdleCanBeDeleted) {
  const auto store = MakeTestStore();
  TestServer server(*store, {.feeds = {.idle_s = 0}});
  Create(server, "room");
  Feeder feeder(server, "room");
  ASSERT_TRUE(feeder.Feed(0));
  const grpc::Status deleted = Delete(server, "room");
  EXPECT_OK(deleted);
  const grpc::Status status = feeder.Finish();
  EXPECT_EQ(status.error_code(), grpc::ABORTED);
  EXPECT_EQ(ReasonOf(status), "FEED_IDLE");
  EXPECT_TRUE(store->ListMaps()->empty());
}

/// gRPC drops a peer that has not answered within a second. The machine needs a second of spare time for this test.
TEST(FeedsClock, AFrozenPeerIsDroppedAlthoughItsConnectionIsOpen) {
  const auto store = MakeTestStore();
  TestServer server(*store, {.feeds = {.idle_s = 86'400}}, {.keepalive_s = 1});
  Create(server, "room");
  TcpProxy proxy(server.grpc().port());
  const auto channel = grpc::CreateChannel(proxy.address(), grpc::InsecureChannelCredentials());
  const auto mapping = v1::MappingService::NewStub(channel);
  Feeder frozen(*mapping, "room", {.session = "frozen"});
  ASSERT_TRUE(frozen.Feed(0));
  // A peer that is silent but alive keeps its place: it answers pings.
  const int num_answers = proxy.num_answers();
  ASSERT_TRUE(Eventually([&] { return proxy.num_answers() >= num_answers + 3; }));
  EXPECT_EQ(Feed(server, "room", 0, 1).status.error_code(), grpc::ABORTED);
  EXPECT_TRUE(frozen.Feed(1));

  proxy.Freeze();
  grpc::StatusCode code = grpc::ABORTED;
  EXPECT_TRUE(Eventually([&] {
    code = Feed(server, "room", 2, 3).status.error_code();
    return code != grpc::ABORTED;
  }));
  EXPECT_EQ(code, grpc::OK);
  EXPECT_EQ(store->GetMap("room")->info.num_frames, 3);
  EXPECT_EQ(store->GetMap("room")->info.sessions.LastOf("frozen"), 1);
  frozen.Cancel();
}

TEST(Feeds, AStreamOfOneMessageIsAnsweredOnceStoredOrWithItsError) {
  const auto store = MakeTestStore();
  TestServer server(*store, kLazy, {.max_frames_in_flight = 1});
  Create(server, "room");
  const auto send = [&](const v1::Frame& frame, std::vector<v1::IntegrateFramesResponse>& answers) {
    grpc::ClientContext context;
    context.AddMetadata("dhpmap-one-message", "1");
    const auto stream = server.mapping->IntegrateFrames(&context);
    v1::IntegrateFramesRequest request;
    request.set_map("maps/room");
    request.set_sequence(5);
    *request.mutable_frame() = frame;
    stream->Write(request);
    stream->WritesDone();
    for (v1::IntegrateFramesResponse answer; stream->Read(&answer);) answers.push_back(answer);
    return stream->Finish();
  };
  std::vector<v1::IntegrateFramesResponse> answers;
  ASSERT_OK(send(TestFrame(0), answers));
  ASSERT_EQ(answers.size(), 1u);
  EXPECT_EQ(answers[0].outcome(), v1::IntegrateFramesResponse::FUSED);
  EXPECT_EQ(answers[0].sequence(), 5);
  EXPECT_GT(answers[0].num_points(), 1000);
  EXPECT_TRUE(answers[0].committed());
  EXPECT_EQ(answers[0].committed_sequence(), 5);
  EXPECT_EQ(store->GetMap("room")->info.num_frames, 1);

  v1::Frame bad = TestFrame(1);
  bad.set_map_from_sensor_matrix(3, std::nan(""));
  answers.clear();
  const grpc::Status status = send(bad, answers);
  EXPECT_EQ(status.error_code(), grpc::INVALID_ARGUMENT);
  EXPECT_EQ(ReasonOf(status), "BAD_FRAME");
  EXPECT_NE(status.error_details().find("map_from_sensor"), std::string::npos) << "it names the field";
  EXPECT_TRUE(answers.empty());
  EXPECT_EQ(send({}, answers).error_code(), grpc::INVALID_ARGUMENT);
  EXPECT_EQ(store->GetMap("room")->info.num_frames, 1);
}

TEST(Feeds, SessionsSurviveRestartsOfTheServer) {
  const TempDir dir;
  const std::string path = (dir.path() / "maps.db").string();
  for (int run = 0; run < 3; ++run) {
    const auto store = OpenSqliteStore(path);
    ASSERT_OK(store);
    TestServer server(**store);
    if (run == 0) Create(server, "room");
    Feeder feeder(server, "room", {.session = "robot"});
    const auto greeting = feeder.Greet();
    ASSERT_TRUE(greeting);
    if (run > 0) {
      EXPECT_EQ(greeting->committed_sequence(), 2 * run - 1);
    }
    if (run > 0) {
      EXPECT_EQ(feeder.Feed(2 * run - 1)->outcome(), v1::IntegrateFramesResponse::DUPLICATE);
    }
    for (int i = 0; i < 2; ++i) EXPECT_EQ(feeder.Feed(2 * run + i)->outcome(), v1::IntegrateFramesResponse::FUSED);
    feeder.HalfClose();
    ASSERT_OK(feeder.Finish());
    EXPECT_EQ((*store)->GetMap("room")->info.num_frames, 2 * run + 2);
  }
}

}  // namespace
}  // namespace dhpmap::testing

// SPDX-License-Identifier: BSD-3-Clause
// Several robots feed one map; a client lists their sessions and ends one; the recorded frames are replayed.
#include <google/protobuf/util/time_util.h>
#include <gtest/gtest.h>

#include <atomic>
#include <filesystem>
#include <fstream>
#include <future>
#include <iterator>
#include <map>
#include <string>
#include <vector>

#include "clients/cli/replay_streams.h"
#include "proto/types/record_file.h"
#include "server/record/map_recorder.h"
#include "tests/integration/busy_writer.h"
#include "tests/integration/feeder.h"
#include "tests/integration/test_store.h"
#include "tests/support/eventually.h"
#include "tests/support/map_equality.h"
#include "tests/support/status_reason.h"

namespace dhpmap::testing {
namespace {

void CreateMap(TestServer& server, const v1::CreateMapRequest& request) {
  ASSERT_OK(server.Call(&MapStub::CreateMap, request));
}

std::map<std::string, v1::FeedSession> SessionsOf(TestServer& server, const std::string& map_id) {
  const auto response = server.Call(&MappingStub::ListSessions, "maps/" + map_id).value();
  std::map<std::string, v1::FeedSession> sessions;
  for (const v1::FeedSession& of : response.sessions()) sessions[of.session()] = of;
  return sessions;
}

grpc::Status End(TestServer& server, const std::string& map_id, const std::string& session) {
  v1::EndSessionRequest request;
  request.set_map("maps/" + map_id);
  request.set_session(session);
  return server.Call(&MappingStub::EndSession, request).status();
}

std::shared_ptr<const MapSnapshot> StateOf(TestServer& server, const std::string& map_id) {
  return (*server.registry().GetOpen(map_id))->View()->shared_snapshot();
}

TEST(Sessions, SeveralFeedOneMapAndEachResumesAfterItsOwnStoredFrames) {
  const auto store = MakeTestStore();
  TestServer server(*store);
  CreateMap(server, CreateRequest("room"));
  {
    Feeder a(server, "room", {.session = "a"}), b(server, "room", {.session = "b"});
    for (int i = 0; i < 4; ++i) {
      EXPECT_EQ(a.Feed(i)->outcome(), v1::IntegrateFramesResponse::FUSED);
      EXPECT_EQ(b.Feed(100 + i)->outcome(), v1::IntegrateFramesResponse::FUSED);
    }
    a.HalfClose();
    ASSERT_OK(a.Finish());
    EXPECT_EQ(a.last()->committed_sequence(), 3);
    EXPECT_EQ(b.Feed(104)->outcome(), v1::IntegrateFramesResponse::FUSED) << "the end of one is not that of the other";
    b.HalfClose();
    ASSERT_OK(b.Finish());
    EXPECT_EQ(b.last()->committed_sequence(), 104);
  }
  EXPECT_EQ(store->GetMap("room")->info.num_frames, 9);
  Feeder a(server, "room", {.session = "a"}), b(server, "room", {.session = "b"});
  EXPECT_EQ(a.Greet()->committed_sequence(), 3);
  EXPECT_EQ(b.Greet()->committed_sequence(), 104);
  EXPECT_EQ(a.Feed(3)->outcome(), v1::IntegrateFramesResponse::DUPLICATE);
  EXPECT_EQ(a.Feed(4)->outcome(), v1::IntegrateFramesResponse::FUSED) << "numbers of others do not count";
  Feeder again(server, "room", {.session = "b"});
  EXPECT_EQ(again.Feed(105)->outcome(), v1::IntegrateFramesResponse::FUSED);
  EXPECT_EQ(ReasonOf(b.Finish()), "FEED_TAKEN_OVER") << "the same robot, over another connection";
  EXPECT_EQ(a.Feed(5)->outcome(), v1::IntegrateFramesResponse::FUSED);
}

/// However much one robot sends, another's frame waits for at most its own stream's frames in flight.
TEST(Sessions, OneRobotCannotStarveAnother) {
  constexpr int kInFlight = 3, kFlood = 24;
  const auto store = MakeTestStore();
  TestServer server(*store, {.publish = {.frames = 1}}, {.max_frames_in_flight = kInFlight});
  CreateMap(server, CreateRequest("room"));
  Feeder flood(server, "room", {.session = "flood"}), other(server, "room", {.session = "other"});
  ASSERT_TRUE(flood.Feed(0) && other.Feed(0));
  const std::int64_t message_bytes = SessionsOf(server, "room")["other"].num_bytes();
  // Messages that have reached the writer or its queue.
  const auto num_come = [&](const std::string& session) {
    return (SessionsOf(server, "room")[session].num_bytes() + message_bytes / 2) / message_bytes;
  };
  const std::int64_t revision = StateOf(server, "room")->revision();
  std::future<void> reader;
  {
    const BusyWriter held(**server.registry().GetOpen("room"));
    auto sent = std::async(std::launch::async, [&] {
      for (int i = 1; i <= kFlood; ++i) ASSERT_TRUE(flood.Send(i, i % 8));
    });
    ASSERT_TRUE(Eventually([&] { return num_come("flood") == 1 + kInFlight; })) << "all that it may have on the way";
    ASSERT_TRUE(other.Send(1, 1));
    ASSERT_TRUE(Eventually([&] { return num_come("other") == 2; }));
    EXPECT_EQ(num_come("flood"), 1 + kInFlight);
    reader = std::async(std::launch::async, [&, sent = std::move(sent)]() mutable {
      for (int i = 0; i < kFlood; ++i) ASSERT_TRUE(flood.Read());
      sent.get();
    });
  }
  const auto ack = other.Read();
  reader.get();
  ASSERT_TRUE(ack);
  EXPECT_EQ(ack->outcome(), v1::IntegrateFramesResponse::FUSED);
  EXPECT_LE(ack->revision() - revision, kInFlight + 1 + 1) << "one for the edit that held the writer";
}

TEST(Sessions, AreListedWithTheirFrames) {
  const auto store = MakeTestStore();
  constexpr std::int64_t kTick_ns = 1'000'000, kBegin_ns = std::int64_t{1} << 60;
  std::atomic<std::int64_t> now_ns = kBegin_ns;  // else old frames would not count in the rate
  TestServer server(*store,
                    {.commit = {.frames = 1}, .feeds = {.idle_s = 1e6}, .now_ns = [&] { return now_ns += kTick_ns; }});
  CreateMap(server, CreateRequest("room"));
  EXPECT_TRUE(SessionsOf(server, "room").empty());
  Feeder a(server, "room", {.session = "a"}), b(server, "room", {.session = "b"});
  std::int64_t num_points = 0;
  for (int i = 0; i < 3; ++i) num_points += a.Feed(i)->num_points();
  EXPECT_EQ(a.Feed(1)->outcome(), v1::IntegrateFramesResponse::DUPLICATE);
  EXPECT_EQ(b.Greet()->outcome(), v1::IntegrateFramesResponse::FRAME_OUTCOME_UNSPECIFIED);
  v1::IntegrateFramesRequest message;
  *message.mutable_frame() = TestFrame(0);

  auto sessions = SessionsOf(server, "room");
  ASSERT_EQ(sessions.size(), 2u);
  EXPECT_TRUE(sessions["a"].feeding());
  EXPECT_GT(sessions["a"].lease_s(), 9e5);
  EXPECT_EQ(sessions["a"].accepted_sequence(), 2);
  EXPECT_EQ(sessions["a"].num_frames(), 3);
  EXPECT_EQ(sessions["a"].num_duplicates(), 1);
  EXPECT_EQ(sessions["a"].num_points(), num_points);
  EXPECT_GT(sessions["a"].num_bytes(), static_cast<std::int64_t>(4 * message.ByteSizeLong()) - 100);
  EXPECT_GT(sessions["a"].frames_per_s(), 0);
  EXPECT_GT(google::protobuf::util::TimeUtil::TimestampToNanoseconds(sessions["a"].last_message_time()), kBegin_ns);
  EXPECT_TRUE(sessions["b"].feeding());
  EXPECT_FALSE(sessions["b"].has_accepted_sequence());
  EXPECT_EQ(sessions["b"].num_frames(), 0);

  a.HalfClose();
  ASSERT_OK(a.Finish());
  sessions = SessionsOf(server, "room");
  EXPECT_FALSE(sessions["a"].feeding());
  EXPECT_EQ(sessions["a"].committed_sequence(), 2);
  EXPECT_EQ(sessions["a"].num_frames(), 3);
}

TEST(Sessions, EndingOneRefusesItsQueuedFrames) {
  const auto store = MakeTestStore();
  TestServer server(*store, {.publish = {.frames = 1}, .feeds = {.idle_s = 1000}}, {.max_frames_in_flight = 8});
  CreateMap(server, CreateRequest("room"));
  Feeder a(server, "room", {.session = "a"}), b(server, "room", {.session = "b"});
  ASSERT_TRUE(a.Feed(0) && b.Feed(0));
  {
    const BusyWriter held(**server.registry().GetOpen("room"));
    for (int i = 1; i < 4; ++i) ASSERT_TRUE(a.Send(i, i));
    ASSERT_OK(End(server, "room", "a"));
  }
  while (const auto ack = a.Read()) {
    EXPECT_EQ(ack->outcome(), v1::IntegrateFramesResponse::REFUSED);
    EXPECT_EQ(ReasonOf(ack->error()), "SESSION_ENDED");
  }
  const grpc::Status status = a.Finish();
  EXPECT_EQ(status.error_code(), grpc::ABORTED);
  EXPECT_EQ(ReasonOf(status), "SESSION_ENDED");
  EXPECT_EQ(b.Feed(1)->outcome(), v1::IntegrateFramesResponse::FUSED);
  EXPECT_EQ(ReasonOf(End(server, "room", "a")), "SESSION_NOT_FOUND");
  EXPECT_EQ(ReasonOf(End(server, "nowhere", "a")), "MAP_NOT_FOUND");
  Feeder again(server, "room", {.session = "a"});
  EXPECT_EQ(again.Feed(1)->outcome(), v1::IntegrateFramesResponse::FUSED) << "it may begin again, after what was taken";
  EXPECT_EQ(StateOf(server, "room")->info().sessions.LastOf("a"), 1);
}

/// Two robots see the room in turns, one sees it alone: the same objects, each once, and nearly the same surface.
TEST(Sessions, TwoRobotsMakeTheSameMapAsOne) {
  constexpr int kNumFrames = 16;
  const auto store = MakeTestStore();
  TestServer server(*store, {.mapping = {.refinement_timing = RefinementTiming::kReproducible}});
  for (const char* name : {"one", "two"}) CreateMap(server, CreateRequest(name));
  {
    Feeder only(server, "one", {.session = "a"});
    for (int i = 0; i < kNumFrames; ++i) ASSERT_EQ(only.Feed(i)->outcome(), v1::IntegrateFramesResponse::FUSED);
    Feeder a(server, "two", {.session = "a"}), b(server, "two", {.session = "b"});
    for (int i = 0; i < kNumFrames; i += 2) {
      ASSERT_EQ(a.Feed(i)->outcome(), v1::IntegrateFramesResponse::FUSED);
      ASSERT_EQ(b.Feed(i + 1)->outcome(), v1::IntegrateFramesResponse::FUSED);
    }
    for (Feeder* feeder : {&only, &a, &b}) {
      feeder->HalfClose();
      ASSERT_OK(feeder->Finish());
    }
  }
  const auto one = StateOf(server, "one"), two = StateOf(server, "two");
  ASSERT_EQ(one->submaps().size(), two->submaps().size());
  for (std::size_t i = 0; i < one->submaps().size(); ++i) {
    const Submap &left = *one->submaps()[i], &right = *two->submaps()[i];
    EXPECT_EQ(left.info().class_id, right.info().class_id);
    EXPECT_EQ(left.info().num_frames_observed, right.info().num_frames_observed);
    EXPECT_EQ(left.blocks().size(), right.blocks().size());
    EXPECT_EQ(left.info().class_counts, right.info().class_counts) << "the same frames in the same order";
  }
}

TEST(Sessions, FinishingIsReportedByAWatchAndCanBeCancelled) {
  const auto store = MakeTestStore();
  TestServer server(*store);
  CreateMap(server, CreateRequest("room"));
  ASSERT_OK(Feed(server, "room", 0, 3));
  v1::WatchMapRequest request;
  request.set_map("maps/room");
  request.set_progress_interval_s(300);
  grpc::ClientContext watching;
  const auto watch = server.watches->WatchMap(&watching, request);
  v1::WatchMapResponse message;
  ASSERT_TRUE(watch->Read(&message));
  EXPECT_FALSE(message.progress().has_finishing());

  grpc::ClientContext finishing;
  std::future<grpc::Status> finished;
  {
    const BusyWriter held(**server.registry().GetOpen("room"));
    finished = std::async(std::launch::async, [&] {
      v1::FinishMappingRequest finish;
      finish.set_map("maps/room");
      v1::FinishMappingResponse response;
      return server.mapping->FinishMapping(&finishing, finish, &response);
    });
    double elapsed_s = -1;
    for (int told = 0; told < 2;) {
      ASSERT_TRUE(watch->Read(&message));
      if (!message.progress().has_finishing()) continue;
      EXPECT_EQ(message.progress().finishing().stage(), v1::FinishProgress::WAITING);
      EXPECT_GT(message.progress().finishing().elapsed_s(), elapsed_s);
      elapsed_s = message.progress().finishing().elapsed_s();
      ++told;
    }
    finishing.TryCancel();
    EXPECT_EQ(finished.get().error_code(), grpc::CANCELLED);
    // The client learns of the end at once. The writer is held until the server has noticed, or it might finish before.
    do {
      ASSERT_TRUE(watch->Read(&message));
    } while (!message.has_progress() || message.progress().has_finishing());
  }
  const auto things = StateOf(server, "room");
  for (const auto& submap : things->submaps()) {
    if (submap->info().panoptic != Panoptic::kThing) continue;
    EXPECT_EQ(submap->info().activity, Activity::kActive);
  }
  watching.TryCancel();
}

class RecordedSessions : public ::testing::Test {
 protected:
  /// Feeds the map 'room' of a recording server; the record is one file.
  template <typename Use>
  std::shared_ptr<const MapSnapshot> Record(int num_threads, Use&& use, std::int64_t max_bytes = 1 << 30) {
    const auto store = MakeTestStore();
    records_ = RecordDir::Open((dir_.path() / "records").string(), max_bytes).value();
    TestServer server(*store,
                      {.mapping = {.num_threads = num_threads, .refinement_timing = RefinementTiming::kReproducible},
                       .publish = {.frames = 1},
                       .make_recorder = [this](const MapInfo& map) {
                         return RecordMap(map, *records_, {.is_reproducible = true, .on_stopped = [this](auto why) {
                                                             stopped_.push_back(why);
                                                           }});
                       }});
    auto request = CreateRequest("room");
    request.mutable_config()->mutable_refinement()->set_every_frames(5);
    CreateMap(server, request);
    use(server);
    auto state = StateOf(server, "room");
    EXPECT_OK(server.Stop());
    return state;
  }
  std::string File() const {
    std::vector<std::string> files;
    for (const auto& entry : std::filesystem::directory_iterator(dir_.path() / "records"))
      files.push_back(entry.path());
    EXPECT_EQ(files.size(), 1u);
    return files.at(0);
  }
  /// Replays the record into another server; returns the resulting map.
  std::shared_ptr<const MapSnapshot> ReplayInto(TestServer& server) {
    auto reader = std::move(RecordReader::Open(File())).value();
    v1::CreateMapRequest request;
    request.set_map_id("again");
    *request.mutable_config() = reader.start().map().config();
    *request.mutable_label_classes() = reader.start().map().label_classes();
    CreateMap(server, request);
    ReplayStreams streams(client::Caller::Over(server.channel()), "maps/again",
                          [](const v1::IntegrateFramesResponse& answer) {
                            EXPECT_EQ(answer.outcome(), v1::IntegrateFramesResponse::FUSED) << answer.error().message();
                          });
    for (auto record = reader.Next().value(); record; record = reader.Next().value()) {
      if (!record->has_frame()) continue;
      v1::IntegrateFramesRequest frame;
      EXPECT_TRUE(frame.ParseFromString(record->frame().request()));
      EXPECT_OK(streams.Send(record->frame().session(), record->frame().sequence(), frame));
    }
    EXPECT_OK(streams.Close());
    return StateOf(server, "again");
  }

  TempDir dir_;
  std::unique_ptr<RecordDir> records_;
  std::vector<std::string> stopped_;
};

/// Sessions and unnamed streams in turns, one of them with persistent ids.
void FeedInTurns(TestServer& server) {
  for (int round = 0; round < 3; ++round) {
    Feeder a(server, "room", {.session = "a"}), b(server, "room", {.session = "b"});
    for (int i = 0; i < 3; ++i) {
      ASSERT_EQ(a.Feed(10 * round + i)->outcome(), v1::IntegrateFramesResponse::FUSED);
      if (i == 1) continue;
      ASSERT_EQ(b.Feed(10 * round + 5 + i)->outcome(), v1::IntegrateFramesResponse::FUSED);
    }
    for (Feeder* feeder : {&a, &b}) {
      feeder->HalfClose();
      ASSERT_OK(feeder->Finish());
    }
    Feeder unnamed(server, "room");
    ASSERT_EQ(unnamed.Feed(round)->outcome(), v1::IntegrateFramesResponse::FUSED);
    unnamed.HalfClose();
    ASSERT_OK(unnamed.Finish());
  }
}

TEST_F(RecordedSessions, ReplayingMakesTheSameMapForAnyNumberOfThreads) {
  const auto original = Record(1, FeedInTurns);
  EXPECT_EQ(original->info().num_frames, 18);
  EXPECT_TRUE(stopped_.empty());
  for (const int num_threads : {1, 3}) {
    const auto store = MakeTestStore();
    TestServer server(*store,
                      {.mapping = {.num_threads = num_threads, .refinement_timing = RefinementTiming::kReproducible}});
    EXPECT_TRUE(MapsAreEqual(*original, *ReplayInto(server), 0, 0)) << num_threads;
  }
}

TEST_F(RecordedSessions, RefusedFramesAreMarkedAndATruncatedEndIsNoError) {
  Record(1, [](TestServer& server) {
    Feeder a(server, "room", {.session = "a"});
    ASSERT_TRUE(a.Feed(0));
    grpc::ClientContext context;
    const auto stream = server.mapping->IntegrateFrames(&context);
    v1::IntegrateFramesRequest bad;
    bad.set_map("maps/room");
    bad.set_session("b");
    *bad.mutable_frame() = TestFrame(1);
    bad.mutable_frame()->set_map_from_sensor_matrix(3, 1e12);  // beyond the grid
    stream->Write(bad);
    stream->WritesDone();
    for (v1::IntegrateFramesResponse ack; stream->Read(&ack);)
      EXPECT_NE(ack.outcome(), v1::IntegrateFramesResponse::FUSED);
    (void)stream->Finish();
    ASSERT_TRUE(a.Feed(1));
    ASSERT_OK(server.Call(&MappingStub::FinishMapping, "maps/room"));
  });
  const auto events = [&] {
    std::string letters;
    auto reader = std::move(RecordReader::Open(File())).value();
    for (auto record = reader.Next().value(); record; record = reader.Next().value()) {
      letters += record->has_frame() ? "f" : record->has_refused() ? "r" : record->has_finished() ? "!" : "?";
    }
    return letters + (reader.is_torn() ? " torn" : "");
  };
  EXPECT_EQ(events(), "ffrf!");
  std::filesystem::resize_file(File(), std::filesystem::file_size(File()) - 1);
  EXPECT_EQ(events(), "ffrf torn");
}

TEST_F(RecordedSessions, AMapWithoutAValidFrameLeavesNoFile) {
  Record(1, [](TestServer& server) {
    grpc::ClientContext context;
    const auto stream = server.mapping->IntegrateFrames(&context);
    v1::IntegrateFramesRequest bad;
    bad.set_map("maps/room");
    bad.mutable_frame()->set_stamp_ns(1);  // no other field
    stream->Write(bad);
    stream->WritesDone();
    v1::IntegrateFramesResponse answer;
    while (stream->Read(&answer)) EXPECT_NE(answer.outcome(), v1::IntegrateFramesResponse::FUSED);
    (void)stream->Finish();
  });
  EXPECT_TRUE(std::filesystem::is_empty(dir_.path() / "records"));
  EXPECT_TRUE(stopped_.empty());
}

TEST_F(RecordedSessions, AFullFolderIsNotFilledWithEmptyFiles) {
  const auto folder = dir_.path() / "full";
  auto records = RecordDir::Open(folder.string(), 1000).value();
  std::ofstream(folder / "old.dhprec") << std::string(1000, 'x');
  const auto begun = records->Begin("room", 7);
  EXPECT_EQ(begun.status().code(), StatusCode::kResourceExhausted);
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder), {}), 1);
  std::filesystem::remove(folder / "old.dhprec");
  EXPECT_OK(records->Begin("room", 8)) << "somebody has taken it away";
}

TEST_F(RecordedSessions, OnAFullDiskRecordingStopsAndMappingContinues) {
  const auto all = Record(
      1, [](TestServer& server) { ASSERT_OK(Feed(server, "room", 0, 12)); }, 200'000);
  EXPECT_EQ(all->info().num_frames, 12);
  ASSERT_EQ(stopped_.size(), 1u);
  EXPECT_NE(stopped_[0].find("full"), std::string::npos) << stopped_[0];
  EXPECT_LE(records_->num_bytes(), 200'000);
  auto reader = std::move(RecordReader::Open(File())).value();
  std::optional<v1::Record> last;
  for (auto record = reader.Next().value(); record; record = reader.Next().value()) last = std::move(record);
  ASSERT_TRUE(last);
  EXPECT_TRUE(last->has_full());
  EXPECT_FALSE(reader.is_torn());
}

}  // namespace
}  // namespace dhpmap::testing

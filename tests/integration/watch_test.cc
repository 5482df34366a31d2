// SPDX-License-Identifier: BSD-3-Clause
// Watching a map through the gRPC door.
#include <atomic>
#include <future>
#include <random>
#include <thread>

#include "tests/integration/test_store.h"
#include "tests/integration/watcher.h"
#include "tests/support/eventually.h"

namespace dhpmap::testing {
namespace {

/// An empty map with the classes of TestScene, in a store with a limited history.
class WatchTest : public ::testing::Test {
 protected:
  void Begin(const ChangeHistoryLimits& limits = {}, const RegistryOptions& options = {}) {
    store = MakeTestStore(limits);
    server = std::make_unique<TestServer>(*store, OpenMapOptions{}, GrpcOptions{}, GrpcObserver{}, options);
    CreateMap();
  }
  void CreateMap() {
    ASSERT_OK_AND_ASSIGN(const auto response, server->Call(&MapStub::CreateMap, CreateRequest("room")));
    history = response.map().history_id();
  }
  void DeleteMap() { ASSERT_OK(server->Call(&MapStub::DeleteMap, "maps/room")); }
  /// The edit is committed before the answer.
  std::int64_t Rename(std::int64_t id, const std::string& name) {
    v1::UpdateSubmapRequest request;
    request.mutable_submap()->set_name("maps/room/submaps/" + std::to_string(id));
    request.mutable_submap()->set_display_name(name);
    request.mutable_update_mask()->add_paths("display_name");
    return server->Call(&SubmapStub::UpdateSubmap, request).value().revision();
  }
  std::int64_t Clone(std::int64_t id, std::int64_t* made = nullptr) {
    const auto response = server->Call(&SubmapStub::CloneSubmap, "maps/room/submaps/" + std::to_string(id)).value();
    if (made != nullptr) *made = response.submap().instance_id();
    return response.revision();
  }
  std::int64_t Remove(std::int64_t id) {
    return server->Call(&SubmapStub::DeleteSubmap, "maps/room/submaps/" + std::to_string(id)).value().revision();
  }
  v1::ListSubmapsResponse List() { return ListAll(*server->submaps, "room"); }
  std::int64_t AnyThing() {
    const v1::ListSubmapsResponse list = List();
    for (const v1::Submap& submap : list.submaps()) {
      if (submap.kind() == v1::LabelClass::THING) return submap.instance_id();
    }
    return -1;
  }
  v1::WatchMapRequest From(std::int64_t revision) {
    v1::WatchMapRequest request;
    request.set_map("maps/room");
    request.set_start_revision(revision);
    return request;
  }
  /// Without heartbeats for longer than any test runs.
  static v1::WatchMapRequest Silent(v1::WatchMapRequest request) {
    request.set_progress_interval_s(300);
    return request;
  }
  grpc::Status EndOf(const v1::WatchMapRequest& request) { return Watcher(*server->watches, request).Finish(); }

  std::unique_ptr<MapStore> store;
  std::unique_ptr<TestServer> server;
  std::string history;
};

TEST_F(WatchTest, AListFollowedByAWatchAgreesWithANewList) {
  Begin();
  Watcher from_the_beginning(*server->watches, From(1));
  HeldSubmaps all{v1::ListSubmapsResponse()};
  ASSERT_OK(Feed(*server, "room", 0, 6));
  const v1::ListSubmapsResponse list = List();
  HeldSubmaps held(list);
  Watcher watcher(*server->watches, From(list.revision() + 1));
  ASSERT_OK(Feed(*server, "room", 6, 12));
  const std::int64_t thing = AnyThing();
  std::int64_t made = 0;
  Clone(thing, &made);
  Rename(made, "the other one");
  Remove(thing);
  const v1::ListSubmapsResponse now = List();
  ASSERT_TRUE(watcher.FollowTo(now.revision(), held));
  EXPECT_EQ(held.submaps(), HeldSubmaps(now).submaps());
  ASSERT_TRUE(from_the_beginning.FollowTo(now.revision(), all));
  EXPECT_EQ(all.submaps(), HeldSubmaps(now).submaps());
  EXPECT_EQ(watcher.position(), history + "-" + std::to_string(now.revision()));
}

TEST_F(WatchTest, AMoveReportsTheBoxesBeforeAndAfterAlsoToLaterWatchers) {
  Begin();
  ASSERT_OK(Feed(*server, "room", 0, 6));
  const std::string name = "maps/room/submaps/" + std::to_string(AnyThing());
  v1::ApplyEditsRequest request;
  request.set_map("maps/room");
  v1::Edit& edit = *request.add_edits();
  edit.set_submap(name);
  edit.mutable_translate()->mutable_offset_m()->set_x(1.5);
  Watcher at_once(*server->watches, Silent(From(0)));
  v1::WatchMapResponse message;
  ASSERT_TRUE(at_once.Read(message));
  ASSERT_OK_AND_ASSIGN(const auto edited, server->Call(&EditStub::ApplyEdits, request));
  Watcher later(*server->watches, Silent(From(edited.revision())));
  ASSERT_TRUE(later.Read(message));
  for (Watcher* watcher : {&at_once, &later}) {
    ASSERT_TRUE(watcher->Read(message));
    ASSERT_EQ(message.change().submaps_size(), 1);
    const v1::SubmapEvent& event = message.change().submaps(0);
    EXPECT_EQ(event.submap().name(), name);
    EXPECT_EQ(event.parts(0), v1::SubmapEvent::POSE);
    ASSERT_TRUE(event.has_previous_box() && event.has_current_box());
    EXPECT_NEAR(event.current_box().min_m().x(), event.previous_box().min_m().x() + 1.5, 1e-6);
    EXPECT_NEAR(event.current_box().max_m().x(), event.previous_box().max_m().x() + 1.5, 1e-6);
    EXPECT_NEAR(event.current_box().max_m().z(), event.previous_box().max_m().z(), 1e-6);
    EXPECT_GT(event.current_box().max_m().z(), event.current_box().min_m().z());
  }
  ASSERT_GT(Rename(AnyThing(), "it"), edited.revision());
  ASSERT_TRUE(at_once.Read(message));
  EXPECT_FALSE(message.change().submaps(0).has_previous_box()) << "it has not moved";
}

TEST_F(WatchTest, TheFirstMessageContainsTheStartingPosition) {
  Begin();
  ASSERT_OK(Feed(*server, "room", 0, 4));
  const std::int64_t now = List().revision();
  v1::WatchMapResponse message;
  Watcher from_now(*server->watches, Silent(From(0)));
  ASSERT_TRUE(from_now.Read(message));
  EXPECT_EQ(message.progress().revision(), now);
  EXPECT_EQ(message.position(), history + "-" + std::to_string(now));
  Watcher from_two(*server->watches, Silent(From(2)));
  ASSERT_TRUE(from_two.Read(message));
  EXPECT_EQ(message.progress().revision(), 1);
  ASSERT_TRUE(from_two.Read(message));
  EXPECT_EQ(message.change().first_revision(), 2);
  const std::int64_t renamed = Rename(AnyThing(), "it");
  ASSERT_TRUE(from_now.Read(message));
  EXPECT_EQ(message.change().first_revision(), renamed);
  EXPECT_EQ(message.change().submaps(0).parts(0), v1::SubmapEvent::NAME);
  EXPECT_EQ(message.change().submaps(0).submap().display_name(), "it");
}

TEST_F(WatchTest, TwoHundredInterruptionsLoseAndRepeatNoChange) {
  Begin();
  HeldSubmaps held(List());
  std::atomic<bool> is_done = false;
  std::thread mapping([&] {
    for (int part = 0; part < 10; ++part) {
      EXPECT_OK(Feed(*server, "room", 3 * part, 3 * part + 3));
      const std::int64_t thing = AnyThing();
      for (int n = 0; n < 8 && thing > 0; ++n) Rename(thing, "thing " + std::to_string(8 * part + n));
      std::int64_t made = 0;
      if (thing > 0) Clone(thing, &made);
      if (thing > 0 && part % 2 == 0) Remove(made);
    }
    is_done = true;
  });
  std::mt19937 random(7);
  std::string position;
  std::int64_t last_told = held.revision();
  const auto watch_for = [&](int num_messages) {
    v1::WatchMapRequest request = From(held.revision() + 1);
    request.set_resume_after(position);
    Watcher watcher(*server->watches, request);
    v1::WatchMapResponse message;
    for (int n = 0; n < num_messages && watcher.Read(message); ++n) {
      EXPECT_TRUE(position.empty() || RevisionOf(message.position()) >= RevisionOf(position));
      position = message.position();
      if (!message.has_change()) continue;
      EXPECT_GT(message.change().last_revision(), last_told);
      EXPECT_LE(message.change().first_revision(), last_told + 1);
      if (message.change().last_message()) last_told = message.change().last_revision();
      held.Apply(message.change());
    }
  };
  int num_resumed = 0;
  for (; num_resumed < 200 || !is_done; ++num_resumed) watch_for(1 + static_cast<int>(random() % 2));
  mapping.join();
  const v1::ListSubmapsResponse now = List();
  while (last_told < now.revision()) watch_for(2);
  EXPECT_EQ(held.submaps(), HeldSubmaps(now).submaps());
}

TEST_F(WatchTest, ContinuesAfterARestartOfTheServer) {
  Begin();
  HeldSubmaps held(List());
  auto watcher = std::make_unique<Watcher>(*server->watches, From(held.revision() + 1));
  ASSERT_OK(Feed(*server, "room", 0, 5));
  ASSERT_TRUE(watcher->FollowTo(List().revision(), held));
  ASSERT_OK(server->Stop());
  const grpc::Status ended = watcher->Finish();
  EXPECT_EQ(ended.error_code(), grpc::UNAVAILABLE) << ended.error_message();
  EXPECT_EQ(ErrorInfoOf(ended).reason(), "SHUTTING_DOWN");

  server = std::make_unique<TestServer>(*store);
  v1::WatchMapRequest request = From(0);
  request.set_resume_after(watcher->position());
  Watcher resumed(*server->watches, request);
  ASSERT_OK(Feed(*server, "room", 5, 9));
  const v1::ListSubmapsResponse now = List();
  ASSERT_TRUE(resumed.FollowTo(now.revision(), held));
  EXPECT_EQ(held.submaps(), HeldSubmaps(now).submaps());
}

TEST_F(WatchTest, APositionBeforeTheKeptHistoryIsCompacted) {
  Begin({.max_changes = 3});
  ASSERT_OK(Feed(*server, "room", 0, 4));
  const std::int64_t thing = AnyThing();
  std::int64_t now = 0;
  for (int n = 0; n < 5; ++n) now = Rename(thing, "name " + std::to_string(n));
  const grpc::Status ended = EndOf(From(1));
  EXPECT_EQ(ended.error_code(), grpc::OUT_OF_RANGE) << ended.error_message();
  EXPECT_EQ(ErrorInfoOf(ended).reason(), "COMPACTED");
  EXPECT_EQ(ErrorInfoOf(ended).metadata().at("oldest_revision"), std::to_string(now - 2));
  HeldSubmaps held{v1::ListSubmapsResponse()};
  EXPECT_TRUE(Watcher(*server->watches, From(now - 2)).FollowTo(now, held));
  EXPECT_EQ(ErrorInfoOf(EndOf(From(now - 3))).reason(), "COMPACTED");
}

TEST_F(WatchTest, APositionOfAnotherHistoryOrTheFutureIsLost) {
  Begin();
  v1::WatchMapRequest other = From(1);
  other.set_history_id("00000000deadbeef");
  v1::WatchMapRequest resumed = From(1);
  resumed.set_resume_after("00000000deadbeef-1");
  for (const v1::WatchMapRequest& request : {other, resumed, From(1000)}) {
    const grpc::Status ended = EndOf(request);
    EXPECT_EQ(ended.error_code(), grpc::OUT_OF_RANGE) << ended.error_message();
    EXPECT_EQ(ErrorInfoOf(ended).reason(), "HISTORY_LOST");
    EXPECT_EQ(ErrorInfoOf(ended).metadata().at("history_id"), history);
  }
}

TEST_F(WatchTest, DeletingTheMapEndsItAndANewMapOfThatNameIsAnother) {
  Begin();
  Watcher watcher(*server->watches, From(1)), also(*server->watches, From(0));
  v1::WatchMapResponse message;
  ASSERT_TRUE(watcher.Read(message));
  ASSERT_TRUE(also.Read(message));
  const std::string position = message.position();
  DeleteMap();
  CreateMap();
  for (Watcher* one : {&watcher, &also}) {
    const grpc::Status ended = one->Finish();
    EXPECT_EQ(ended.error_code(), grpc::NOT_FOUND) << ended.error_message();
    EXPECT_EQ(ErrorInfoOf(ended).reason(), "MAP_NOT_FOUND");
  }
  v1::WatchMapRequest request = From(0);
  request.set_resume_after(position);
  EXPECT_EQ(ErrorInfoOf(EndOf(request)).reason(), "HISTORY_LOST");
}

TEST_F(WatchTest, ASlowReaderHasToStartOver) {
  Begin({.max_changes = 4});
  ASSERT_OK(Feed(*server, "room", 0, 4));
  const std::int64_t thing = AnyThing();
  std::int64_t other = 0;
  Clone(thing, &other);
  // A client that buffers at most 64 KiB.
  grpc::ChannelArguments arguments;
  arguments.SetInt(GRPC_ARG_HTTP2_BDP_PROBE, 0);
  arguments.SetInt(GRPC_ARG_USE_LOCAL_SUBCHANNEL_POOL, 1);
  const auto slow = v1::WatchService::NewStub(grpc::CreateCustomChannel(
      "127.0.0.1:" + std::to_string(server->grpc().port()), grpc::InsecureChannelCredentials(), arguments));
  Watcher watcher(*slow, From(List().revision() + 1));
  v1::WatchMapResponse message;
  ASSERT_TRUE(watcher.Read(message));
  const std::string long_name(240, 'x');
  for (int n = 0; n < 800; ++n) Rename(n % 2 == 0 ? thing : other, long_name + std::to_string(n));
  const grpc::Status ended = watcher.Finish();
  EXPECT_EQ(ended.error_code(), grpc::OUT_OF_RANGE) << ended.error_message();
  EXPECT_EQ(ErrorInfoOf(ended).reason(), "COMPACTED");
}

TEST_F(WatchTest, NeitherOpensAMapNorKeepsItOpen) {
  Begin({}, {.idle_close_s = 1e6});
  Watcher watcher(*server->watches, From(1));
  v1::WatchMapResponse message;
  ASSERT_TRUE(watcher.Read(message));
  EXPECT_TRUE(server->registry().OpenMaps().empty());
  ASSERT_OK(Feed(*server, "room", 0, 3));
  EXPECT_TRUE(Eventually([&] {
    server->registry().CloseIdleMaps(MapRegistry::Clock::now() + std::chrono::hours(1000));
    return server->registry().OpenMaps().empty();
  }));
  const std::int64_t renamed = Rename(AnyThing(), "open again");
  HeldSubmaps held{v1::ListSubmapsResponse()};
  EXPECT_TRUE(watcher.FollowTo(renamed, held));
}

TEST_F(WatchTest, WatchesBeyondTheLimitAreRefusedUntilOneEnds) {
  Begin({}, {.max_watchers = 2});
  v1::WatchMapResponse message;
  auto first = std::make_unique<Watcher>(*server->watches, From(0));
  Watcher second(*server->watches, From(0));
  ASSERT_TRUE(first->Read(message));
  ASSERT_TRUE(second.Read(message));
  const grpc::Status refused = EndOf(From(0));
  EXPECT_EQ(refused.error_code(), grpc::RESOURCE_EXHAUSTED);
  EXPECT_EQ(ErrorInfoOf(refused).reason(), "TOO_MANY_WATCHERS");
  first = nullptr;
  EXPECT_TRUE(Eventually([&] { return server->registry().changes().num_followers() == 1; }));
  Watcher third(*server->watches, From(0));
  EXPECT_TRUE(third.Read(message));
}

TEST_F(WatchTest, ReportsItsPositionFromTimeToTime) {
  Begin();
  v1::WatchMapRequest request = From(0);
  request.mutable_filter()->add_instance_ids(4'000'000);
  Watcher watcher(*server->watches, request);
  v1::WatchMapResponse message;
  ASSERT_TRUE(watcher.Read(message));
  ASSERT_TRUE(watcher.Read(message));
  EXPECT_TRUE(message.has_heartbeat()) << message.ShortDebugString();
  ASSERT_OK(Feed(*server, "room", 0, 3));
  const std::int64_t now = List().revision();
  for (message.Clear(); !message.has_progress();) ASSERT_TRUE(watcher.Read(message));
  while (RevisionOf(message.position()) < now) ASSERT_TRUE(watcher.Read(message));
  EXPECT_EQ(message.progress().revision(), now) << "though the filter passed nothing";
}

using WatchClock = WatchTest;

TEST_F(WatchClock, RequestedHeartbeatsContainThePositionToResumeFrom) {
  Begin();
  ASSERT_OK(Feed(*server, "room", 0, 3));
  const std::int64_t thing = AnyThing();
  Rename(thing, "as stored");  // so that nothing is unstored
  v1::WatchMapRequest often = From(0), seldom = Silent(From(0));
  often.set_progress_interval_s(0.5);
  const auto start = std::chrono::steady_clock::now();
  Watcher impatient(*server->watches, often), patient(*server->watches, seldom);
  v1::WatchMapResponse message;
  ASSERT_TRUE(patient.Read(message));
  ASSERT_TRUE(impatient.Read(message));
  EXPECT_TRUE(message.has_progress()) << "where it begins";
  const std::string begin = message.position();
  for (int n = 1; n <= 3; ++n) {
    ASSERT_TRUE(impatient.Read(message));
    EXPECT_TRUE(message.has_heartbeat()) << message.ShortDebugString();
    EXPECT_EQ(message.position(), begin);
  }
  EXPECT_GE(std::chrono::steady_clock::now() - start, std::chrono::milliseconds(1500)) << "not more often than asked";
  v1::WatchMapRequest again = seldom;
  again.set_resume_after(message.position());
  Watcher resumed(*server->watches, again);
  ASSERT_TRUE(resumed.Read(message));

  const std::int64_t renamed = Rename(thing, "at last");
  for (Watcher* watcher : {&patient, &resumed}) {
    ASSERT_TRUE(watcher->Read(message));
    EXPECT_EQ(message.change().last_revision(), renamed) << "no heartbeat before it: " << message.ShortDebugString();
  }
  do {
    ASSERT_TRUE(impatient.Read(message));
  } while (message.has_heartbeat());
  EXPECT_EQ(message.change().last_revision(), renamed);
  ASSERT_TRUE(impatient.Read(message));
  EXPECT_TRUE(message.has_heartbeat()) << message.ShortDebugString();
  EXPECT_EQ(RevisionOf(message.position()), renamed);
}

TEST_F(WatchTest, AChangeOfManySubmapsIsSplitIntoMessagesAndTheLastIsMarked) {
  Begin();
  ASSERT_OK(Feed(*server, "room", 0, 4));
  const std::int64_t thing = AnyThing();
  const auto session = server->registry().GetOpen("room");
  ASSERT_OK(session);
  const std::int64_t before = List().revision();
  std::promise<bool> is_made;
  (*session)->Edit(
      [thing](Map& map) -> Result<SubmapId> {
        for (int n = 0; n < 700; ++n) {
          map.Clone(SubmapId(static_cast<std::uint32_t>(thing)))->mutable_info().display_name = std::string(200, 'x');
        }
        return kUnknownSubmap;
      },
      [&is_made](const Result<EditOutcome>& outcome) { is_made.set_value(outcome.ok()); });
  ASSERT_TRUE(is_made.get_future().get());
  Watcher watcher(*server->watches, From(before + 1));
  v1::WatchMapResponse message;
  ASSERT_TRUE(watcher.Read(message));
  const std::string begin = message.position();
  int num_messages = 0, num_submaps = 0;
  do {
    ASSERT_TRUE(watcher.Read(message));
    ASSERT_TRUE(message.has_change());
    EXPECT_LT(message.ByteSizeLong(), 70u << 10);
    EXPECT_EQ(message.change().last_revision(), before + 1);
    EXPECT_EQ(message.position() == begin, !message.change().last_message());
    num_submaps += message.change().submaps_size();
    ++num_messages;
  } while (!message.change().last_message());
  EXPECT_EQ(num_submaps, 700);
  EXPECT_GT(num_messages, 2);
}

TEST_F(WatchTest, InvalidRequestsAreRefusedWithAReason) {
  Begin();
  v1::WatchMapRequest bad_position = From(0), bad_history = From(1), bad_class = From(0), bad_often = From(0);
  bad_position.set_resume_after("5");
  bad_history.set_history_id("xyz");
  bad_class.mutable_filter()->add_class_names("unicorn");
  bad_often.set_progress_interval_s(0.1);
  const std::pair<v1::WatchMapRequest, const char*> refused[] = {{bad_position, "BAD_POSITION"},
                                                                 {bad_history, "BAD_POSITION"},
                                                                 {From(-1), "BAD_POSITION"},
                                                                 {bad_class, "BAD_FILTER"}};
  for (const auto& [request, reason] : refused) {
    const grpc::Status ended = EndOf(request);
    EXPECT_EQ(ended.error_code(), grpc::INVALID_ARGUMENT) << ended.error_message();
    EXPECT_EQ(ErrorInfoOf(ended).reason(), reason);
  }
  EXPECT_EQ(EndOf(bad_often).error_code(), grpc::INVALID_ARGUMENT);
  v1::WatchMapRequest ghost = From(0);
  ghost.set_map("maps/ghost");
  EXPECT_EQ(ErrorInfoOf(EndOf(ghost)).reason(), "MAP_NOT_FOUND");
}

}  // namespace
}  // namespace dhpmap::testing

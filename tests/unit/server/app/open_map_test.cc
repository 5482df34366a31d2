// SPDX-License-Identifier: BSD-3-Clause
#include "server/app/open_map/open_map.h"

#include <atomic>
#include <chrono>
#include <filesystem>
#include <future>
#include <memory>
#include <stop_token>
#include <thread>
#include <vector>

#include "server/app/edits/submap_edits.h"
#include "storage/sqlite_store.h"
#include "tests/integration/busy_writer.h"
#include "tests/integration/failing_store.h"
#include "tests/support/eventually.h"
#include "tests/support/wrapped_store.h"
#include "tests/unit/server/app/open_map_fixture.h"

namespace dhpmap {
namespace {

using testing::FailingStore;

TEST_F(OpenMapTest, FramesBecomeVisibleWithTheirBatch) {
  Open({.publish = {.frames = 3, .delay_s = 1000}, .commit = {.delay_s = 1000}});
  for (int i = 0; i < 2; ++i) EXPECT_EQ(Integrate(i).revision, 1);
  EXPECT_EQ(session->View()->snapshot().info().num_frames, 0);
  EXPECT_EQ(Integrate(2).revision, 2);
  EXPECT_EQ(session->View()->snapshot().info().num_frames, 3);
  EXPECT_EQ(store->GetMap("room")->info.num_frames, 0);
  Integrate(3);
  EXPECT_TRUE(Wait<Status>([&](auto done) { session->Flush(done); }).ok());
  EXPECT_EQ(store->GetMap("room")->info.num_frames, 4);
}

/// An open map whose states the test prepares.
class PreparedSessionTest : public OpenMapTest {
 protected:
  void Open(OpenMapOptions options) {
    options.publish.prepare = [this](const VisibleSnapshot::State&, std::function<void()> ready) {
      if (ready) ready_ = std::move(ready);
      return true;
    };
    Map map(RoomInfo("room"));
    const auto state = map.Publish(0);
    ASSERT_TRUE(store->CreateMap(*state).ok());
    session = std::make_shared<OpenMap>(state, *store, std::move(options));
  }
  std::int64_t NumSeen() const { return session->View()->snapshot().info().num_frames; }
  std::int64_t NumStored() const { return store->GetMap("room")->info.num_frames; }
  ~PreparedSessionTest() override { session.reset(); }

  std::function<void()> ready_;
};

TEST_F(PreparedSessionTest, FramesAreVisibleOncePreparedAndStoredOnceVisible) {
  Open({.publish = {.frames = 1, .delay_s = 1000}, .commit = {.frames = 1, .delay_s = 1000}});
  ASSERT_TRUE(Integrate(0).report.ok());
  EXPECT_EQ(NumSeen(), 0);
  EXPECT_EQ(NumStored(), 0) << "who follows the map is told of what is stored, and wants to see it";
  ready_();
  EXPECT_EQ(NumSeen(), 1);
  ASSERT_TRUE(Integrate(1).report.ok());
  EXPECT_TRUE(testing::Eventually([&] { return NumStored() == 1; }));
  EXPECT_EQ(NumSeen(), 1);
  ASSERT_TRUE(Integrate(2).report.ok());
  EXPECT_EQ(NumSeen(), 2) << "the next one comes, and nobody has prepared this one";
  EXPECT_TRUE(testing::Eventually([&] { return NumStored() == 2; }));
}

TEST_F(PreparedSessionTest, AnUnpreparedStateIsShownAndStoredAfterADelay) {
  Open({.publish = {.frames = 1000, .delay_s = 0.01}, .commit = {.frames = 1000, .delay_s = 0.02}});
  ASSERT_TRUE(Integrate(0).report.ok());
  EXPECT_TRUE(testing::Eventually([&] { return NumStored() == 1; }));
  EXPECT_EQ(NumSeen(), 1);
}

TEST_F(PreparedSessionTest, ALongPublishDelayDoesNotDelayCommits) {
  Open({.publish = {.frames = 1, .delay_s = 1000}, .commit = {.frames = 1000, .delay_s = 0.02}});
  ASSERT_TRUE(Integrate(0).report.ok());
  EXPECT_TRUE(testing::Eventually([&] { return NumStored() == 1; }));
  EXPECT_EQ(NumSeen(), 1);
}

TEST_F(PreparedSessionTest, AFlushAndAnEditDoNotWaitForPreparation) {
  Open({.publish = {.frames = 1, .delay_s = 1000}, .commit = {.frames = 1000, .delay_s = 1000}});
  ASSERT_TRUE(Integrate(0).report.ok());
  EXPECT_EQ(NumSeen(), 0);
  ASSERT_TRUE(Wait<Status>([&](auto done) { session->Flush(done); }).ok());
  EXPECT_EQ(NumSeen(), 1);
  EXPECT_EQ(NumStored(), 1);
  ASSERT_TRUE(Integrate(1).report.ok());
  EXPECT_EQ(NumSeen(), 1);
  const auto edited = Wait<Result<EditOutcome>>([&](auto done) {
    session->Edit([](Map& map) -> Result<SubmapId> { return map.Clone(SubmapId(1))->id(); }, done);
  });
  ASSERT_TRUE(edited.ok());
  EXPECT_EQ(session->View(), edited->view);
  EXPECT_EQ(NumSeen(), 2);
  ready_();
  EXPECT_EQ(session->View(), edited->view) << "what was prepared is older";
}

TEST_F(OpenMapTest, FramesAreShownAndStoredAfterADelayWithoutFurtherFrames) {
  Open({.publish = {.frames = 1000, .delay_s = 0.01}, .commit = {.frames = 1000, .delay_s = 0.02}});
  Integrate(0);
  EXPECT_TRUE(testing::Eventually([&] { return store->GetMap("room")->info.num_frames == 1; }));
  EXPECT_EQ(session->View()->snapshot().info().num_frames, 1);
}

TEST_F(OpenMapTest, ABadFrameChangesNothing) {
  Open({});
  PanopticFrame bad = FrameOf(0);
  bad.camera->depth_m.pop_back();
  const auto outcome = Wait<FrameOutcome>([&](auto done) { session->Integrate(bad, done); });
  EXPECT_EQ(outcome.report.status().code(), StatusCode::kInvalidArgument);
  EXPECT_TRUE(Wait<Status>([&](auto done) { session->Flush(done); }).ok());
  EXPECT_EQ(session->View()->snapshot().revision(), 1);
}

TEST_F(OpenMapTest, StopStoresFusedFramesAndRefusesTheRest) {
  Open({.publish = {.frames = 1000, .delay_s = 1000}, .commit = {.frames = 1000, .delay_s = 1000}});
  Integrate(0);
  EXPECT_TRUE(registry->Shutdown().ok());
  EXPECT_EQ(store->GetMap("room")->info.num_frames, 1);
  EXPECT_EQ(Integrate(1).report.status().code(), StatusCode::kUnavailable);
  EXPECT_EQ(registry->GetOpen("room").status().code(), StatusCode::kOk);  // still readable
  EXPECT_EQ(session->BeginFeed().status().code(), StatusCode::kUnavailable);
}

TEST_F(OpenMapTest, AFeedLearnsExactlyWhatIsStored) {
  auto failing = std::make_unique<FailingStore>();
  FailingStore& disk = *failing;
  store = std::move(failing);
  Open({.publish = {.frames = 1}, .commit = {.frames = 1, .retry_s = 0.005}});
  const auto feed = *session->BeginFeed();
  const auto integrate = [&](std::int64_t sequence) {
    return Wait<FrameOutcome>([&](auto done) { session->Integrate(feed, sequence, FrameOf(0), done); });
  };
  disk.set_full(true);
  for (const std::int64_t sequence : {40, 41}) EXPECT_FALSE(integrate(sequence).committed_sequence.has_value());
  EXPECT_FALSE(session->ProgressOf(feed).committed_sequence.has_value());
  disk.set_full(false);
  EXPECT_TRUE(Wait<Status>([&](auto done) { session->Flush(done); }).ok());
  EXPECT_EQ(session->ProgressOf(feed).committed_sequence, 41);
  disk.set_full(true);
  const FrameOutcome behind = integrate(42);
  EXPECT_EQ(behind.committed_sequence, 41);
  PanopticFrame bad = FrameOf(0);
  bad.camera->depth_m.pop_back();
  const auto refused = Wait<FrameOutcome>([&](auto done) { session->Integrate(feed, 43, bad, done); });
  EXPECT_FALSE(refused.report.ok());
  EXPECT_EQ(refused.committed_sequence, 41);
  disk.set_full(false);
  EXPECT_TRUE(Wait<Status>([&](auto done) { session->Flush(done); }).ok());
  EXPECT_EQ(session->ProgressOf(feed).committed_sequence, 42) << "a frame that was refused is not stored";
}

TEST_F(OpenMapTest, ASessionIsRememberedWithItsFrames) {
  Open({.publish = {.frames = 1000, .delay_s = 1000}, .commit = {.frames = 1000, .delay_s = 1000}});
  auto feed = *session->BeginFeed({.session = "robot"});
  const auto integrate = [&](std::int64_t sequence) {
    return Wait<FrameOutcome>([&](auto done) { session->Integrate(feed, sequence, FrameOf(0), done); });
  };
  for (const std::int64_t sequence : {5, 6, 8}) {
    const FrameOutcome outcome = integrate(sequence);
    EXPECT_TRUE(outcome.report.ok() && !outcome.is_duplicate);
    EXPECT_FALSE(outcome.committed_sequence.has_value()) << "nothing is stored yet";
  }
  for (const std::int64_t sequence : {8, 7, 5, -1}) {
    const FrameOutcome outcome = integrate(sequence);
    EXPECT_TRUE(outcome.report.ok() && outcome.is_duplicate) << sequence;
    EXPECT_EQ(outcome.report->num_points, 0);
  }
  EXPECT_TRUE(Wait<Status>([&](auto done) { session->Flush(done); }).ok());
  EXPECT_EQ(store->GetMap("room")->info.num_frames, 3);
  EXPECT_EQ(store->GetMap("room")->info.sessions.LastOf("robot"), 8);
  session->EndFeed(feed);

  feed = *session->BeginFeed({.session = "robot"});
  EXPECT_EQ(Wait<FeedProgress>([&](auto done) { session->Greet(feed, done); }).committed_sequence, 8);
  EXPECT_TRUE(integrate(8).is_duplicate);
  EXPECT_FALSE(integrate(9).is_duplicate);
  session->EndFeed(feed);
  feed = *session->BeginFeed({.session = "other"});
  EXPECT_FALSE(session->ProgressOf(feed).committed_sequence.has_value());
  EXPECT_FALSE(integrate(1).is_duplicate);
  session->EndFeed(feed);
  feed = *session->BeginFeed();
  for (int i = 0; i < 2; ++i) EXPECT_FALSE(integrate(1).is_duplicate) << "without a session nothing is";

  // Neither FinishMapping nor an edit drops it.
  EXPECT_TRUE(Wait<Result<FinishOutcome>>([&](auto done) { session->Finish(done); }).ok());
  EXPECT_EQ(store->GetMap("room")->info.sessions.LastOf("robot"), 9);
  EXPECT_EQ(session->BeginFeed({.session = "no good"}).status().reason(), Reason("BAD_SESSION"));
}

TEST_F(OpenMapTest, FinishingEndsWhenCancelled) {
  Open({.publish = {.delay_s = 1000}, .commit = {.delay_s = 1000}});
  Integrate(0);
  std::stop_source gone;
  gone.request_stop();
  const auto cancelled = Wait<Result<FinishOutcome>>([&](auto done) { session->Finish(done, gone.get_token()); });
  EXPECT_EQ(cancelled.status().code(), StatusCode::kCancelled);
  EXPECT_EQ(Integrate(1).report.status().code(), StatusCode::kOk) << "the map goes on";
  EXPECT_TRUE(Wait<Result<FinishOutcome>>([&](auto done) { session->Finish(done); }).ok());
}

TEST_F(OpenMapTest, QueuedFinishingEndsAtOnceWhenCancelled) {
  Open({.publish = {.delay_s = 1000}, .commit = {.delay_s = 1000}});
  Integrate(0);
  auto busy = std::make_unique<testing::BusyWriter>(*session);
  std::stop_source gone;
  int num_answers = 0;
  Status answer;
  session->Finish(
      [&](const Result<FinishOutcome>& outcome) {
        ++num_answers;
        answer = outcome.status();
      },
      gone.get_token());
  ASSERT_TRUE(session->Finishing().has_value());
  gone.request_stop();
  EXPECT_EQ(answer.code(), StatusCode::kCancelled);
  EXPECT_FALSE(session->Finishing().has_value());
  busy = nullptr;
  EXPECT_EQ(Integrate(1).report.status().code(), StatusCode::kOk);
  EXPECT_TRUE(Wait<Status>([&](auto done) { session->Flush(done); }).ok());
  EXPECT_EQ(num_answers, 1) << "its turn came, and nothing was left to do";
  EXPECT_EQ(session->View()->snapshot().info().num_frames, 2);
  for (const auto& submap : session->View()->snapshot().submaps()) {
    if (submap->info().panoptic != Panoptic::kThing) continue;
    EXPECT_EQ(submap->info().activity, Activity::kActive);
  }
}

TEST_F(OpenMapTest, AStopDoesNotWaitForACancelledFinishing) {
  Open({.max_pending_edits = 1});
  auto busy = std::make_unique<testing::BusyWriter>(*session);
  std::stop_source gone;
  std::promise<void> is_told, may_go;
  session->Finish(
      [&](const Result<FinishOutcome>&) {
        is_told.set_value();
        may_go.get_future().wait();
      },
      gone.get_token());
  std::jthread cancelling([&] { gone.request_stop(); });
  is_told.get_future().wait();
  std::jthread ending([&] { (void)session->Stop(); });
  EXPECT_TRUE(testing::Eventually([&] {  // that it has begun: until then there are too many edits
    Status refusal;
    session->Edit([](Map&) -> Result<SubmapId> { return SubmapId(0); },
                  [&refusal](const Result<EditOutcome>& outcome) { refusal = outcome.status(); });
    return refusal.reason() != Reason("TOO_MANY_EDITS");
  }));
  busy = nullptr;
  // The writer drops the job while its callback still runs: nothing is left to do then.
  auto asked = std::async(std::launch::async, [&] { return testing::Eventually([&] { return session->IsAtRest(); }); });
  EXPECT_EQ(asked.wait_for(testing::kPatience), std::future_status::ready) << "the writer holds its lock";
  may_go.set_value();
  EXPECT_TRUE(asked.get());
}

TEST_F(OpenMapTest, AStopDoesNotWaitForARefinement) {
  const auto slots = std::make_shared<RefinementSlots>(1);
  Open({.mapping = {.refinement_slots = slots}});
  Integrate(0);
  auto held = RefinementSlots::TryTake(slots);  // finishing waits for it
  std::promise<Status> finished;
  session->Finish([&](const Result<FinishOutcome>& outcome) { finished.set_value(outcome.status()); });
  EXPECT_TRUE(registry->Shutdown().ok());
  EXPECT_EQ(finished.get_future().get().code(), StatusCode::kUnavailable);
  EXPECT_EQ(store->GetMap("room")->info.num_frames, 1) << "what was fused is stored";
}

TEST_F(OpenMapTest, QueuedFramesAreRefusedAfterATakeover) {
  Open({});
  auto busy = std::make_unique<testing::BusyWriter>(*session);
  Status told;
  const auto old_feed = *session->BeginFeed({.on_evicted = [&told](const Status& why) { told = why; }});
  std::vector<std::future<FrameOutcome>> answers;
  for (int i = 0; i < 3; ++i) {
    auto promise = std::make_shared<std::promise<FrameOutcome>>();
    answers.push_back(promise->get_future());
    session->Integrate(old_feed, i, FrameOf(i),
                       [promise](const FrameOutcome& outcome) { promise->set_value(outcome); });
  }
  const auto feed = session->BeginFeed({.take_over = true});
  ASSERT_TRUE(feed.ok());
  EXPECT_EQ(told.reason(), Reason("FEED_TAKEN_OVER"));
  busy = nullptr;
  for (auto& answer : answers) EXPECT_EQ(answer.get().report.status().reason(), Reason("FEED_TAKEN_OVER"));
  EXPECT_TRUE(Wait<FrameOutcome>([&](auto done) { session->Integrate(*feed, 0, FrameOf(0), done); }).report.ok());
  EXPECT_TRUE(Wait<Status>([&](auto done) { session->Flush(done); }).ok());
  EXPECT_EQ(store->GetMap("room")->info.num_frames, 1);
}

TEST_F(OpenMapTest, AMapWhoseFeederIsIdleCanBeDeleted) {
  Open({.feeds = {.idle_s = 0}});
  Status told;
  const auto feed = *session->BeginFeed({.on_evicted = [&told](const Status& why) { told = why; }});
  ASSERT_TRUE(Wait<FrameOutcome>([&](auto done) { session->Integrate(feed, 0, FrameOf(0), done); }).report.ok());
  EXPECT_TRUE(registry->Delete("room").ok());
  EXPECT_EQ(told.reason(), Reason("FEED_IDLE"));
  EXPECT_FALSE(Wait<FrameOutcome>([&](auto done) { session->Integrate(feed, 1, FrameOf(1), done); }).report.ok());
}

TEST_F(OpenMapTest, NumbersSeenBeforeACrashAreNotReused) {
  const testing::TempDir folder;
  const std::string path = (folder.path() / "maps.db").string(), crashed = (folder.path() / "crashed.db").string();
  store = std::move(OpenSqliteStore(path)).value();
  Open({.publish = {.frames = 1}, .commit = {.frames = 1000, .delay_s = 1000}});
  for (int i = 0; i < 4; ++i) ASSERT_TRUE(Integrate(i).report.ok());
  const MapInfo seen = session->View()->snapshot().info();
  ASSERT_GT(seen.revision, 3);
  ASSERT_GT(seen.next_submap_id, SubmapId(1));
  ASSERT_EQ(store->GetMap("room")->info.num_frames, 0) << "nothing of it is stored";
  for (const char* part : {"", "-wal"}) std::filesystem::copy_file(path + part, crashed + part);  // power is lost here

  const auto reopened = std::move(OpenSqliteStore(crashed)).value();
  const MapInfo after = reopened->GetMap("room")->info;
  EXPECT_GT(after.revision, seen.revision);
  EXPECT_GE(after.next_submap_id, seen.next_submap_id);

  // Without a crash there is no gap.
  ASSERT_TRUE(registry->Shutdown().ok());
  session = nullptr;
  registry = nullptr;
  store = nullptr;
  store = std::move(OpenSqliteStore(path)).value();
  EXPECT_EQ(store->GetMap("room")->info.revision, seen.revision);
  EXPECT_EQ(store->GetMap("room")->info.next_submap_id, seen.next_submap_id);
}

TEST_F(OpenMapTest, NumbersThatCannotBeReservedAreNotShown) {
  auto failing = std::make_unique<FailingStore>();
  FailingStore& disk = *failing;
  store = std::move(failing);
  Open({.publish = {.frames = 1}, .commit = {.frames = 1000, .delay_s = 1000}});
  disk.set_full(true);
  EXPECT_EQ(Integrate(0).revision, 1);
  EXPECT_EQ(session->View()->snapshot().info().num_frames, 0);
  disk.set_full(false);
  EXPECT_GT(Integrate(1).revision, 1);
  EXPECT_EQ(session->View()->snapshot().info().num_frames, 2);
}

TEST_F(OpenMapTest, ConcurrentFramesEditsAndLookupsSeeCompleteStates) {
  Open({.publish = {.frames = 1}, .commit = {.frames = 2}});
  for (int i = 0; i < 3; ++i) ASSERT_TRUE(Integrate(i).report.ok());
  std::atomic<bool> is_running = true;
  const auto look = [&] {
    std::int64_t revision = 0;
    while (is_running) {
      const auto view = session->View();
      ASSERT_GE(view->snapshot().revision(), revision);
      revision = view->snapshot().revision();
      for (int i = -10; i < 10; ++i) {
        const PointInfo point = view->lookup().At({0.1 * i, 0, 0.05});
        ASSERT_TRUE(!point.is_observed || view->snapshot().Find(point.submap) != nullptr);
      }
    }
  };
  const auto edit = [&] {
    while (is_running) {
      const auto cloned = Wait<Result<EditOutcome>>(
          [&](auto done) { session->Edit([](Map& map) { return CloneSubmap(map, SubmapId(1), "", {}); }, done); });
      ASSERT_TRUE(cloned.ok()) << cloned.status().ToString();
      const SubmapId id = cloned->submap;
      ASSERT_NE(cloned->view->snapshot().Find(id), nullptr);
      const auto deleted = Wait<Result<EditOutcome>>([&](auto done) {
        session->Edit(
            [id](Map& map) -> Result<SubmapId> {
              DHPMAP_RETURN_IF_ERROR(DeleteSubmap(map, id, ""));
              return id;
            },
            done);
      });
      ASSERT_TRUE(deleted.ok()) << deleted.status().ToString();
    }
  };
  std::vector<std::thread> threads;
  threads.emplace_back(look);
  threads.emplace_back(look);
  threads.emplace_back(edit);
  for (int i = 3; i < 20; ++i) EXPECT_TRUE(Integrate(i).report.ok());
  is_running = false;
  for (std::thread& thread : threads) thread.join();
  EXPECT_TRUE(registry->Shutdown().ok());
  EXPECT_EQ(store->GetMap("room")->info.num_frames, 20);
}

/// A store that records the durability of the last commit.
class SyncStore final : public testing::WrappedStore {
 public:
  Status Commit(const StateMarks& before, const MapSnapshot& after, Durability durability) override {
    last = durability;
    return inner().Commit(before, after, durability);
  }
  Status CommitEdit(const StateMarks& before, const MapSnapshot& after, const EditRecord& edit) override {
    last = Durability::kFull;
    return inner().CommitEdit(before, after, edit);
  }

  std::atomic<Durability> last = Durability::kNormal;
};

TEST(OpenMap, AFlushSyncsFullyEvenIfAllWasCommittedBefore) {
  SyncStore store;
  const auto registry =
      std::move(MapRegistry::Open(store, {.mapping = {.num_threads = 1}, .commit = {.frames = 1}})).value();
  ASSERT_TRUE(registry->Create(RoomInfo("room")).ok());
  const auto session = *registry->GetOpen("room");
  (void)Wait<FrameOutcome>([&](auto done) { session->Integrate(FrameOf(0), done); });
  EXPECT_TRUE(testing::Eventually([&] { return store.GetMap("room")->info.num_frames == 1; }));
  EXPECT_EQ(store.last, Durability::kNormal);
  EXPECT_TRUE(Wait<Status>([&](auto done) { session->Flush(done); }).ok());
  EXPECT_EQ(store.last, Durability::kFull);
}

/// A store with one damaged map, of which only the name is readable.
class DamagedStore final : public testing::WrappedStore {
 public:
  Result<std::vector<StoredMap>> ListMaps(const std::string& after, std::size_t max) override {
    DHPMAP_ASSIGN_OR_RETURN(auto maps, inner().ListMaps(after, max));
    for (StoredMap& map : maps) {
      if (map.info.name == "ruin") map = DamagedMap("ruin", DataLoss("a checksum is wrong"));
    }
    return maps;
  }
  Result<StoredMap> GetMap(const std::string& name) override {
    auto map = inner().GetMap(name);
    if (map.ok() && name == "ruin") return DataLoss("a checksum is wrong");
    return map;
  }
  Result<std::shared_ptr<const MapSnapshot>> LoadMap(const std::string&) override { return DataLoss("no"); }
};

TEST(MapRegistry, ADamagedMapIsListedRefusedAndDeletable) {
  DamagedStore store;
  ASSERT_TRUE(store.CreateMap(*Map(RoomInfo("ruin")).Publish(1)).ok());
  const auto registry = std::move(MapRegistry::Open(store, {.mapping = {.num_threads = 1}})).value();
  ASSERT_EQ(registry->List("", 10)->size(), 1u);
  EXPECT_EQ(registry->List("", 10)->at(0).damage.code(), StatusCode::kDataLoss);
  EXPECT_EQ(registry->Get("ruin").status().code(), StatusCode::kDataLoss);
  EXPECT_EQ(registry->GetOpen("ruin").status().code(), StatusCode::kDataLoss);
  EXPECT_EQ(registry->Create(RoomInfo("ruin")).status().code(), StatusCode::kAlreadyExists);
  EXPECT_TRUE(registry->Create(RoomInfo("room")).ok());
  EXPECT_TRUE(registry->Delete("ruin").ok());
  EXPECT_EQ(registry->List("", 10)->size(), 1u);
}

TEST_F(OpenMapTest, AMapCanBeDeletedWhileInUse) {
  Open({});
  Integrate(0);
  const auto feed = session->BeginFeed();
  ASSERT_TRUE(feed.ok());
  EXPECT_EQ(registry->Delete("room").status().code(), StatusCode::kFailedPrecondition);
  session->EndFeed(*feed);
  EXPECT_TRUE(registry->Delete("room").ok());
  EXPECT_EQ(Integrate(1).report.status().code(), StatusCode::kNotFound);
  EXPECT_EQ(session->View()->snapshot().info().name, "room");  // who holds a state keeps it
  EXPECT_TRUE(registry->Create(RoomInfo("room")).ok());
}

}  // namespace
}  // namespace dhpmap

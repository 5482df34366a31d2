// SPDX-License-Identifier: BSD-3-Clause
#include "server/app/map_session.h"

#include <gtest/gtest.h>

#include <atomic>
#include <future>
#include <thread>
#include <vector>

#include "server/app/map_registry.h"
#include "server/app/submap_edits.h"
#include "tests/support/scenes.h"

namespace dhpmap {
namespace {

using testing::Scene;
using testing::Solid;

PanopticFrame FrameOf(int i) {
  const Scene scene{.solids = {{.shape = Solid::Shape::kSphere, .center_m = {0, 0, 0.4}, .size_m = {0.4, 0, 0}},
                               {.shape = Solid::Shape::kHalfSpace, .size_m = {0, 0, 1}, .segment = 2}}};
  PanopticFrame frame =
      testing::Render(scene, {.width_px = 40, .height_px = 30, .fx_px = 20, .fy_px = 20, .cx_px = 20, .cy_px = 15},
                      testing::LookAt({2, 0.1 * i, 1}, {0, 0, 0.2}));
  frame.segments = {{.id = SegmentId(1), .class_id = ClassId(1)}, {.id = SegmentId(2), .class_id = ClassId(2)}};
  return frame;
}

MapInfo RoomInfo(const std::string& name) {
  MapInfo info;
  info.name = name;
  info.label_set = testing::MakeLabelSet(1, 1);
  info.config.voxel_size_m = 0.1;
  info.config.truncation_m = 0.2;
  info.config.tracking.min_points_medium = info.config.tracking.min_points_stuff = 5;
  return info;
}

/// The answer of a call that gives it to a callback.
template <typename Answer, typename Call>
Answer Wait(Call&& call) {
  auto promise = std::make_shared<std::promise<Answer>>();
  call([promise](const Answer& answer) { promise->set_value(answer); });
  return promise->get_future().get();
}

class MapSessionTest : public ::testing::Test {
 protected:
  void Open(SessionOptions options) {
    options.num_threads = 2;
    registry = std::move(MapRegistry::Open(*store, std::move(options))).value();
    ASSERT_TRUE(registry->Create(RoomInfo("room")).ok());
    session = *registry->OpenSession("room");
  }
  FrameOutcome Integrate(int i) {
    return Wait<FrameOutcome>([&](auto done) { session->Integrate(FrameOf(i), done); });
  }

  std::unique_ptr<MapStore> store = MakeMemoryStore();
  std::unique_ptr<MapRegistry> registry;
  std::shared_ptr<MapSession> session;
};

TEST_F(MapSessionTest, FramesAreSeenWithTheirBatch) {
  Open({.publish_frames = 3, .publish_s = 1000, .commit_s = 1000});
  for (int i = 0; i < 2; ++i) EXPECT_EQ(Integrate(i).revision, 1);
  EXPECT_EQ(session->View()->snapshot().info().num_frames, 0);
  EXPECT_EQ(Integrate(2).revision, 2);
  EXPECT_EQ(session->View()->snapshot().info().num_frames, 3);
  EXPECT_EQ(store->GetMap("room")->info.num_frames, 0);
  Integrate(3);
  EXPECT_TRUE(Wait<Status>([&](auto done) { session->Flush(done); }).ok());
  EXPECT_EQ(store->GetMap("room")->info.num_frames, 4);
}

TEST_F(MapSessionTest, FramesAreSeenAndStoredAfterAWhileEvenIfNoMoreCome) {
  Open({.publish_frames = 1000, .publish_s = 0.01, .commit_frames = 1000, .commit_s = 0.02});
  Integrate(0);
  while (store->GetMap("room")->info.num_frames != 1) std::this_thread::sleep_for(std::chrono::milliseconds(2));
  EXPECT_EQ(session->View()->snapshot().info().num_frames, 1);
}

TEST_F(MapSessionTest, ABadFrameChangesNothing) {
  Open({});
  PanopticFrame bad = FrameOf(0);
  bad.camera->depth_m.pop_back();
  const auto outcome = Wait<FrameOutcome>([&](auto done) { session->Integrate(bad, done); });
  EXPECT_EQ(outcome.report.status().code(), StatusCode::kInvalidArgument);
  EXPECT_TRUE(Wait<Status>([&](auto done) { session->Flush(done); }).ok());
  EXPECT_EQ(session->View()->snapshot().revision(), 1);
}

TEST_F(MapSessionTest, StopStoresWhatIsFusedAndRefusesTheRest) {
  Open({.publish_frames = 1000, .publish_s = 1000, .commit_frames = 1000, .commit_s = 1000});
  Integrate(0);
  EXPECT_TRUE(registry->Shutdown().ok());
  EXPECT_EQ(store->GetMap("room")->info.num_frames, 1);
  EXPECT_EQ(Integrate(1).report.status().code(), StatusCode::kUnavailable);
  EXPECT_EQ(registry->OpenSession("room").status().code(), StatusCode::kOk);  // still readable
  EXPECT_EQ(session->BeginFeed().code(), StatusCode::kUnavailable);
}

TEST_F(MapSessionTest, TooManyEditsAreRefusedNotQueued) {
  Open({.max_pending_edits = 2});
  std::promise<void> go;
  std::vector<std::future<Status>> answers;
  const auto edit = [&](std::function<Result<SubmapId>(Map&)> change) {
    auto promise = std::make_shared<std::promise<Status>>();
    answers.push_back(promise->get_future());
    session->Edit(std::move(change),
                  [promise](const Result<EditOutcome>& outcome) { promise->set_value(outcome.status()); });
  };
  std::promise<void> begun;
  edit([&](Map&) -> Result<SubmapId> {
    begun.set_value();
    go.get_future().wait();
    return SubmapId(0);
  });
  begun.get_future().wait();  // the writer is busy with the first
  for (int i = 0; i < 3; ++i) edit([](Map&) -> Result<SubmapId> { return SubmapId(0); });
  EXPECT_EQ(answers.back().get().code(), StatusCode::kResourceExhausted);
  answers.pop_back();
  go.set_value();
  for (auto& answer : answers) EXPECT_TRUE(answer.get().ok());
}

TEST_F(MapSessionTest, AnEditThatThrowsIsAnswered) {
  Open({});
  const auto outcome = Wait<Result<EditOutcome>>(
      [&](auto done) { session->Edit([](Map&) -> Result<SubmapId> { throw std::bad_alloc(); }, done); });
  EXPECT_EQ(outcome.status().code(), StatusCode::kInternal);
  EXPECT_TRUE(Integrate(0).report.ok());
}

TEST_F(MapSessionTest, FrameEditsAndLookupsAtOnceSeeWholeStates) {
  Open({.publish_frames = 1, .commit_frames = 2});
  for (int i = 0; i < 3; ++i) ASSERT_TRUE(Integrate(i).report.ok());
  std::atomic<bool> is_running = true;
  const auto look = [&] {
    std::int64_t revision = 0;
    while (is_running) {
      const auto view = session->View();
      ASSERT_GE(view->snapshot().revision(), revision);
      revision = view->snapshot().revision();
      for (double x = -1; x < 1; x += 0.1) {
        const PointInfo point = view->lookup().At({x, 0, 0.05});
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
      ASSERT_TRUE(deleted.ok());
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

/// A store with one map of which nothing but the name can be read.
class DamagedStore final : public MapStore {
 public:
  Result<std::vector<StoredMap>> ListMaps() override {
    if (is_deleted) return std::vector<StoredMap>{};
    return std::vector<StoredMap>{{.info = {.name = "ruin"}, .damage = DataLoss("a checksum is wrong")}};
  }
  Result<StoredMap> GetMap(const std::string&) override { return DataLoss("a checksum is wrong"); }
  Status CreateMap(const MapSnapshot&) override { return Status::Ok(); }
  Status Commit(const MapSnapshot&, const MapSnapshot&, Durability) override { return Status::Ok(); }
  Result<std::shared_ptr<const MapSnapshot>> LoadMap(const std::string&) override { return DataLoss("no"); }
  Status DeleteMap(const std::string&) override {
    is_deleted = true;
    return Status::Ok();
  }
  bool is_deleted = false;
};

TEST(MapRegistry, ADamagedMapIsListedRefusedAndCanBeDeletedBesideTheOthers) {
  DamagedStore store;
  const auto registry = std::move(MapRegistry::Open(store, {.num_threads = 1})).value();
  ASSERT_EQ(registry->List().size(), 1u);
  EXPECT_EQ(registry->List()[0].damage.code(), StatusCode::kDataLoss);
  EXPECT_EQ(registry->Get("ruin").status().code(), StatusCode::kDataLoss);
  EXPECT_EQ(registry->OpenSession("ruin").status().code(), StatusCode::kDataLoss);
  EXPECT_EQ(registry->Create(RoomInfo("ruin")).status().code(), StatusCode::kAlreadyExists);
  EXPECT_TRUE(registry->Create(RoomInfo("room")).ok());
  EXPECT_TRUE(registry->Delete("ruin").ok());
  EXPECT_EQ(registry->List().size(), 1u);
}

TEST_F(MapSessionTest, AMapIsDeletedUnderItsUsers) {
  Open({});
  Integrate(0);
  ASSERT_TRUE(session->BeginFeed().ok());
  EXPECT_EQ(registry->Delete("room").status().code(), StatusCode::kFailedPrecondition);
  session->EndFeed();
  EXPECT_TRUE(registry->Delete("room").ok());
  EXPECT_EQ(Integrate(1).report.status().code(), StatusCode::kNotFound);
  EXPECT_EQ(session->View()->snapshot().info().name, "room");  // who holds a state keeps it
  EXPECT_TRUE(registry->Create(RoomInfo("room")).ok());
}

}  // namespace
}  // namespace dhpmap

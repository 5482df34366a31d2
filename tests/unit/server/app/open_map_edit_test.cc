// SPDX-License-Identifier: BSD-3-Clause
// Edits, and a store that refuses or falls behind.
#include <atomic>
#include <future>
#include <memory>
#include <new>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "server/app/edits/edit_list.h"
#include "server/app/edits/edit_summary.h"
#include "server/app/edits/submap_edits.h"
#include "storage/sqlite_store.h"
#include "tests/integration/failing_store.h"
#include "tests/support/eventually.h"
#include "tests/support/wrapped_store.h"
#include "tests/unit/server/app/open_map_fixture.h"

namespace dhpmap {
namespace {

using testing::FailingStore;

TEST_F(OpenMapTest, EditsBeyondTheQueueAreRefused) {
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

TEST_F(OpenMapTest, AnEditThatThrowsIsAnswered) {
  Open({});
  const auto outcome = Wait<Result<EditOutcome>>(
      [&](auto done) { session->Edit([](Map&) -> Result<SubmapId> { throw std::bad_alloc(); }, done); });
  EXPECT_EQ(outcome.status().code(), StatusCode::kResourceExhausted);
  EXPECT_EQ(outcome.status().reason(), Reason("OUT_OF_MEMORY"));
  const auto other = Wait<Result<EditOutcome>>([&](auto done) {
    session->Edit([](Map&) -> Result<SubmapId> { throw std::runtime_error("of the edit"); }, done);
  });
  EXPECT_EQ(other.status().code(), StatusCode::kInternal);
  EXPECT_TRUE(Integrate(0).report.ok());
}

TEST_F(OpenMapTest, AnEditThatFailsMidwayChangesNothing) {
  Open({});
  for (int i = 0; i < 2; ++i) ASSERT_TRUE(Integrate(i).report.ok());
  const auto outcome = Wait<Result<EditOutcome>>([&](auto done) {
    session->Edit(
        [](Map& map) -> Result<SubmapId> {
          map.Clone(SubmapId(1));
          throw std::bad_alloc();
        },
        done);
  });
  EXPECT_EQ(outcome.status().reason(), Reason("OUT_OF_MEMORY"));
  const std::size_t num_submaps = session->View()->snapshot().submaps().size();
  EXPECT_TRUE(Integrate(2).report.ok());
  EXPECT_TRUE(Wait<Status>([&](auto done) { session->Flush(done); }).ok());
  EXPECT_EQ(session->View()->snapshot().submaps().size(), num_submaps);
}

TEST_F(OpenMapTest, AnEditThatCannotBeStoredDidNotHappen) {
  auto failing = std::make_unique<FailingStore>();
  FailingStore& disk = *failing;
  store = std::move(failing);
  Open({.publish = {.frames = 1000, .delay_s = 1000}, .commit = {.frames = 1000, .delay_s = 1000, .retry_s = 0.005}});
  for (int i = 0; i < 3; ++i) ASSERT_TRUE(Integrate(i).report.ok());
  const auto clone = [&] {
    return Wait<Result<EditOutcome>>(
        [&](auto done) { session->Edit([](Map& map) { return CloneSubmap(map, SubmapId(1), "", {}); }, done); });
  };
  const auto first = clone();
  ASSERT_TRUE(first.ok()) << first.status().ToString();
  const auto seen = session->View()->snapshot().revision();
  const auto num_submaps = session->View()->snapshot().submaps().size();

  disk.set_full(true);
  for (int i = 0; i < 5; ++i) {
    EXPECT_EQ(clone().status().code(), StatusCode::kResourceExhausted);
    EXPECT_EQ(session->View()->snapshot().revision(), seen);
  }
  EXPECT_TRUE(testing::Eventually([&] { return disk.num_refused() >= 8; })) << "retries of its own";
  disk.set_full(false);
  const auto last = clone();
  ASSERT_TRUE(last.ok()) << last.status().ToString();
  EXPECT_EQ(last->submap.value, first->submap.value + 1) << "no id was spent";
  EXPECT_EQ(last->view->snapshot().submaps().size(), num_submaps + 1);
  EXPECT_EQ((*store->LoadMap("room"))->submaps().size(), num_submaps + 1);

  // A failed edit loses no fused frame, and mapping continues.
  ASSERT_TRUE(Integrate(3).report.ok());
  disk.set_full(true);
  EXPECT_FALSE(clone().ok());
  EXPECT_EQ(session->View()->snapshot().info().num_frames, 4);
  EXPECT_EQ(session->View()->snapshot().submaps().size(), num_submaps + 1);
  disk.set_full(false);
  ASSERT_TRUE(Integrate(4).report.ok());
  EXPECT_TRUE(Wait<Status>([&](auto done) { session->Flush(done); }).ok());
  EXPECT_EQ((*store->LoadMap("room"))->submaps().size(), num_submaps + 1);
  EXPECT_EQ((*store->LoadMap("room"))->info().num_frames, 5);
}

TEST_F(OpenMapTest, AnEditIsVisibleOnlyOnceItIsStored) {
  auto failing = std::make_unique<FailingStore>();
  FailingStore& disk = *failing;
  store = std::move(failing);
  Open({});
  std::atomic<std::int64_t> seen_in_commit = -1;
  const auto before = session->View()->snapshot().revision();
  disk.set_before_commit([&] { seen_in_commit = session->View()->snapshot().revision(); });
  const auto edited = Wait<Result<EditOutcome>>([&](auto done) {
    session->Edit(
        [](Map& map) -> Result<SubmapId> {
          map.FindMutable(SubmapId(0))->mutable_info().display_name = "rest";
          return SubmapId(0);
        },
        done);
  });
  ASSERT_TRUE(edited.ok());
  EXPECT_EQ(seen_in_commit, before);
  EXPECT_EQ(session->View()->snapshot().revision(), before + 1);
  disk.set_before_commit({});
}

/// Moves the first object up by a metre.
Result<SubmapId> Lift(Map& map) {
  Transform T_map_submap = map.Find(SubmapId(1))->info().T_map_submap;
  T_map_submap.translation().z() += 1;
  DHPMAP_RETURN_IF_ERROR(PatchSubmap(map, SubmapId(1), {.T_map_submap = T_map_submap}).status());
  return SubmapId(1);
}

TEST_F(OpenMapTest, AMoveIsAnsweredBeforeItsVacatedSpaceIsStored) {
  auto failing = std::make_unique<FailingStore>();
  FailingStore& disk = *failing;
  store = std::move(failing);
  Open({});
  for (int i = 0; i < 3; ++i) ASSERT_TRUE(Integrate(i).report.ok());
  ASSERT_TRUE(Wait<Status>([&](auto done) { session->Flush(done); }).ok());
  std::atomic<int> num_commits = 0;
  std::promise<void> go;
  disk.set_before_commit([&, may_go = go.get_future().share()] {
    if (++num_commits == 2) may_go.wait();
  });
  const auto moved = Wait<Result<EditOutcome>>([&](auto done) { session->Edit(Lift, done); });
  ASSERT_TRUE(moved.ok()) << moved.status().ToString();
  EXPECT_EQ(session->View()->snapshot().leaving(), SubmapId(1));
  EXPECT_TRUE(testing::Eventually([&] { return num_commits == 2; })) << "nobody asks for it";
  EXPECT_GT(session->View()->snapshot().vacated()->NumFreeVoxels(), 0) << "readers do not wait for the store";
  go.set_value();
  ASSERT_TRUE(Wait<Status>([&](auto done) { session->Flush(done); }).ok());
  const int num_before = num_commits;
  const auto again = Wait<Result<EditOutcome>>([&](auto done) { session->Edit(Lift, done); });
  ASSERT_TRUE(again.ok()) << again.status().ToString();
  EXPECT_FALSE(session->View()->snapshot().leaving()) << "it is not where it was seen any more";
  EXPECT_EQ(num_commits, num_before + 1) << "nothing was left to be stored";
  disk.set_before_commit({});
}

TEST_F(OpenMapTest, VacatedSpaceOfAListsMovesIsStoredAndUndone) {
  const testing::TempDir folder;
  store = OpenSqliteStore((folder.path() / "maps.db").string()).value();
  Open({});
  for (int i = 0; i < 3; ++i) ASSERT_TRUE(Integrate(i).report.ok());
  const auto edit = [&](std::function<Result<EditMade>(Map&)> change) {
    EditRequest request{.change = std::move(change), .source = {.author = "anna"}};
    return Wait<Result<EditOutcome>>([&](auto done) { session->Edit(std::move(request), done); });
  };
  // The vacated spaces of both are in the same tiles.
  const auto list = [](Map& map) -> Result<EditMade> {
    SubmapPatch patch;
    patch.pose_change = PoseChange{.translation_m = {3.0, 0.0, 0.0}};
    EditList edits;
    for (const std::uint32_t id : {1u, 2u}) edits.edits.push_back({.target = SubmapId(id), .action = PatchEdit{patch}});
    DHPMAP_ASSIGN_OR_RETURN(const auto results, ApplyEdits(edits, map));
    return EditMade{.submap = SubmapId(), .summary = SummaryOfList(edits, results)};
  };
  const auto before = session->View()->shared_snapshot();
  const auto made = edit(list);
  ASSERT_TRUE(made.ok()) << made.status().ToString();
  EXPECT_FALSE(session->View()->snapshot().leaving()) << "it is stored with them";
  ASSERT_TRUE(Wait<Status>([&](auto done) { session->Flush(done); }).ok());
  ASSERT_TRUE(Integrate(3).report.ok());
  ASSERT_TRUE(Wait<Status>([&](auto done) { session->Flush(done); }).ok()) << "the map can still be stored";
  const auto report = store->VerifyMap("room", false, {});
  ASSERT_TRUE(report.ok());
  EXPECT_EQ(report->num_faults, 0);
  const auto undone = edit(registry->UndoOf({.count = 1, .author = "anna"}));
  ASSERT_TRUE(undone.ok()) << undone.status().ToString();
  EXPECT_EQ(session->View()->snapshot().vacated()->NumFreeVoxels(), before->vacated()->NumFreeVoxels());
}

/// A memory store of which the commit of what an edit has left waits until it may go. No other one of the same state
/// does: one may come twice, as a frame's commit is in the store before the session knows.
class WaitingStore final : public testing::WrappedStore {
 public:
  Status Commit(const StateMarks& before, const MapSnapshot& after, Durability durability) override {
    if (before.revision() == after.revision() && before.lacks_left()) may_go_.wait();
    return inner().Commit(before, after, durability);
  }

  std::promise<void> go;

 private:
  std::shared_future<void> may_go_ = go.get_future().share();
};

TEST_F(OpenMapTest, ARepeatedMoveDelaysNoFrame) {
  auto waiting = std::make_unique<WaitingStore>();
  WaitingStore& disk = *waiting;
  store = std::move(waiting);
  Open({.publish = {.frames = 1000, .delay_s = 1000}, .commit = {.frames = 2, .delay_s = 1000}});
  for (int i = 0; i < 2; ++i) ASSERT_TRUE(Integrate(i).report.ok());
  ASSERT_TRUE(testing::Eventually([&] { return store->GetMap("room")->info.num_frames == 2; }));
  const auto move = [&] {
    EditRequest request{.change = [](Map& map) -> Result<EditMade> {
      DHPMAP_ASSIGN_OR_RETURN(const SubmapId id, Lift(map));
      return EditMade{.submap = id, .summary = {}};
    }};
    request.source = {.author = "anna", .request_id = "the same", .request_fingerprint = 7};
    return Wait<Result<EditOutcome>>([&](auto done) { session->Edit(std::move(request), done); });
  };
  const auto moved = move();
  ASSERT_TRUE(moved.ok()) << moved.status().ToString();
  ASSERT_TRUE(Integrate(2).report.ok());
  ASSERT_TRUE(move().ok()) << "answered as before, while what it left is still to be stored";
  EXPECT_EQ(session->View()->snapshot().revision(), moved->view->snapshot().revision());
  disk.go.set_value();
  ASSERT_TRUE(Integrate(3).report.ok());
  EXPECT_TRUE(testing::Eventually([&] { return store->GetMap("room")->info.num_frames == 4; }))
      << "two frames make a commit, whatever came between";
}

TEST_F(OpenMapTest, NoEditOvertakesTheVacatedSpaceOfAMove) {
  auto failing = std::make_unique<FailingStore>();
  FailingStore& disk = *failing;
  store = std::move(failing);
  Open({.commit = {.retry_s = 0.005}});
  for (int i = 0; i < 3; ++i) ASSERT_TRUE(Integrate(i).report.ok());
  ASSERT_TRUE(Wait<Status>([&](auto done) { session->Flush(done); }).ok());
  std::atomic<int> num_commits = 0;
  disk.set_before_commit([&] {
    if (++num_commits == 1) disk.set_full(true);  // from the next one on
  });
  const auto moved = Wait<Result<EditOutcome>>([&](auto done) { session->Edit(Lift, done); });
  ASSERT_TRUE(moved.ok()) << "it was stored: " << moved.status().ToString();
  EXPECT_TRUE(testing::Eventually([&] { return disk.num_refused() >= 2; })) << "tried again by itself";
  const auto refused = Wait<Result<EditOutcome>>([&](auto done) { session->Edit(Lift, done); });
  EXPECT_EQ(refused.status().code(), StatusCode::kResourceExhausted);
  EXPECT_EQ(session->View()->snapshot().revision(), moved->view->snapshot().revision());
  disk.set_full(false);
  EXPECT_TRUE(Wait<Result<EditOutcome>>([&](auto done) { session->Edit(Lift, done); }).ok());
  disk.set_before_commit({});
}

TEST_F(OpenMapTest, RefusesFramesWhileTheStoreIsTooFarBehind) {
  auto failing = std::make_unique<FailingStore>();
  FailingStore& disk = *failing;
  store = std::move(failing);
  Open({.commit = {.frames = 1, .delay_s = 0.01, .retry_s = 0.01, .max_behind_s = 0.05}});
  ASSERT_TRUE(Integrate(0).report.ok());
  disk.set_full(true);
  const auto integrate_until = [&](bool wanted_ok) {
    FrameOutcome outcome{.report = Internal("it never came")};
    testing::Eventually([&] {
      outcome = Integrate(1);
      return outcome.report.ok() == wanted_ok;
    });
    return outcome;
  };
  const FrameOutcome refused = integrate_until(false);
  EXPECT_EQ(refused.report.status().reason(), Reason("STORE_BEHIND")) << refused.report.status().ToString();
  EXPECT_EQ(refused.report.status().code(), StatusCode::kUnavailable);
  EXPECT_GT(session->BehindSeconds(), 0.05);
  EXPECT_EQ(Integrate(2).report.status().reason(), Reason("STORE_BEHIND"));
  disk.set_full(false);
  EXPECT_TRUE(integrate_until(true).report.ok()) << "the store has caught up";
}

}  // namespace
}  // namespace dhpmap

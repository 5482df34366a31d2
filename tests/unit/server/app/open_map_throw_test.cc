// SPDX-License-Identifier: BSD-3-Clause
// Exceptions on a map's threads: waiting callers get an answer, nothing is lost, and the threads continue.
#include <atomic>
#include <memory>
#include <new>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "server/app/edits/submap_edits.h"
#include "tests/support/eventually.h"
#include "tests/support/wrapped_store.h"
#include "tests/unit/server/app/open_map_fixture.h"

namespace dhpmap {
namespace {

/// How often memory will run out at one place.
class Shortage {
 public:
  void Set(int num_times) { num_times_ = num_times; }
  void Meet() {
    int left = num_times_;
    while (left > 0 && !num_times_.compare_exchange_weak(left, left - 1)) continue;
    if (left > 0) throw std::bad_alloc();
  }

 private:
  std::atomic<int> num_times_ = 0;
};

constexpr int kForEver = 1 << 30;

/// A memory store that runs short of memory.
class ShortStore final : public testing::WrappedStore {
 public:
  Status Commit(const StateMarks& before, const MapSnapshot& after, Durability durability) override {
    in_commit.Meet();
    return inner().Commit(before, after, durability);
  }
  Status CommitEdit(const StateMarks& before, const MapSnapshot& after, const EditRecord& edit) override {
    in_commit.Meet();
    return inner().CommitEdit(before, after, edit);
  }
  Result<std::optional<StoredAnswer>> FindAnswer(const std::string& name, const std::string& request_id) override {
    in_find_answer.Meet();
    return inner().FindAnswer(name, request_id);
  }
  Status DeleteMap(const std::string& name) override {
    in_delete.Meet();
    return inner().DeleteMap(name);
  }
  Status Reserve(const std::string& name, const NumberMarks& marks) override {
    in_reserve.Meet();
    return inner().Reserve(name, marks);
  }

  Shortage in_commit, in_find_answer, in_delete, in_reserve;
};

/// Nothing is published or committed without a request.
OpenMapOptions Patient() {
  return {.publish = {.frames = 1000, .delay_s = 1000}, .commit = {.frames = 1000, .delay_s = 1000, .retry_s = 1000}};
}

class OpenMapThrowTest : public OpenMapTest {
 protected:
  OpenMapThrowTest() {
    auto made = std::make_unique<ShortStore>();
    disk = made.get();
    store = std::move(made);
  }
  void OpenShort(OpenMapOptions options) {
    options.now_ns = [shortage = in_publish, now_ns = std::make_shared<std::atomic<std::int64_t>>(1)] {
      shortage->Meet();
      return ++*now_ns;
    };
    Open(std::move(options));
  }
  Status Flush() {
    return Wait<Status>([&](auto done) { session->Flush(done); });
  }
  Result<EditOutcome> Clone() {
    return Wait<Result<EditOutcome>>(
        [&](auto done) { session->Edit([](Map& map) { return CloneSubmap(map, SubmapId(1), "", {}); }, done); });
  }
  Result<FinishOutcome> Finish() {
    return Wait<Result<FinishOutcome>>([&](auto done) { session->Finish(done); });
  }
  std::int64_t NumSeen() const { return session->View()->snapshot().info().num_frames; }
  std::int64_t NumStored() const { return store->GetMap("room")->info.num_frames; }

  ShortStore* disk = nullptr;
  std::shared_ptr<Shortage> in_publish = std::make_shared<Shortage>();  // asking for the time; also before a frame
};

TEST_F(OpenMapThrowTest, AFlushWhosePublishThrowsIsAnsweredAndLosesNothing) {
  OpenShort(Patient());
  ASSERT_TRUE(Integrate(0).report.ok());
  in_publish->Set(1);
  EXPECT_EQ(Flush().reason(), Reason("OUT_OF_MEMORY"));
  EXPECT_EQ(NumSeen(), 0);
  EXPECT_TRUE(Flush().ok());
  EXPECT_EQ(NumSeen(), 1);
  EXPECT_EQ(NumStored(), 1);
}

TEST_F(OpenMapThrowTest, AFlushWhoseCommitThrowsIsAnsweredAndLosesNothing) {
  OpenShort(Patient());
  ASSERT_TRUE(Integrate(0).report.ok());
  disk->in_commit.Set(1);
  const Status refused = Flush();
  EXPECT_EQ(refused.code(), StatusCode::kResourceExhausted);
  EXPECT_EQ(refused.reason(), Reason("OUT_OF_MEMORY"));
  EXPECT_EQ(NumStored(), 0);
  EXPECT_EQ(Integrate(1).commit_status.reason(), Reason("OUT_OF_MEMORY")) << "who feeds is told";
  EXPECT_TRUE(Flush().ok());
  EXPECT_EQ(NumStored(), 2);
}

TEST_F(OpenMapThrowTest, ABatchThatThrowsIsRetriedWithoutFurtherFrames) {
  OpenMapOptions options = Patient();
  options.publish.frames = options.commit.frames = 2;
  options.commit.retry_s = 0.005;
  OpenShort(std::move(options));
  ASSERT_TRUE(Integrate(0).report.ok());
  disk->in_reserve.Set(3);
  disk->in_commit.Set(3);
  const FrameOutcome fused = Integrate(1);
  EXPECT_TRUE(fused.report.ok()) << "the frame is in the map: " << fused.report.status().ToString();
  EXPECT_TRUE(testing::Eventually([&] { return NumSeen() == 2 && NumStored() == 2; }));
}

TEST_F(OpenMapThrowTest, AFrameThatRunsOutOfMemoryIsRefusedWithoutATrace) {
  OpenShort(Patient());
  const auto feed = *session->BeginFeed({.session = "robot"});
  const auto integrate = [&](std::int64_t sequence) {
    return Wait<FrameOutcome>([&](auto done) { session->Integrate(feed, sequence, FrameOf(0), done); });
  };
  ASSERT_TRUE(integrate(1).report.ok());
  auto taken = std::make_shared<std::promise<FrameOutcome>>();
  {
    // The writer asks for the time when the caller has: held up in between.
    auto go = std::make_shared<std::promise<void>>();
    session->Edit(
        [go](Map&) -> Result<SubmapId> {
          go->get_future().wait();
          return Internal("of the test");
        },
        [shortage = in_publish](const Result<EditOutcome>&) { shortage->Set(1); });
    session->Integrate(feed, 2, FrameOf(0), [taken](const FrameOutcome& outcome) { taken->set_value(outcome); });
    go->set_value();
  }
  const FrameOutcome refused = taken->get_future().get();
  EXPECT_EQ(refused.report.status().reason(), Reason("OUT_OF_MEMORY"));
  EXPECT_FALSE(refused.is_duplicate);
  const FrameOutcome again = integrate(2);
  EXPECT_TRUE(again.report.ok() && !again.is_duplicate) << "it was not fused before";
  EXPECT_TRUE(Flush().ok());
  EXPECT_EQ(NumStored(), 2);
  EXPECT_EQ(session->ProgressOf(feed).committed_sequence, 2);
}

TEST_F(OpenMapThrowTest, AnEditWhoseCommitThrowsDidNotHappen) {
  OpenShort(Patient());
  ASSERT_TRUE(Integrate(0).report.ok());
  const auto first = Clone();
  ASSERT_TRUE(first.ok()) << first.status().ToString();
  const std::int64_t seen = session->View()->snapshot().revision();
  const std::size_t num_submaps = session->View()->snapshot().submaps().size();
  disk->in_commit.Set(1);
  const auto refused = Clone();
  EXPECT_EQ(refused.status().code(), StatusCode::kResourceExhausted);
  EXPECT_EQ(refused.status().reason(), Reason("OUT_OF_MEMORY"));
  EXPECT_EQ(session->View()->snapshot().revision(), seen);
  const auto last = Clone();
  ASSERT_TRUE(last.ok()) << last.status().ToString();
  EXPECT_EQ(last->submap.value, first->submap.value + 1) << "no id was spent";
  EXPECT_EQ(last->view->snapshot().submaps().size(), num_submaps + 1);
  EXPECT_EQ((*store->LoadMap("room"))->submaps().size(), num_submaps + 1);
}

TEST_F(OpenMapThrowTest, AnEditThatThrowsAnywhereDidNotHappen) {
  OpenShort(Patient());
  ASSERT_TRUE(Integrate(0).report.ok());
  in_publish->Set(1);
  EXPECT_EQ(Clone().status().reason(), Reason("OUT_OF_MEMORY"));
  disk->in_commit.Set(1);  // of the frame, which is stored first
  EXPECT_EQ(Clone().status().reason(), Reason("OUT_OF_MEMORY"));
  const auto rename = [](Map& map) -> Result<EditMade> {
    map.FindMutable(SubmapId(1))->mutable_info().display_name = "sofa";
    return EditMade{.submap = SubmapId(1), .summary = {}};
  };
  EditRequest request{.change = rename};
  request.source.request_id = "5e6f7a0b-0000-4000-8000-000000000001";
  disk->in_find_answer.Set(1);
  const auto edit = [&] { return Wait<Result<EditOutcome>>([&](auto done) { session->Edit(request, done); }); };
  EXPECT_EQ(edit().status().reason(), Reason("OUT_OF_MEMORY"));
  EXPECT_NE(session->View()->snapshot().Find(SubmapId(1))->info().display_name, "sofa");
  ASSERT_TRUE(edit().ok());
  EXPECT_EQ(session->View()->snapshot().Find(SubmapId(1))->info().display_name, "sofa");
  EXPECT_EQ(NumStored(), 1);
}

TEST_F(OpenMapThrowTest, FinishingWhosePublishThrowsIsAnsweredAndStoredLater) {
  OpenMapOptions options = Patient();
  options.commit.delay_s = options.commit.retry_s = 0.005;
  OpenShort(std::move(options));
  const auto is_settled = [](const MapSnapshot& state) {
    for (const auto& submap : state.submaps()) {
      const SubmapInfo& info = submap->info();
      if (info.panoptic == Panoptic::kThing && info.activity == Activity::kActive) return false;
    }
    return state.info().num_frames == 1;
  };
  ASSERT_TRUE(Integrate(0).report.ok());
  ASSERT_TRUE(testing::Eventually([&] { return NumStored() == 1; }));
  in_publish->Set(3);
  const auto refused = Finish();
  EXPECT_EQ(refused.status().reason(), Reason("OUT_OF_MEMORY"));
  EXPECT_FALSE(session->Finishing().has_value());
  EXPECT_TRUE(testing::Eventually([&] { return is_settled(**store->LoadMap("room")); }));
  EXPECT_TRUE(is_settled(session->View()->snapshot()));
  EXPECT_TRUE(Finish().ok());
}

TEST_F(OpenMapThrowTest, FinishingWhoseCommitThrowsIsAnswered) {
  OpenShort(Patient());
  ASSERT_TRUE(Integrate(0).report.ok());
  disk->in_commit.Set(1);
  EXPECT_EQ(Finish().status().reason(), Reason("OUT_OF_MEMORY"));
  EXPECT_FALSE(session->Finishing().has_value());
  EXPECT_TRUE(Finish().ok());
  EXPECT_EQ(NumStored(), 1);
}

TEST_F(OpenMapThrowTest, CallbacksThatThrowAreHarmless) {
  OpenMapOptions options = Patient();
  options.commit.on_commit = [](double, const Status&) { throw std::bad_alloc(); };
  options.mapping.on_refinement = [](const RefinementReport&) { throw std::bad_alloc(); };
  OpenShort(std::move(options));
  session->Integrate(FrameOf(0), [](const FrameOutcome&) { throw std::runtime_error("of the feeder"); });
  session->Edit([](Map&) -> Result<SubmapId> { return SubmapId(0); },
                [](const Result<EditOutcome>&) { throw std::runtime_error("of the editor"); });
  session->Flush([](const Status&) { throw std::runtime_error("of who flushes"); });
  session->Finish([](const Result<FinishOutcome>&) { throw 1; });
  EXPECT_TRUE(Integrate(1).report.ok());
  EXPECT_TRUE(Clone().ok());
  EXPECT_TRUE(Finish().ok());
  EXPECT_EQ(NumStored(), 2);
}

TEST_F(OpenMapThrowTest, ADeletionThatThrowsLeavesTheMapInUse) {
  OpenShort(Patient());
  ASSERT_TRUE(Integrate(0).report.ok());
  disk->in_delete.Set(1);
  EXPECT_EQ(registry->Delete("room").status().reason(), Reason("OUT_OF_MEMORY"));
  EXPECT_TRUE(session->BeginFeed().ok()) << "its seats are open again";
  EXPECT_TRUE(Integrate(1).report.ok());
  EXPECT_TRUE(Flush().ok());
  EXPECT_EQ(NumStored(), 2);
}

TEST_F(OpenMapThrowTest, AStopStoresFusedFramesAfterAShortageOfMemory) {
  OpenShort(Patient());
  ASSERT_TRUE(Integrate(0).report.ok());
  in_publish->Set(1);
  disk->in_reserve.Set(kForEver);  // also when numbers are given back
  EXPECT_TRUE(registry->Shutdown().ok());
  EXPECT_EQ(NumStored(), 1);
}

TEST_F(OpenMapThrowTest, AStopReportsWhatCouldNotBeStored) {
  OpenShort(Patient());
  ASSERT_TRUE(Integrate(0).report.ok());
  in_publish->Set(kForEver);
  EXPECT_EQ(registry->Shutdown().reason(), Reason("OUT_OF_MEMORY"));
  EXPECT_EQ(NumStored(), 0);
}

}  // namespace
}  // namespace dhpmap

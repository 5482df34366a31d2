// SPDX-License-Identifier: BSD-3-Clause
#include "tests/rig/ledger/phases.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <atomic>
#include <thread>

#include "mapping/base/this_thread.h"

namespace dhpmap::rig {
namespace {

/// A thread of a name, which runs until it is let go.
class NamedThread {
 public:
  explicit NamedThread(const char* name) {
    thread_ = std::thread([this, name] {
      NameThisThread(name);
      is_named_ = true;
      while (!is_over_) std::this_thread::yield();
    });
    while (!is_named_) std::this_thread::yield();
  }
  ~NamedThread() {
    is_over_ = true;
    thread_.join();
  }
  NamedThread(const NamedThread&) = delete;
  NamedThread& operator=(const NamedThread&) = delete;

 private:
  std::atomic<bool> is_named_ = false, is_over_ = false;
  std::thread thread_;
};

TEST(Phases, ACallCountsWhileItIsUnderWay) {
  CallsUnderWay calls;
  PhaseWatch watch(getpid(), calls);
  EXPECT_FALSE(watch.Look()[Phase::kEdits]);
  {
    const CallUnderWay one(calls, Phase::kEdits), two(calls, Phase::kEdits), other(calls, Phase::kBackup);
    const ByPhase<bool> seen = watch.Look();
    EXPECT_TRUE(seen[Phase::kEdits] && seen[Phase::kBackup]);
    EXPECT_FALSE(seen[Phase::kMapping] || seen[Phase::kRefinement] || seen[Phase::kCollection]);
  }
  EXPECT_FALSE(watch.Look()[Phase::kEdits] || watch.Look()[Phase::kBackup]);
}

TEST(Phases, RefinementIsSeenByItsThread) {
  CallsUnderWay calls;
  PhaseWatch watch(getpid(), calls);
  {
    const NamedThread refinement("refinement");
    EXPECT_TRUE(watch.Look()[Phase::kRefinement]);
    EXPECT_TRUE(ThreadsNamed(getpid(), "refinement").is_there);
  }
  EXPECT_FALSE(ThreadsNamed(getpid(), "reclaim-space").is_there);
  EXPECT_FALSE(ThreadsNamed(getpid(), "refine").is_there) << "not by a part of a name";
}

TEST(Phases, EveryEditIsOneAndAQuestionIsNone) {
  for (const char* edit : {"CloneSubmap", "UpdateSubmap", "DeleteSubmap", "ApplyEdits", "UndoEdits", "RedoEdits"}) {
    EXPECT_EQ(PhaseOfCall(edit), Phase::kEdits) << edit;
  }
  EXPECT_EQ(PhaseOfCall("FinishMapping"), Phase::kRefinement);
  EXPECT_EQ(PhaseOfCall("ListSubmaps"), std::nullopt);
}

}  // namespace
}  // namespace dhpmap::rig

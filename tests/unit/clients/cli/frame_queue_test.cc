// SPDX-License-Identifier: BSD-3-Clause
#include "clients/cli/frame_queue.h"

#include <gtest/gtest.h>

#include <atomic>
#include <numeric>

namespace dhpmap {
namespace {

/// Frames 0, 1, ... without end; every tenth cannot be read.
class EndlessDataset final : public Dataset {
 public:
  const std::vector<LabelClass>& label_classes() const override { return classes_; }
  std::string preset() const override { return "indoor"; }
  bool has_persistent_ids() const override { return false; }
  std::size_t num_frames() const override { return 1'000'000; }
  Result<DatasetFrame> Read(std::size_t index) override {
    ++num_read;
    if (index % 10 == 9) return NotFound("frame lost").WithReason("MISSING_FILE");
    DatasetFrame frame;
    frame.stamp_ns = static_cast<std::int64_t>(index);
    return frame;
  }
  std::atomic<std::size_t> num_read = 0;

 private:
  std::vector<LabelClass> classes_;
};

std::vector<std::size_t> FirstIndices(std::size_t count) {
  std::vector<std::size_t> indices(count);
  std::iota(indices.begin(), indices.end(), 0);
  return indices;
}

void Ignore(std::size_t, const Status&) {}

TEST(FrameQueue, GivesEveryFrameInTheOrderAskedForOrSaysWhyNot) {
  EndlessDataset dataset;
  std::vector<std::size_t> skipped;  // written by the queue's thread, read once it has ended
  std::vector<std::size_t> given;
  {
    FrameQueue queue(dataset, {7, 9, 3, 3, 19, 20}, false, [&](std::size_t index, const Status& why) {
      EXPECT_EQ(why.reason(), Reason("MISSING_FILE"));
      skipped.push_back(index);
    });
    while (auto frame = queue.Next()) {
      EXPECT_EQ(frame->message.stamp_ns(), static_cast<std::int64_t>(frame->index));
      given.push_back(frame->index);
    }
    EXPECT_FALSE(queue.Next()) << "and again";
  }
  EXPECT_EQ(given, (std::vector<std::size_t>{7, 3, 3, 20}));
  EXPECT_EQ(skipped, (std::vector<std::size_t>{9, 19}));
}

TEST(FrameQueue, OfNothingIsAtItsEnd) {
  EndlessDataset dataset;
  FrameQueue none(dataset, {}, false, Ignore);
  EXPECT_FALSE(none.Next());
  FrameQueue all_bad(dataset, {9, 19, 29}, false, Ignore);
  EXPECT_FALSE(all_bad.Next());
}

TEST(FrameQueue, ReadsAFewFramesAheadAndNoMore) {
  EndlessDataset dataset;
  FrameQueue queue(dataset, FirstIndices(200), false, Ignore);
  for (std::size_t num_taken = 1; queue.Next(); ++num_taken) {
    EXPECT_LE(dataset.num_read, num_taken + num_taken / 9 + 10) << "what was taken and skipped, and a few";
  }
}

TEST(FrameQueue, StopDropsWhatIsReadAndEndsTheReading) {
  EndlessDataset dataset;
  FrameQueue queue(dataset, FirstIndices(1'000'000), false, Ignore);
  EXPECT_TRUE(queue.Next());
  queue.Stop();
  EXPECT_FALSE(queue.Next());
  queue.Stop();
  EXPECT_FALSE(queue.Next());
}

TEST(FrameQueue, StopWakesWhoWaitsAndTheEndWakesTheReader) {
  EndlessDataset dataset;
  for (int round = 0; round < 50; ++round) {
    FrameQueue queue(dataset, FirstIndices(1'000'000), false, Ignore);
    std::thread taker([&queue] {
      while (queue.Next()) continue;
    });
    queue.Stop();
    taker.join();
  }
  for (int round = 0; round < 50; ++round) {  // the reader waits for room, or is about to
    const FrameQueue queue(dataset, FirstIndices(1'000'000), false, Ignore);
  }
}

}  // namespace
}  // namespace dhpmap

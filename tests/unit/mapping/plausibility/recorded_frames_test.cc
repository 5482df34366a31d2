// SPDX-License-Identifier: BSD-3-Clause
// Recordings of others: no frame of them is doubted, and each mistake is found. Where they are absent, tests skip.
#include <gtest/gtest.h>

#include <optional>

#include "clients/datasets/dataset.h"
#include "clients/datasets/open_dataset.h"
#include "mapping/pipeline/map_builder.h"
#include "mapping/plausibility/frame_judge.h"
#include "tests/unit/mapping/plausibility/mistakes.h"
#include "tests/unit/mapping/plausibility/walked_room.h"

namespace dhpmap {
namespace {

using testing::FuseAndCheck;
using testing::Mistake;
using testing::MistakesOfDepthCameras;
using testing::Tells;
using testing::Told;

/// A data set of the developers, or nothing where it is not there.
class Recording {
 public:
  static std::optional<Recording> Open(const std::string& folder, LabelSource labels) {
    const auto root = testing::SharedDataDir();
    if (root.empty() || !std::filesystem::exists(root / folder)) return std::nullopt;
    auto dataset = OpenDataset((root / folder).string(), kAnyFormat, labels);
    EXPECT_TRUE(dataset.ok()) << dataset.status().ToString();
    if (!dataset.ok()) return std::nullopt;
    return Recording(*std::move(dataset));
  }

  [[nodiscard]] std::size_t num_frames() const { return dataset_->num_frames(); }
  [[nodiscard]] MapBuilder NewMap() const {
    MapInfo info = testing::EmptyMap();
    EXPECT_TRUE(ApplyPreset(dataset_->preset(), info.config).ok());
    if (!dataset_->label_classes().empty()) {
      info.label_set = std::make_shared<const LabelSet>(LabelSet::Create(dataset_->label_classes()).value());
    }
    return {std::move(info), 1};
  }
  PanopticFrame Frame(std::size_t i) { return DecodeFrame(dataset_->Read(i).value(), false).value(); }

 private:
  explicit Recording(std::unique_ptr<Dataset> dataset) : dataset_(std::move(dataset)) {}
  std::unique_ptr<Dataset> dataset_;
};

void ExpectNoDoubt(const char* folder, LabelSource labels) {
  auto recording = Recording::Open(folder, labels);
  if (!recording) GTEST_SKIP() << "there is no " << folder << " in ../shared/data";
  MapBuilder builder = recording->NewMap();
  for (std::size_t i = 0; i < recording->num_frames(); ++i) {
    const FrameCheck check = FuseAndCheck(builder, recording->Frame(i));
    EXPECT_TRUE(check.IsPlausible()) << folder << " " << i << ": " << Told(check);
    if (i == 0) continue;
    ASSERT_TRUE(check.fit && check.fit->agreeing_fraction) << folder << " " << i;
    EXPECT_GT(check.fit->agreeing_fraction, 0.8) << folder << " " << i;
    EXPECT_LT(check.fit->median_residual_m, 0.5 * builder.map().info().config.voxel_size_m) << folder << " " << i;
  }
}

TEST(RecordedFrames, NoneOfARenderedHouseIsDoubted) { ExpectNoDoubt("house", LabelSource::kPredicted); }
TEST(RecordedFrames, NoneOfARealKitchenIsDoubted) { ExpectNoDoubt("sevenscenes", LabelSource::kNone); }
TEST(RecordedFrames, NoneOfRealScansIsDoubted) {
  ExpectNoDoubt("kitti/sequences/00", LabelSource::kPredicted);
  ExpectNoDoubt("kitti/sequences/07", LabelSource::kPredicted);
}

TEST(RecordedFrames, EachMistakeIsFoundWithinTenFramesOfAHouse) {
  auto recording = Recording::Open("house", LabelSource::kPredicted);
  if (!recording) GTEST_SKIP() << "there is no house in ../shared/data";
  for (const std::size_t start : {std::size_t{0}, std::size_t{60}}) {
    for (const Mistake& mistake : MistakesOfDepthCameras()) {
      MapBuilder builder = recording->NewMap();
      int found_at = -1;
      for (int i = 0; i < 10 && found_at < 0; ++i) {
        PanopticFrame frame = recording->Frame(start + static_cast<std::size_t>(i));
        mistake.make(frame);
        const FrameCheck check = FuseAndCheck(builder, frame);
        EXPECT_TRUE(check.IsPlausible() || Tells(check, mistake.fault)) << FaultName(mistake.fault) << Told(check);
        if (Tells(check, mistake.fault)) found_at = i;
      }
      EXPECT_GE(found_at, 0) << FaultName(mistake.fault) << " from frame " << start;
    }
  }
}

TEST(RecordedFrames, InvertedPosesOfScansContradictTheMap) {
  for (const char* const folder : {"kitti/sequences/00", "kitti/sequences/07"}) {
    auto recording = Recording::Open(folder, LabelSource::kPredicted);
    if (!recording) GTEST_SKIP() << "there is no " << folder << " in ../shared/data";
    for (const std::size_t first_wrong : {std::size_t{0}, std::size_t{5}}) {
      MapBuilder builder = recording->NewMap();
      std::string told;
      for (std::size_t i = 0; i < recording->num_frames(); ++i) {
        PanopticFrame frame = recording->Frame(i);
        if (i >= first_wrong) frame.T_map_sensor = frame.T_map_sensor.inverse();
        told += Told(FuseAndCheck(builder, frame));
      }
      const FrameFault fault = first_wrong == 0 ? FrameFault::kDisagrees : FrameFault::kPoseInverted;
      EXPECT_NE(told.find(FaultName(fault)), std::string::npos) << folder << " from " << first_wrong << ": " << told;
    }
  }
}

TEST(RecordedFrames, EachMistakeOfASecondClientIsFoundOnAGoodMapOfAHouse) {
  auto recording = Recording::Open("house", LabelSource::kPredicted);
  if (!recording) GTEST_SKIP() << "there is no house in ../shared/data";
  MapBuilder first = recording->NewMap();
  constexpr std::size_t kNumOfFirst = 20;
  for (std::size_t i = 0; i < kNumOfFirst; ++i) (void)FuseAndCheck(first, recording->Frame(i));
  for (const Mistake& mistake : MistakesOfDepthCameras()) {
    MapBuilder builder(first.map().Publish(0), 1);
    bool is_found = false;
    for (std::size_t i = 0; i < 10 && !is_found; ++i) {
      PanopticFrame frame = recording->Frame(i);
      frame.session = "second";
      mistake.make(frame);
      is_found = Tells(FuseAndCheck(builder, frame), mistake.fault);
    }
    EXPECT_TRUE(is_found) << FaultName(mistake.fault);
  }
}

}  // namespace
}  // namespace dhpmap

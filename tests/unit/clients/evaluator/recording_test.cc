// SPDX-License-Identifier: BSD-3-Clause
#include "clients/evaluator/recording.h"

#include <gtest/gtest.h>

#include <array>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "clients/datasets/open_dataset.h"
#include "clients/evaluator/class_map.h"
#include "tests/support/scenes.h"
#include "tests/unit/clients/datasets/dataset_files.h"

namespace dhpmap::evaluator {
namespace {

using dhpmap::testing::SharedDataDir;

std::vector<PanopticFrame> FramesOf(const std::string& folder, LabelSource labels, double min_score = 0) {
  auto recording = Recording::Open(folder, kAnyFormat, labels, 0, std::size_t{1} << 30);
  if (recording.ok()) recording->set_min_score(min_score);
  std::vector<PanopticFrame> frames;
  const auto keep = [&frames](const PanopticFrame& frame) {
    frames.push_back(frame);
    return Status::Ok();
  };
  EXPECT_TRUE(recording.ok() && recording->ForEach(keep).ok());
  return frames;
}

std::map<std::uint32_t, std::uint32_t> ClassesOf(const PanopticFrame& frame) {
  std::map<std::uint32_t, std::uint32_t> classes;
  for (const SegmentInfo& segment : frame.segments) {
    if (segment.class_id) classes[segment.id.value] = segment.class_id->value;
  }
  return classes;
}

/// Segments by point: the ground truth's scans leave out what moves.
std::map<std::array<float, 3>, std::uint32_t> SegmentsByPoint(const LidarData& scan) {
  std::map<std::array<float, 3>, std::uint32_t> segments;
  for (std::size_t i = 0; i < scan.points_m.size(); ++i) {
    const Eigen::Vector3f& p = scan.points_m[i];
    segments[{p.x(), p.y(), p.z()}] = scan.segments[i];
  }
  return segments;
}

struct Tally {
  int num_points = 0, num_right = 0, num_kept = 0;
};

/// Of points that the camera does not see and that have a thing's segment: how many the ground truth agrees with, and
/// how many still have it in the recording.
Tally HiddenThings(const std::string& folder) {
  const auto dataset = OpenDataset(folder, kAnyFormat, LabelSource::kPredicted, {.drop_moving_points = false}).value();
  const auto recorded = FramesOf(folder, LabelSource::kPredicted), truth = FramesOf(folder, LabelSource::kGroundTruth);
  const ClassMap class_map = ClassMap::Read(folder + "/evaluation_classes.csv").value();
  Tally tally;
  for (std::size_t f = 0; f < dataset->num_frames(); ++f) {
    const PanopticFrame frame = DecodeFrame(dataset->Read(f).value(), false).value();
    auto predicted = ClassesOf(frame), real = ClassesOf(truth[f]);
    auto true_segments = SegmentsByPoint(*truth[f].lidar);
    EXPECT_EQ(recorded[f].lidar->points_m.size(), frame.lidar->points_m.size());
    for (std::size_t i = 0; i < frame.lidar->points_m.size(); ++i) {
      const Eigen::Vector3f& p = frame.lidar->points_m[i];
      const std::int16_t label = class_map.OfPrediction(predicted[frame.lidar->segments[i]]);
      const std::int16_t right = class_map.OfTruth(real[true_segments[{p.x(), p.y(), p.z()}]]);
      if (frame.lidar->is_hidden[i] == 0 || label < 0 || right < 0) continue;
      if (!class_map.classes()[static_cast<std::size_t>(label)].is_thing) continue;
      tally.num_points += 1;
      tally.num_right += label == right;
      tally.num_kept += recorded[f].lidar->segments[i] != 0;
    }
  }
  return tally;
}

TEST(Recording, ForgetsLabelsOfHiddenThingsWhichAreWrong) {
  const auto data = SharedDataDir();
  if (data.empty()) GTEST_SKIP() << "no shared data";
  for (const char* sequence : {"00", "07"}) {
    const Tally tally = HiddenThings((data / "kitti/sequences" / sequence).string());
    EXPECT_GT(tally.num_points, 1000);
    EXPECT_LT(tally.num_right, tally.num_points / 20);
    EXPECT_EQ(tally.num_kept, 0);
  }
}

/// Segments that say what they are, although the network gives them less.
int NumBelow(float score, const std::vector<PanopticFrame>& frames) {
  int number = 0;
  for (const PanopticFrame& frame : frames) {
    for (const SegmentInfo& segment : frame.segments) {
      number += segment.class_id && segment.score > 0 && segment.score < score;
    }
  }
  return number;
}

TEST(Recording, ForgetsWhatTheNetworkDoubtsForEverySystem) {
  const auto data = SharedDataDir();
  if (data.empty()) GTEST_SKIP() << "no shared data";
  const std::string folder = (data / "kitti/sequences/00").string();
  EXPECT_GT(NumBelow(0.6f, FramesOf(folder, LabelSource::kPredicted)), 50);
  const auto frames = FramesOf(folder, LabelSource::kPredicted, 0.6);
  EXPECT_EQ(NumBelow(0.6f, frames), 0);
  EXPECT_GT(NumBelow(2.0f, frames), 10);
  EXPECT_FALSE(ClassesOf(frames.front()).empty());
}

PanopticFrame FirstOf(Result<Recording> recording) {
  PanopticFrame first;
  EXPECT_TRUE(recording.ok()) << recording.status().ToString();
  if (!recording.ok()) return first;
  const Status status = recording->ForEach([&first](const PanopticFrame& frame) {
    first = frame;
    return Status::Ok();
  });
  EXPECT_TRUE(status.ok()) << status.ToString();
  return first;
}

TEST(Recording, OfWhatWasMeasuredHasEveryPointThatASystemIsGivenWhateverItsLabel) {
  const dhpmap::testing::TempDir temp;
  const std::filesystem::path sequence = temp.path() / "dataset/sequences/07";
  dhpmap::testing::WriteKittiSequence(sequence);
  const PanopticFrame measured = FirstOf(Recording::OpenMeasured(sequence.string(), kAnyFormat, 0));
  const PanopticFrame given = FirstOf(Recording::Open(sequence.string(), kAnyFormat, LabelSource::kPredicted, 0, 0));
  const PanopticFrame static_only =
      FirstOf(Recording::Open(sequence.string(), kAnyFormat, LabelSource::kGroundTruth, 0, 0));
  EXPECT_EQ(measured.lidar->points_m, given.lidar->points_m);
  ASSERT_EQ(measured.lidar->points_m.size(), 4u) << "not the one behind the camera: the sensor is both together";
  EXPECT_EQ(static_only.lidar->points_m.size(), 3u);
  EXPECT_EQ(measured.lidar->segments.back(), kNoSegment.value) << "it moves";
  EXPECT_NE(measured.lidar->segments.front(), kNoSegment.value);
}

TEST(Recording, OfTheGroundTruthHasNoHiddenPoints) {
  const auto data = SharedDataDir();
  if (data.empty()) GTEST_SKIP() << "no shared data";
  for (const PanopticFrame& frame : FramesOf((data / "kitti/sequences/07").string(), LabelSource::kGroundTruth)) {
    EXPECT_TRUE(frame.lidar->is_hidden.empty()) << "its labels are the points' own";
  }
}

}  // namespace
}  // namespace dhpmap::evaluator

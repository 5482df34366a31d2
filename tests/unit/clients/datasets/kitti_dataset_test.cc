// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "clients/datasets/dataset.h"
#include "clients/datasets/open_dataset.h"
#include "clients/datasets/semantic_kitti_classes.h"
#include "tests/support/scenes.h"
#include "tests/unit/clients/datasets/dataset_files.h"

namespace dhpmap::testing {
namespace {

class KittiDataset : public ::testing::Test {
 protected:
  void SetUp() override { WriteKittiSequence(sequence()); }
  [[nodiscard]] std::filesystem::path sequence() const { return temp_.path() / "dataset/sequences/07"; }
  [[nodiscard]] Result<std::unique_ptr<Dataset>> Open(LabelSource labels, const DatasetOptions& options = {}) const {
    return OpenDataset(sequence().string(), kAnyFormat, labels, options);
  }

 private:
  TempDir temp_;
};

TEST_F(KittiDataset, PoseTakesTheScannerToTheFirstScan) {
  const DatasetFrame frame = (*Open(LabelSource::kNone))->Read(0).value();
  Eigen::Matrix4d expected = Eigen::Matrix4d::Identity();
  expected(0, 3) = 2;  // the camera's z is the scanner's x
  EXPECT_TRUE(frame.T_map_sensor.isApprox(expected, 1e-12)) << frame.T_map_sensor;
  EXPECT_EQ(frame.stamp_ns, 150'000'000);
}

TEST_F(KittiDataset, TheBenchmarksGroundTruthPosesComeFirst) {
  WriteText(sequence().parent_path().parent_path() / "poses/07.txt", "1 0 0 0 0 1 0 0 0 0 1 5\n");
  EXPECT_DOUBLE_EQ((*Open(LabelSource::kNone))->Read(0)->T_map_sensor(0, 3), 5);
}

TEST_F(KittiDataset, UnlabelledAndMovingPointsAreDropped) {
  EXPECT_EQ((*Open(LabelSource::kPredicted))->Read(0)->lidar->points_m.size(), 4u);
  EXPECT_EQ((*Open(LabelSource::kPredicted, {.drop_moving_points = false}))->Read(0)->lidar->points_m.size(), 5u);
  std::filesystem::remove_all(sequence() / "labels");
  EXPECT_EQ((*Open(LabelSource::kPredicted))->Read(0)->lidar->points_m.size(), 5u);
}

TEST_F(KittiDataset, PointsThatMoveMayStayWithoutALabel) {
  const DatasetFrame with = (*Open(LabelSource::kGroundTruth, {.drop_moving_points = false}))->Read(0).value();
  const DatasetFrame without =
      (*Open(LabelSource::kGroundTruth, {.drop_moving_points = false, .unlabel_moving_points = true}))->Read(0).value();
  ASSERT_EQ(with.lidar->segments.size(), 5u);
  ASSERT_EQ(without.lidar->points_m, with.lidar->points_m);
  int num_moving = 0;
  for (std::size_t i = 0; i < with.lidar->segments.size(); ++i) {
    const bool is_moving = KittiLabel(with.lidar->segments[i]).is_moving();
    EXPECT_EQ(without.lidar->segments[i], is_moving ? 0 : with.lidar->segments[i]);
    num_moving += is_moving;
  }
  EXPECT_EQ(num_moving, 1);
  for (const SegmentInfo& segment : without.segments) EXPECT_FALSE(KittiLabel(segment.id.value).is_moving());
}

TEST_F(KittiDataset, PredictedPointsTakeIdsAndColourFromTheImage) {
  const auto dataset = Open(LabelSource::kPredicted);
  ASSERT_TRUE(dataset.ok()) << dataset.status().ToString();
  EXPECT_EQ((*dataset)->preset(), "outdoor_lidar");
  const DatasetFrame raw = (*dataset)->Read(0).value();
  EXPECT_TRUE(raw.lidar->segments.empty());
  EXPECT_EQ(raw.lidar->image_width_px, 8);
  EXPECT_EQ(raw.lidar->image_height_px, 4);
  ASSERT_EQ(raw.segments.size(), 2u);
  EXPECT_EQ(raw.segments[1].class_id, ClassId(14));
  const auto frame = DecodeFrame(raw, false);
  ASSERT_TRUE(frame.ok()) << frame.status().ToString();
  // u = 4 - 4 y / x: pixels 2, 4 and 5; the point behind the camera is gone.
  EXPECT_EQ(frame->lidar->segments, (std::vector<std::uint32_t>{2, 1, 1}));
  EXPECT_EQ(frame->lidar->color[0], (Color{0, 0, 255}));
}

TEST_F(KittiDataset, GroundTruthIdsMeanTheSameObjectInEveryScan) {
  const auto dataset = Open(LabelSource::kGroundTruth);
  ASSERT_TRUE(dataset.ok()) << dataset.status().ToString();
  EXPECT_TRUE((*dataset)->has_persistent_ids());
  const DatasetFrame frame = (*dataset)->Read(0).value();
  const std::uint32_t car = 10u | 3u << 16;
  EXPECT_EQ(frame.lidar->segments, (std::vector<std::uint32_t>{car, 40, 0, 50}))
      << "a car without instance is no object";
  ASSERT_EQ(frame.segments.size(), 3u);
  EXPECT_EQ(frame.segments[0].id, SegmentId(car));
  EXPECT_EQ(frame.segments[0].class_id, ClassId(10));
  EXPECT_EQ(frame.segments[2].class_id, ClassId(50));
}

TEST_F(KittiDataset, WithoutImagesTheWholeScanIsThereAndPredictionsAreNot) {
  std::filesystem::remove_all(sequence() / "image_2");
  const DatasetFrame frame = (*Open(LabelSource::kGroundTruth))->Read(0).value();
  EXPECT_EQ(frame.lidar->image_width_px, 0);
  EXPECT_EQ(DecodeFrame(frame, true)->lidar->points_m.size(), 4u);
  EXPECT_EQ(Open(LabelSource::kPredicted).status().reason(), Reason("NO_LABELS"));
}

TEST_F(KittiDataset, TheRootOfSeveralSequencesOpensTheFirst) {
  const auto root = sequence().parent_path().parent_path();
  const auto dataset = OpenDataset(root.string(), kAnyFormat, LabelSource::kNone);
  ASSERT_TRUE(dataset.ok()) << dataset.status().ToString();
  EXPECT_EQ((*dataset)->num_frames(), 1u);
}

TEST_F(KittiDataset, BrokenScansSayWhatIsWrong) {
  const auto dataset = std::move(*Open(LabelSource::kGroundTruth));
  WriteText(sequence() / "labels/000000.label", "1234");
  EXPECT_EQ(dataset->Read(0).status().reason(), Reason("BAD_SCAN"));
  WriteText(sequence() / "velodyne/000000.bin", "12345");
  EXPECT_EQ(dataset->Read(0).status().reason(), Reason("BAD_SCAN"));
  WriteKittiSequence(sequence());
  WriteText(sequence() / "image_2/000000.png", "no image");
  EXPECT_EQ(dataset->Read(0).status().reason(), Reason("BAD_IMAGE"));
  std::filesystem::remove(sequence() / "labels/000000.label");
  EXPECT_EQ(dataset->Read(0).status().reason(), Reason("MISSING_FILE"));
}

TEST_F(KittiDataset, ScansWithoutAPoseAreSkippedByNumber) {
  WriteValues<float>(sequence() / "velodyne/000004.bin", {1, 0, 0, 0});
  const auto dataset = std::move(*Open(LabelSource::kNone));
  ASSERT_EQ(dataset->num_frames(), 2u);
  EXPECT_TRUE(dataset->Read(0).ok());
  EXPECT_EQ(dataset->Read(1).status().reason(), Reason("NO_MATCH"));
}

TEST_F(KittiDataset, BrokenCalibrationFailsAtOpening) {
  WriteText(sequence() / "calib.txt", "P2: 4 0 4 0 0 4 2 0 0 0 1 0\n");
  EXPECT_NE(Open(LabelSource::kNone).status().message().find("Tr:"), std::string::npos);
  WriteText(sequence() / "calib.txt", "P2: 4 0 4 0 0 4 2 0 0 0 1\nTr: 0 -1 0 0 0 0 -1 0 1 0 0 0\n");
  EXPECT_NE(Open(LabelSource::kNone).status().message().find("12 numbers"), std::string::npos);
  std::filesystem::remove(sequence() / "calib.txt");
  EXPECT_EQ(Open(LabelSource::kNone).status().code(), StatusCode::kNotFound);
}

TEST(SemanticKittiClasses, AreAValidLabelSet) {
  EXPECT_EQ(SemanticKittiClasses().size(), 32u);
  const auto set = LabelSet::Create(SemanticKittiClasses());
  ASSERT_TRUE(set.ok()) << set.status().ToString();
  EXPECT_EQ(set->Find(ClassId(30))->name, "person");
  EXPECT_EQ(set->Find(ClassId(80))->panoptic, Panoptic::kStuff);
}

TEST(SharedKitti, ReadsUnchangedWithEveryLabelSource) {
  const std::filesystem::path data = SharedDataDir();
  if (data.empty()) GTEST_SKIP() << "no shared data on this machine";
  for (const char* sequence : {"00", "07"}) {
    for (LabelSource labels : {LabelSource::kPredicted, LabelSource::kGroundTruth, LabelSource::kNone}) {
      const auto dataset = OpenDataset((data / "kitti/sequences" / sequence).string(), kAnyFormat, labels);
      ASSERT_TRUE(dataset.ok()) << dataset.status().ToString();
      ASSERT_EQ((*dataset)->num_frames(), 10u);
      const auto raw = (*dataset)->Read(9);
      ASSERT_TRUE(raw.ok()) << raw.status().ToString();
      const auto frame = DecodeFrame(*raw, (*dataset)->has_persistent_ids());
      ASSERT_TRUE(frame.ok()) << frame.status().ToString();
      EXPECT_GT(frame->lidar->points_m.size(), 10'000u);
      const Status status = ValidateFrame(*frame, *LabelSet::Create((*dataset)->label_classes()));
      EXPECT_TRUE(status.ok()) << status.ToString();
    }
  }
}

}  // namespace
}  // namespace dhpmap::testing

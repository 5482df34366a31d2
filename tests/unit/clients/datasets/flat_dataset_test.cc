// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "clients/datasets/dataset.h"
#include "clients/datasets/open_dataset.h"
#include "tests/support/scenes.h"
#include "tests/unit/clients/datasets/dataset_files.h"

namespace dhpmap::testing {
namespace {

class FlatDataset : public ::testing::Test {
 protected:
  void SetUp() override { WriteFlatDataset(root()); }
  [[nodiscard]] std::filesystem::path root() const { return temp_.path() / "house"; }
  [[nodiscard]] std::unique_ptr<Dataset> Open(LabelSource labels) const {
    auto dataset = OpenDataset(root().string(), kAnyFormat, labels);
    EXPECT_TRUE(dataset.ok()) << dataset.status().ToString();
    return dataset.ok() ? std::move(*dataset) : nullptr;
  }

 private:
  TempDir temp_;
};

TEST_F(FlatDataset, FramesAreSortedByTime) {
  const auto dataset = Open(LabelSource::kNone);
  ASSERT_EQ(dataset->num_frames(), 2u);
  EXPECT_EQ(dataset->Read(0)->id, "000000");
  EXPECT_EQ(dataset->Read(0)->stamp_ns, 1600000000100000000);
  EXPECT_EQ(dataset->Read(1)->id, "000001");
  EXPECT_EQ(dataset->preset(), "indoor");
}

TEST_F(FlatDataset, PredictedSegmentsTakeTheirClassFromTheTable) {
  const auto dataset = Open(LabelSource::kPredicted);
  const DatasetFrame frame = dataset->Read(0).value();
  ASSERT_EQ(frame.segments.size(), 3u);
  EXPECT_EQ(frame.segments[0].id, SegmentId(1));
  EXPECT_EQ(frame.segments[0].class_id, ClassId(55));
  EXPECT_FLOAT_EQ(frame.segments[0].score.value_or(0), 0.9f);
  EXPECT_EQ(frame.segments[1].class_id, ClassId(53));
  EXPECT_EQ(frame.segments[2].class_id, std::nullopt) << "the unknown category has no class";
  EXPECT_FALSE(dataset->has_persistent_ids());
}

TEST_F(FlatDataset, SegmentsMaySayHowLikelyEachClassIs) {
  const auto dataset = Open(LabelSource::kPredicted);
  WriteText(root() / "run1" / "000000_labels.json",
            R"([{"id": 1, "category_id": 55, "class_scores": {"53": 0.25, "55": 0.5}}, {"id": 2, "category_id": 53}])");
  const DatasetFrame frame = dataset->Read(0).value();
  const std::vector<ClassScore> scores{{ClassId(53), 0.25f}, {ClassId(55), 0.5f}};
  EXPECT_EQ(frame.segments[0].class_scores, scores);
  EXPECT_TRUE(frame.segments[1].class_scores.empty());
}

TEST_F(FlatDataset, PredictedClassesLeaveOutTheUnknownOnesAndMakeUpColours) {
  const auto dataset = Open(LabelSource::kPredicted);
  const std::vector<LabelClass>& classes = dataset->label_classes();
  ASSERT_EQ(classes.size(), 2u);
  EXPECT_EQ(classes[0].name, "wall");
  EXPECT_EQ(classes[0].panoptic, Panoptic::kStuff);
  EXPECT_EQ(classes[0].size, SizeClass::kLarge);
  EXPECT_EQ(classes[1].name, "person");
  EXPECT_EQ(classes[1].panoptic, Panoptic::kThing);
  EXPECT_NE(classes[0].color, classes[1].color);
}

TEST_F(FlatDataset, GroundTruthInstancesShareTheirClass) {
  const auto dataset = Open(LabelSource::kGroundTruth);
  EXPECT_TRUE(dataset->has_persistent_ids());
  ASSERT_EQ(dataset->label_classes().size(), 2u);
  EXPECT_EQ(dataset->label_classes()[0].name, "Floor");
  EXPECT_EQ(dataset->label_classes()[1].name, "Chair");
  EXPECT_EQ(dataset->label_classes()[1].color, (Color{10, 20, 30}));
  const DatasetFrame frame = dataset->Read(1).value();
  ASSERT_EQ(frame.segments.size(), 3u);
  EXPECT_EQ(frame.segments[0].class_id, ClassId(12));
  EXPECT_EQ(frame.segments[1].class_id, ClassId(12));
  EXPECT_EQ(frame.segments[2].class_id, ClassId(4));
}

TEST_F(FlatDataset, TheRecordingItselfOpensTooAndFindsTheTablesBesideIt) {
  for (const char* directory : {"run1", "run1/"}) {
    const auto dataset = OpenDataset((root() / directory).string(), "flat", LabelSource::kGroundTruth);
    ASSERT_TRUE(dataset.ok()) << dataset.status().ToString();
    EXPECT_EQ((*dataset)->num_frames(), 2u);
  }
}

TEST_F(FlatDataset, DecodesImagesWithTheCameraBesideThem) {
  const auto dataset = Open(LabelSource::kPredicted);
  const Result<PanopticFrame> frame = DecodeFrame(*dataset->Read(0), false);
  ASSERT_TRUE(frame.ok()) << frame.status().ToString();
  EXPECT_EQ(frame->camera->camera.width_px, 4);
  EXPECT_EQ(frame->camera->camera.cx_px, 1.5);
  EXPECT_EQ(frame->camera->depth_m, std::vector<float>(12, 2.0f));
  EXPECT_EQ(frame->camera->color[5], (Color{255, 0, 0}));
  EXPECT_EQ(frame->camera->segments[6], 2u);
  EXPECT_TRUE(frame->unlisted_ids_are_unknown);
}

TEST_F(FlatDataset, WithoutACameraFileTheIntrinsicsAreThoseOfTheLayout) {
  std::filesystem::remove(root() / "run1/camera.txt");
  const DatasetFrame frame = Open(LabelSource::kNone)->Read(0).value();
  EXPECT_EQ(frame.camera->camera.width_px, 640);
  EXPECT_EQ(frame.camera->camera.fy_px, 320);
  EXPECT_EQ(DecodeFrame(frame, false).status().code(), StatusCode::kInvalidArgument) << "images are 4 x 3";
}

TEST_F(FlatDataset, MissingFilesAreNamedAndTheNextFrameStillReads) {
  const auto dataset = Open(LabelSource::kPredicted);
  for (const char* ending : {"_color.png", "_depth.tiff", "_pose.txt", "_predicted.png", "_labels.json"}) {
    SCOPED_TRACE(ending);
    const std::filesystem::path path = root() / "run1" / ("000000" + std::string(ending));
    std::filesystem::rename(path, path.string() + ".away");
    const Status status = dataset->Read(0).status();
    EXPECT_EQ(status.code(), StatusCode::kNotFound);
    EXPECT_EQ(status.reason(), Reason("MISSING_FILE"));
    EXPECT_NE(status.message().find(path.filename().string()), std::string::npos);
    EXPECT_TRUE(dataset->Read(1).ok());
    std::filesystem::rename(path.string() + ".away", path);
  }
  EXPECT_EQ(dataset->Read(2).status().code(), StatusCode::kOutOfRange);
}

TEST_F(FlatDataset, BrokenFramesSayWhatIsWrong) {
  const auto dataset = Open(LabelSource::kPredicted);
  const auto reason_with = [&](const char* ending, const char* text) {
    const std::filesystem::path path = root() / "run1" / ("000000" + std::string(ending));
    WriteText(path, text);
    const Status status = dataset->Read(0).status();
    WriteFlatFrame(root() / "run1", "000000");
    return std::string(status.reason().name());
  };
  EXPECT_EQ(reason_with("_pose.txt", "1 0 0 0 0 1 0"), "BAD_POSE");
  EXPECT_EQ(reason_with("_pose.txt", "1 0 zero 0\n0 1 0 0\n0 0 1 0\n0 0 0 1"), "BAD_POSE");
  EXPECT_EQ(reason_with("_labels.json", R"([{"id":1)"), "BAD_LABELS");
  EXPECT_EQ(reason_with("_labels.json", R"({"id":1})"), "BAD_LABELS");
  EXPECT_EQ(reason_with("_labels.json", R"([{"id":-1,"category_id":53}])"), "BAD_LABELS");
  EXPECT_EQ(reason_with("_labels.json", R"([{"id":1,"category_id":77}])"), "BAD_LABELS");
  for (const char* scores : {R"([0.5])", R"({"77": 0.5})", R"({"-1": 0.5})", R"({"": 1})", R"({"53": "sure"})",
                             R"({"99999999999999999999": 0.5})"}) {
    const std::string text = R"([{"id":1,"category_id":53,"class_scores":)" + std::string(scores) + "}]";
    EXPECT_EQ(reason_with("_labels.json", text.c_str()), "BAD_LABELS") << scores;
  }
  EXPECT_EQ(reason_with("_depth.tiff", ""), "BAD_IMAGE");
}

TEST_F(FlatDataset, UndecodableImagesAndPosesThatAreNotRigidAreRefusedWhenDecoded) {
  const auto dataset = Open(LabelSource::kPredicted);
  WriteText(root() / "run1/000000_color.png", "\x89PNG\r\n\x1a\n cut off");
  EXPECT_EQ(DecodeFrame(*dataset->Read(0), false).status().code(), StatusCode::kInvalidArgument);
  WriteText(root() / "run1/000001_pose.txt", "nan 0 0 0\n0 1 0 0\n0 0 1 0\n0 0 0 1");
  const Result<DatasetFrame> frame = dataset->Read(1);
  ASSERT_TRUE(frame.ok()) << "poses are checked where they are used";
  EXPECT_EQ(DecodeFrame(*frame, false).status().code(), StatusCode::kInvalidArgument);
}

TEST_F(FlatDataset, IntegerDepthIsTakenAsMillimetres) {
  WriteImage(root() / "run1/000000_depth.tiff", cv::Mat(3, 4, CV_16UC1, cv::Scalar(1250)));
  const auto dataset = Open(LabelSource::kNone);
  const Result<PanopticFrame> frame = DecodeFrame(*dataset->Read(0), false);
  ASSERT_TRUE(frame.ok()) << frame.status().ToString();
  EXPECT_FLOAT_EQ(frame->camera->depth_m[0], 1.25f);
}

TEST_F(FlatDataset, BrokenListsAndTablesFailAtOpening) {
  const auto open = [&](LabelSource labels) { return OpenDataset(root().string(), "flat", labels).status(); };
  WriteText(root() / "groundtruth_labels.csv", "InstanceID,ClassID\n1,70000\n");
  EXPECT_NE(open(LabelSource::kGroundTruth).message().find("line 2: ClassID"), std::string::npos);
  WriteText(root() / "groundtruth_labels.csv", "InstanceID,ClassID\n1,7\n1,8\n");
  EXPECT_NE(open(LabelSource::kGroundTruth).message().find("twice"), std::string::npos);
  WriteText(root() / "groundtruth_labels.csv", "Name\nchair\n");
  EXPECT_EQ(open(LabelSource::kGroundTruth).code(), StatusCode::kInvalidArgument);
  std::filesystem::remove(root() / "groundtruth_labels.csv");
  EXPECT_EQ(open(LabelSource::kGroundTruth).reason(), Reason("NO_LABELS"));
  WriteText(root() / "run1/camera.txt", "640 480 0 320 320 240");
  EXPECT_EQ(open(LabelSource::kNone).code(), StatusCode::kInvalidArgument);
  std::filesystem::remove(root() / "run1/camera.txt");
  WriteText(root() / "run1/timestamps.csv", "ImageID,TimeStamp\n000000,soon\n");
  EXPECT_NE(open(LabelSource::kNone).message().find("line 2"), std::string::npos);
  WriteText(root() / "run1/timestamps.csv", "ImageID,TimeStamp\n");
  EXPECT_EQ(open(LabelSource::kNone).code(), StatusCode::kInvalidArgument);
}

TEST(SharedHouse, ReadsUnchangedWithEveryLabelSource) {
  const std::filesystem::path data = SharedDataDir();
  if (data.empty()) GTEST_SKIP() << "no shared data on this machine";
  for (LabelSource labels : {LabelSource::kPredicted, LabelSource::kGroundTruth}) {
    const auto dataset = OpenDataset((data / "house").string(), kAnyFormat, labels);
    ASSERT_TRUE(dataset.ok()) << dataset.status().ToString();
    EXPECT_EQ((*dataset)->num_frames(), 120u);
    EXPECT_EQ((*dataset)->label_classes().size(), 38u);
    const auto label_set = LabelSet::Create((*dataset)->label_classes());
    ASSERT_TRUE(label_set.ok());
    const auto raw = (*dataset)->Read(60);
    ASSERT_TRUE(raw.ok()) << raw.status().ToString();
    const auto frame = DecodeFrame(*raw, (*dataset)->has_persistent_ids());
    ASSERT_TRUE(frame.ok()) << frame.status().ToString();
    const Status status = ValidateFrame(*frame, *label_set);
    EXPECT_TRUE(status.ok()) << status.ToString();
  }
}

}  // namespace
}  // namespace dhpmap::testing

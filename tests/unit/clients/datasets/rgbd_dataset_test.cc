// SPDX-License-Identifier: BSD-3-Clause
// The two layouts of plain RGB-D recordings: 7-Scenes and TUM.
#include <gtest/gtest.h>

#include "clients/datasets/dataset.h"
#include "clients/datasets/open_dataset.h"
#include "tests/support/scenes.h"
#include "tests/unit/clients/datasets/dataset_files.h"

namespace dhpmap::testing {
namespace {

Result<std::unique_ptr<Dataset>> Open(const std::filesystem::path& path, LabelSource labels = LabelSource::kNone) {
  return OpenDataset(path.string(), kAnyFormat, labels);
}

TEST(SevenScenesDataset, OpensTheFirstSequenceAndReadsMillimetres) {
  const TempDir temp;
  WriteSevenScenes(temp.path());
  const auto dataset = Open(temp.path());
  ASSERT_TRUE(dataset.ok()) << dataset.status().ToString();
  ASSERT_EQ((*dataset)->num_frames(), 1u);
  const DatasetFrame raw = (*dataset)->Read(0).value();
  EXPECT_EQ(raw.id, "frame-000003");
  EXPECT_EQ(raw.stamp_ns, 100'000'000);
  EXPECT_EQ(raw.camera->camera.fx_px, 585);
  const auto frame = DecodeFrame(raw, false);
  ASSERT_TRUE(frame.ok()) << frame.status().ToString();
  EXPECT_FLOAT_EQ(frame->camera->depth_m[1], 1.5f);
  EXPECT_FALSE(frame->camera->depth_m[0] > 0) << "65535 is no return";
}

TEST(SevenScenesDataset, ANumberThatNoFrameHasGivesNoTime) {
  const TempDir temp;
  WriteSevenScenes(temp.path());
  const auto folder = temp.path() / "seq-01";
  for (const char* ending : {".depth.png", ".color.png", ".pose.txt"}) {
    std::filesystem::rename(folder / (std::string("frame-000003") + ending),
                            folder / (std::string("frame-9000000000000000000") + ending));
  }
  EXPECT_EQ((*Open(folder))->Read(0)->stamp_ns, 0) << "that of its place in the list";
}

TEST(SevenScenesDataset, IntrinsicsComeFromTheMatrixBesideTheSequences) {
  const TempDir temp;
  WriteSevenScenes(temp.path());
  WriteText(temp.path() / "camera-intrinsics.txt", "500 0 310\n0 501 230\n0 0 1\n");
  const DatasetFrame frame = (*Open(temp.path() / "seq-01"))->Read(0).value();
  EXPECT_EQ(frame.camera->camera.fy_px, 501);
  EXPECT_EQ(frame.camera->camera.cx_px, 310);
}

TEST(SevenScenesDataset, HasNoLabelsAndSaysSo) {
  const TempDir temp;
  WriteSevenScenes(temp.path());
  EXPECT_EQ(Open(temp.path(), LabelSource::kPredicted).status().reason(), Reason("NO_LABELS"));
}

TEST(SevenScenesDataset, FramesWithoutColourOrPoseAreSkipped) {
  const TempDir temp;
  WriteSevenScenes(temp.path());
  const auto dataset = std::move(*Open(temp.path() / "seq-02"));
  EXPECT_EQ(dataset->Read(0).status().reason(), Reason("MISSING_FILE"));
  WriteText(temp.path() / "seq-02/frame-000000.pose.txt", "1 0 0 0");
  EXPECT_EQ(dataset->Read(0).status().reason(), Reason("BAD_POSE"));
}

TEST(SevenScenesDataset, SharedKitchenReadsUnchanged) {
  const std::filesystem::path data = SharedDataDir();
  if (data.empty()) GTEST_SKIP() << "no shared data on this machine";
  const auto dataset = Open(data / "sevenscenes");
  ASSERT_TRUE(dataset.ok()) << dataset.status().ToString();
  ASSERT_EQ((*dataset)->num_frames(), 100u);
  const auto frame = DecodeFrame(*(*dataset)->Read(99), false);
  ASSERT_TRUE(frame.ok()) << frame.status().ToString();
  EXPECT_TRUE(ValidateFrame(*frame, LabelSet()).ok());
}

TEST(TumDataset, AssociatesImagesAndInterpolatesPoses) {
  const TempDir temp;
  WriteTum(temp.path());
  const auto dataset = std::move(*Open(temp.path()));
  ASSERT_EQ(dataset->num_frames(), 3u);
  const DatasetFrame frame = dataset->Read(0).value();
  EXPECT_EQ(frame.stamp_ns, 10'000'000'000);
  // Half way between the poses at 9.99 s and 10.01 s: half the way, half of 90 degrees.
  EXPECT_NEAR(frame.T_map_sensor(0, 3), 0.5, 1e-9);
  EXPECT_NEAR(frame.T_map_sensor(2, 3), 2.0, 1e-9);
  EXPECT_NEAR(frame.T_map_sensor(0, 0), std::sqrt(0.5), 1e-9);
  EXPECT_FLOAT_EQ(DecodeFrame(frame, false)->camera->depth_m[0], 1.0f);
}

TEST(TumDataset, FramesWithNothingNearInTimeAreSkipped) {
  const TempDir temp;
  WriteTum(temp.path());
  const auto dataset = std::move(*Open(temp.path()));
  EXPECT_TRUE(dataset->Read(1).ok());
  EXPECT_EQ(dataset->Read(2).status().reason(), Reason("NO_MATCH"));
}

TEST(TumDataset, IntrinsicsFollowTheNameOrTheCameraFile) {
  const TempDir temp;
  const auto folder = temp.path() / "rgbd_dataset_freiburg3_desk";
  WriteTum(folder);
  EXPECT_EQ((*Open(folder))->Read(0)->camera->camera.fx_px, 535.4);
  WriteText(folder / "camera.txt", "640 480 500 500 320 240");
  EXPECT_EQ((*Open(folder))->Read(0)->camera->camera.fx_px, 500);
}

TEST(TumDataset, BrokenListsFailAtOpening) {
  const TempDir temp;
  WriteTum(temp.path());
  WriteText(temp.path() / "groundtruth.txt", "9.99 0 0 0 0 0 0 0\n");
  EXPECT_NE(Open(temp.path()).status().message().find("quaternion"), std::string::npos);
  WriteText(temp.path() / "groundtruth.txt", "9.99 0 0 0\n");
  EXPECT_EQ(Open(temp.path()).status().code(), StatusCode::kInvalidArgument);
  std::filesystem::remove(temp.path() / "groundtruth.txt");
  EXPECT_EQ(Open(temp.path()).status().code(), StatusCode::kNotFound);
}

TEST(OpenDataset, SaysWhatItLookedForInAnythingElse) {
  const TempDir temp;
  EXPECT_EQ(Open(temp.path()).status().code(), StatusCode::kInvalidArgument);
  EXPECT_NE(Open(temp.path()).status().message().find("timestamps.csv"), std::string::npos);
  EXPECT_EQ(Open(temp.path() / "nowhere").status().code(), StatusCode::kNotFound);
}

TEST(OpenDataset, LooksForTheFormatThatIsAskedFor) {
  const TempDir temp;
  const std::vector<std::string> formats = DatasetFormats();
  EXPECT_EQ(formats.front(), kAnyFormat);
  EXPECT_GE(formats.size(), 5u);
  for (std::size_t i = 1; i < formats.size(); ++i) {
    EXPECT_EQ(OpenDataset(temp.path().string(), formats[i], LabelSource::kNone).status().code(), StatusCode::kNotFound);
  }
}

TEST(OpenDataset, NamesTheFormatsThereAreInsteadOfOneThatIsNot) {
  const TempDir temp;
  const Status status = OpenDataset(temp.path().string(), "rosbag", LabelSource::kNone).status();
  EXPECT_EQ(status.code(), StatusCode::kInvalidArgument);
  for (const std::string& name : DatasetFormats()) EXPECT_NE(status.message().find(name), std::string::npos) << name;
}

}  // namespace
}  // namespace dhpmap::testing

// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "clients/cli/class_names.h"
#include "clients/cli/confirmation.h"
#include "clients/cli/exit_code.h"
#include "clients/cli/frame_selection.h"
#include "clients/cli/output_file.h"
#include "clients/cli/point_input.h"
#include "clients/cli/pose_change.h"
#include "clients/cli/printable.h"
#include "clients/cli/progress_bar.h"
#include "clients/cli/text_table.h"
#include "tests/support/scenes.h"

namespace dhpmap {
namespace {

using Indices = std::vector<std::size_t>;

TEST(FrameSelection, StartsLimitsThinsAndHoldsOut) {
  EXPECT_EQ((FrameSelection{}.Indices(3)), (Indices{0, 1, 2}));
  EXPECT_EQ((FrameSelection{.start = 2, .frames = 2}.Indices(9)), (Indices{2, 3}));
  EXPECT_EQ((FrameSelection{.start = 1, .every = 3}.Indices(9)), (Indices{1, 4, 7}));
  EXPECT_EQ((FrameSelection{.skip_every = 3}.Indices(7)), (Indices{0, 1, 3, 4, 6}));
  EXPECT_EQ((FrameSelection{.start = 9}.Indices(9)), Indices{});
  EXPECT_EQ((FrameSelection{.start = 7, .frames = 1'000'000'000'000}.Indices(9)), (Indices{7, 8}));
}

TEST(FrameSelection, HeldOutFramesAndTheirOppositeMakeTheWhole) {
  EXPECT_EQ((FrameSelection{.start = 9, .every = 10}.Indices(30)), (Indices{9, 19, 29}));
  EXPECT_EQ((FrameSelection{.skip_every = 10}.Indices(30)).size(), 27u);
}

TEST(Printable, ShowsWhatWouldActOnATerminal) {
  EXPECT_EQ(Printable("\x1b[2J\x1b]0;mine\x07"), "\\x1b[2J\\x1b]0;mine\\x07");
  EXPECT_EQ(Printable("a\nb\r\tc\x7f"), "a\\nb\\x0d\\tc\\x7f");
  EXPECT_EQ(Printable("\xc2\x9b"
                      "31m \u202etxt \u2028 \u2066 \u061c"),
            "\\u009b31m \\u202etxt \\u2028 \\u2066 \\u061c");
  EXPECT_EQ(Printable(std::string_view("\0", 1)), "\\x00");
  EXPECT_EQ(Printable("a\xff\xc3(\x9b"), "a\\xff\\xc3(\\x9b") << "no UTF-8";
  EXPECT_EQ(Printable("Küche 台所 \U0001f6cb \\x1b"), "Küche 台所 \U0001f6cb \\x1b");
}

TEST(TextTable, NobodyForgesARow) {
  TextTable table({"ID", "NAME"});
  table.Add({"1", "sofa\n2   bed\x1b[1A"});
  std::ostringstream out;
  table.Print(out);
  EXPECT_EQ(out.str(), "ID  NAME\n 1  sofa\\n2   bed\\x1b[1A\n");
}

TEST(ReadPoints, TakesBlanksCommasAndComments) {
  std::istringstream in("# header\n1 2 3\n4,5 , -6e-1 # tail\n\n");
  EXPECT_EQ(*ReadPoints(in), (std::vector<float>{1, 2, 3, 4, 5, -0.6f}));
}

TEST(ReadPoints, SaysWhichLineIsWrong) {
  std::istringstream bad("1 2 3\n1 two 3\n"), cut("1 2 3 4"), none("# nothing\n");
  EXPECT_NE(ReadPoints(bad).status().message().find("line 2"), std::string::npos);
  EXPECT_EQ(ReadPoints(cut).status().code(), StatusCode::kInvalidArgument);
  EXPECT_EQ(ReadPoints(none).status().code(), StatusCode::kInvalidArgument);
}

TEST(TextTable, AlignsNumbersRightAndTextLeft) {
  TextTable table({"ID", "NAME"});
  table.Add({"7", "ä"});
  table.Add({"123", "bc"});
  std::ostringstream out;
  table.Print(out);
  EXPECT_EQ(out.str(), " ID  NAME\n  7  ä\n123  bc\n");
}

TEST(ProgressBar, TellsAPipeAPlainLineATenth) {
  ::testing::internal::CaptureStderr();  // a file
  {
    ProgressBar progress(200);
    for (std::size_t done = 0; done <= 200; ++done) progress.Show(done, "fast");
    progress.Print("skipped frame 3");
  }
  const std::string told = ::testing::internal::GetCapturedStderr();
  EXPECT_EQ(std::count(told.begin(), told.end(), '\n'), 11) << told;
  EXPECT_TRUE(told.starts_with("20/200 frames, fast\n40/200 frames, fast\n")) << told;
  EXPECT_TRUE(told.ends_with("200/200 frames, fast\nskipped frame 3\n")) << told;
  EXPECT_EQ(told.find_first_of("\r\x1b"), std::string::npos) << "nothing that only a terminal understands";
}

TEST(Bytes, TakeTheUnitThatFits) {
  EXPECT_EQ(Bytes(512), "512 B");
  EXPECT_EQ(Bytes(1536), "1.5 KiB");
  EXPECT_EQ(Bytes(3.0 * (1 << 20)), "3.0 MiB");
}

TEST(FindClass, TakesNameInAnyCaseOrId) {
  v1::Map map;
  map.set_name("maps/m");
  v1::LabelClass* chair = map.add_label_classes();
  chair->set_id(12);
  chair->set_name("Chair");
  EXPECT_EQ(FindClass(map, "chair")->id(), 12u);
  EXPECT_EQ(FindClass(map, " CHAIR ")->id(), 12u);
  EXPECT_EQ(FindClass(map, "12")->name(), "Chair");
  EXPECT_NE(FindClass(map, "chiar").status().message().find("did you mean 'Chair'?"), std::string::npos);
  const Status status = FindClass(map, "table").status();
  EXPECT_EQ(status.code(), StatusCode::kNotFound);
  EXPECT_NE(status.message().find("Chair"), std::string::npos);
}

StatusCode Asked(const std::string& answer, bool is_terminal = true) {
  std::istringstream in(answer);
  std::ostringstream out;
  const Status status = Confirm("Delete it?", is_terminal, in, out);
  EXPECT_EQ(out.str(), is_terminal ? "Delete it? [y/N] " : "");
  return status.code();
}

TEST(Confirm, TakesOnlyAYesForYes) {
  for (const char* yes : {"y\n", "yes\n", "Y", "Yes \n"}) EXPECT_EQ(Asked(yes), StatusCode::kOk) << yes;
  for (const char* no : {"", "\n", "n\n", "no\n", "yesterday\n", "delete\n"}) {
    EXPECT_EQ(Asked(no), StatusCode::kAborted) << no;
  }
  EXPECT_EQ(Asked("y\n", false), StatusCode::kFailedPrecondition) << "nobody was asked";
}

/// Of what was observed around (4, 2, .5), posed turned by 90 degrees and shifted.
v1::Submap Armchair() {
  v1::Submap submap;
  submap.mutable_bounding_sphere()->mutable_center_m()->set_x(4);
  submap.mutable_bounding_sphere()->mutable_center_m()->set_y(2);
  submap.mutable_bounding_sphere()->mutable_center_m()->set_z(0.5);
  submap.mutable_map_from_submap()->mutable_translation_m()->set_x(1);
  submap.mutable_map_from_submap()->mutable_rotation()->set_z(M_SQRT1_2);
  submap.mutable_map_from_submap()->mutable_rotation()->set_w(M_SQRT1_2);
  return submap;
}

/// Where a pose puts a point of the submap.
Eigen::Vector3d Placed(const v1::Pose& pose, const Eigen::Vector3d& p) {
  const v1::Quaternion& q = pose.rotation();
  const v1::Vector3& t = pose.translation_m();
  return Eigen::Quaterniond(q.w(), q.x(), q.y(), q.z()) * p + Eigen::Vector3d(t.x(), t.y(), t.z());
}

TEST(ChangePose, TurnsOnTheSpot) {
  v1::Submap submap = Armchair();
  // In the submap's frame, these are the centre and what is 1 m east of it.
  const Eigen::Vector3d center(2, -3, 0.5), east(2, -4, 0.5);
  ASSERT_TRUE(Placed(submap.map_from_submap(), center).isApprox(Eigen::Vector3d(4, 2, 0.5), 1e-9));
  ASSERT_TRUE(Placed(submap.map_from_submap(), east).isApprox(Eigen::Vector3d(5, 2, 0.5), 1e-9));
  ASSERT_TRUE(ChangePose({.yaw_deg = 90}, submap).ok());
  EXPECT_TRUE(Placed(submap.map_from_submap(), center).isApprox(Eigen::Vector3d(4, 2, 0.5), 1e-9)) << "it stays";
  EXPECT_TRUE(Placed(submap.map_from_submap(), east).isApprox(Eigen::Vector3d(4, 3, 0.5), 1e-9)) << "now north of it";
  ASSERT_TRUE(ChangePose({.by_m = {0, 0, 1}, .yaw_deg = -90}, submap).ok());
  EXPECT_TRUE(Placed(submap.map_from_submap(), east).isApprox(Eigen::Vector3d(5, 2, 1.5), 1e-9)) << "and shifted";
}

TEST(ChangePose, ReplacesTranslationOrRotation) {
  v1::Submap submap = Armchair();
  ASSERT_TRUE(ChangePose({.to_m = {7, 8, 9}, .rotation = {0, 0, 0, 1}}, submap).ok());
  EXPECT_TRUE(Placed(submap.map_from_submap(), {1, 2, 3}).isApprox(Eigen::Vector3d(8, 10, 12), 1e-12));
  ASSERT_TRUE(ChangePose({.by_m = {1, 0, -1}}, submap).ok());
  EXPECT_TRUE(Placed(submap.map_from_submap(), {1, 2, 3}).isApprox(Eigen::Vector3d(9, 10, 11), 1e-12));
}

TEST(ChangePose, RefusesToTurnWhatHasNoPlace) {
  v1::Submap submap = Armchair();
  submap.clear_bounding_sphere();
  EXPECT_EQ(ChangePose({.yaw_deg = 90}, submap).code(), StatusCode::kFailedPrecondition);
  EXPECT_TRUE(ChangePose({.by_m = {1, 0, 0}}, submap).ok());
}

TEST(ExitCodeOf, TellsClassesOfErrorsApart) {
  EXPECT_EQ(ExitCodeOf(client::StatusCode::kOk), ExitCode::kOk);
  EXPECT_EQ(ExitCodeOf(client::StatusCode::kFailedPrecondition), ExitCode::kBadRequest);
  EXPECT_EQ(ExitCodeOf(client::StatusCode::kNotFound), ExitCode::kNotFound);
  EXPECT_EQ(ExitCodeOf(client::StatusCode::kAborted), ExitCode::kConflict);
  EXPECT_EQ(ExitCodeOf(client::StatusCode::kUnavailable), ExitCode::kUnreachable);
  EXPECT_EQ(ExitCodeOf(client::StatusCode::kDataLoss), ExitCode::kServerFailed);
}

TEST(OutputFile, IsThereOnlyOnceComplete) {
  const testing::TempDir temp;
  const std::string path = (temp.path() / "mesh.ply").string();
  {
    auto abandoned = OutputFile::Open(path);
    ASSERT_TRUE(abandoned.ok());
    abandoned->Write("half");
  }
  EXPECT_TRUE(std::filesystem::is_empty(temp.path()));
  auto file = OutputFile::Open(path);
  file->Write("all");
  EXPECT_FALSE(std::filesystem::exists(path));
  ASSERT_TRUE(file->Close().ok());
  EXPECT_EQ(file->num_bytes(), 3);
  std::string text;
  std::ifstream(path) >> text;
  EXPECT_EQ(text, "all");
  EXPECT_FALSE(OutputFile::Open((temp.path() / "no/where").string()).ok());
}

}  // namespace
}  // namespace dhpmap

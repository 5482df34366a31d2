// SPDX-License-Identifier: BSD-3-Clause
// The command line, without a process of its own.
#include <gtest/gtest.h>

#include <CLI/CLI.hpp>
#include <fstream>
#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>

#include "clients/evaluator/output.h"
#include "clients/evaluator/paper_command.h"
#include "clients/evaluator/run_command.h"
#include "tests/e2e/rendered_dataset.h"
#include "tests/support/scenes.h"

namespace dhpmap::evaluator {
namespace {

namespace fs = std::filesystem;
using dhpmap::testing::TempDir;

struct Outcome {
  Status status;
  std::string out, err;
};

Outcome Call(std::vector<std::string> arguments) {
  Outcome outcome;
  CLI::App app("test");
  AddRunCommand(app, outcome.status);
  AddPaperCommand(app, outcome.status);
  std::reverse(arguments.begin(), arguments.end());
  ::testing::internal::CaptureStdout();
  ::testing::internal::CaptureStderr();
  try {
    app.parse(arguments);
  } catch (const CLI::ParseError& error) {
    outcome.status = InvalidArgument(error.what());
  }
  outcome.err = ::testing::internal::GetCapturedStderr();
  outcome.out = ::testing::internal::GetCapturedStdout();
  return outcome;
}

std::string TextOf(const fs::path& path) {
  std::ifstream in(path);
  return {std::istreambuf_iterator<char>(in), {}};
}

TEST(RunCommand, WritesTablesJsonAndPictures) {
  const TempDir dir;
  dhpmap::testing::WriteRenderedDataset(dir.path(), 4);
  const Outcome outcome =
      Call({"run", dir.path().string(), "--systems", "votes,dhp", "--frames", "3", "--set", "refinement.every_frames=2",
            "--json", (dir.path() / "o.json").string(), "--markdown", (dir.path() / "o.md").string(), "--pictures",
            (dir.path() / "pictures").string(), "--html", (dir.path() / "o.html").string()});
  ASSERT_TRUE(outcome.status.ok()) << outcome.status.ToString();
  EXPECT_NE(outcome.out.find("| dhp"), std::string::npos);
  EXPECT_EQ(TextOf(dir.path() / "o.md"), outcome.out);
  const std::string page = TextOf(dir.path() / "o.html");
  EXPECT_NE(page.find("a vote in each voxel"), std::string::npos) << "what the systems are";
  EXPECT_TRUE(page.ends_with("</html>\n"));
  const nlohmann::json json = nlohmann::json::parse(TextOf(dir.path() / "o.json"));
  EXPECT_EQ(json["systems"].size(), 2u);
  EXPECT_EQ(json["config"]["refinement.every_frames"], "2");
  for (const char* name : {"truth_labels", "votes_labels", "votes_errors", "dhp_labels", "dhp_errors"}) {
    const cv::Mat picture = cv::imread((dir.path() / "pictures" / (std::string(name) + ".png")).string());
    EXPECT_GT(picture.rows, 50) << name;
  }
}

TEST(RunCommand, DrawsMistakesInTheirColours) {
  const TempDir dir;
  dhpmap::testing::WriteRenderedDataset(dir.path(), 2);
  const Outcome outcome = Call({"run", dir.path().string(), "--systems", "votes", "--pictures", dir.path().string()});
  ASSERT_TRUE(outcome.status.ok());
  const cv::Mat errors = cv::imread((dir.path() / "votes_errors.png").string());
  int num_right = 0, num_wrong = 0;  // however they are lit: grey, and red or orange
  for (int y = 0; y < errors.rows; ++y) {
    for (int x = 0; x < errors.cols; ++x) {
      const cv::Vec3b& pixel = errors.at<cv::Vec3b>(y, x);  // blue, green, red
      const int most = std::max({pixel[0], pixel[1], pixel[2]}), least = std::min({pixel[0], pixel[1], pixel[2]});
      if (most - least < 12 && most < 205) ++num_right;
      if (pixel[2] > pixel[0] + 60) ++num_wrong;
    }
  }
  EXPECT_GT(num_right, errors.rows * errors.cols / 20);
  EXPECT_LT(num_wrong, num_right) << "the votes of true labels are mostly right";
}

TEST(RunCommand, EndsWithAClearError) {
  const TempDir dir;
  dhpmap::testing::WriteRenderedDataset(dir.path(), 1);
  const std::string data = dir.path().string();
  const auto message = [](const std::vector<std::string>& arguments) { return Call(arguments).status.ToString(); };
  EXPECT_NE(message({"run", data + "/none"}).find("none"), std::string::npos);
  EXPECT_NE(message({"run", data, "--systems", "nobody"}).find("nobody"), std::string::npos);
  EXPECT_NE(message({"run", data, "--set", "no.key=1"}).find("no.key"), std::string::npos);
  EXPECT_NE(message({"run", data, "--set", "nonsense"}).find("nonsense"), std::string::npos);
  EXPECT_NE(message({"run", data, "--labels", "guessed"}).find("guessed"), std::string::npos);
  EXPECT_NE(message({"run", data, "--labels", "none"}).find("nothing to evaluate"), std::string::npos);
  EXPECT_NE(message({"run", data, "--json", data + "/no/folder/o.json"}).find("no/folder"), std::string::npos);
  EXPECT_FALSE(Call({"run"}).status.ok());
}

TEST(PaperCommand, PrintsAllTablesOfADataSet) {
  const TempDir dir;
  dhpmap::testing::WriteRenderedDataset(dir.path(), 3);
  const Outcome outcome =
      Call({"paper", dir.path().string(), "--without-retrieval", "--json", (dir.path() / "o.json").string()});
  ASSERT_TRUE(outcome.status.ok()) << outcome.status.ToString();
  for (const char* part :
       {"Table I:", "Table II:", "Table III:", "management only", "panmap", "kimera", "(0.702)", "(89.75)"}) {
    EXPECT_NE(outcome.out.find(part), std::string::npos) << part;
  }
  EXPECT_EQ(outcome.out.find("Table IV"), std::string::npos);
  EXPECT_EQ(nlohmann::json::parse(TextOf(dir.path() / "o.json"))["experiments"].size(), 1u);
}

TEST(PaperCommand, OpensEveryDataSetBeforeItStarts) {
  const TempDir dir;
  dhpmap::testing::WriteRenderedDataset(dir.path(), 2);
  const Outcome outcome = Call({"paper", dir.path().string(), (dir.path() / "none").string(), "--without-retrieval"});
  EXPECT_NE(outcome.status.message().find("none"), std::string::npos);
  EXPECT_EQ(outcome.err.find("panmap"), std::string::npos) << "nothing was run";
}

TEST(DatasetName, IsShort) {
  EXPECT_EQ(DatasetName("/data/house"), "house");
  EXPECT_EQ(DatasetName("/data/house/"), "house");
  EXPECT_EQ(DatasetName("/data/kitti/sequences/07/"), "kitti 07");
}

}  // namespace
}  // namespace dhpmap::evaluator

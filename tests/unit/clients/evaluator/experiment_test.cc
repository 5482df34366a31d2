// SPDX-License-Identifier: BSD-3-Clause
#include "clients/evaluator/experiment.h"

#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "clients/evaluator/experiment_json.h"
#include "clients/evaluator/markdown.h"
#include "clients/evaluator/recording.h"
#include "tests/e2e/rendered_dataset.h"
#include "tests/support/scenes.h"

namespace dhpmap::evaluator {
namespace {

using dhpmap::testing::TempDir;
using dhpmap::testing::WriteRenderedDataset;

class ExperimentTest : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    dir_ = std::make_unique<TempDir>();
    WriteRenderedDataset(dir_->path(), 6);
  }
  static void TearDownTestSuite() { dir_.reset(); }

  static ExperimentOptions Options(std::vector<std::string> systems) {
    ExperimentOptions options;
    options.directory = dir_->path().string();
    options.systems = std::move(systems);
    options.num_threads = 1;
    return options;
  }

  static std::unique_ptr<TempDir> dir_;
};
std::unique_ptr<TempDir> ExperimentTest::dir_;

TEST_F(ExperimentTest, GroundTruthAsPredictionIsNearlyPerfect) {
  ExperimentOptions options = Options({"dhp_management_only"});
  options.labels = LabelSource::kGroundTruth;
  const auto experiment = RunExperiment(options, {});
  ASSERT_TRUE(experiment.ok()) << experiment.status().ToString();
  const Scores& scores = experiment->systems.at(0);
  EXPECT_GT(scores.panoptics.all.pq, 0.98);
  EXPECT_DOUBLE_EQ(scores.panoptics.all.rq, 1);
  EXPECT_GT(scores.semantics.mean_iou, 0.98);
  EXPECT_DOUBLE_EQ(scores.geometry.f_score(), 1);
  EXPECT_EQ(experiment->num_frames, 6);
  EXPECT_EQ(experiment->preset, "indoor");
}

TEST_F(ExperimentTest, RunsEverySystemOnPredictions) {
  int num_visits = 0;
  const auto experiment =
      RunExperiment(Options({"panmap", "kimera", "votes", "dhp_no_refine", "dhp"}),
                    [&num_visits](const Truth& truth, const Scores&, const std::vector<ElementLabel>& labels) {
                      EXPECT_EQ(labels.size(), truth.samples().size());
                      ++num_visits;
                      return Status::Ok();
                    });
  ASSERT_TRUE(experiment.ok()) << experiment.status().ToString();
  EXPECT_EQ(num_visits, 5);
  for (const Scores& scores : experiment->systems) {
    EXPECT_GT(scores.semantics.accuracy, 0.9) << scores.system;
    EXPECT_GT(scores.geometry.f_score(), 0.9) << scores.system;
    EXPECT_EQ(scores.has_instances, !scores.precisions.empty()) << scores.system;
    EXPECT_EQ(scores.times.num_frames, 6) << scores.system;
  }
  EXPECT_GT(experiment->systems.back().panoptics.all.pq, 0.9);
  EXPECT_GT(experiment->num_truth_points, 1000);
  ASSERT_EQ(experiment->on_points.size(), experiment->systems.size());
  for (std::size_t i = 0; i < experiment->systems.size(); ++i) {
    const Scores& on_map = experiment->systems[i];
    const Scores& on_points = experiment->on_points[i];
    EXPECT_EQ(on_points.system, on_map.system);
    EXPECT_EQ(on_points.semantics.num_elements, experiment->num_truth_points) << "the scene has no unlabelled points";
    EXPECT_NEAR(on_points.semantics.accuracy, on_map.semantics.accuracy, 0.05) << on_map.system;
    EXPECT_GT(on_points.geometry.recall, 0.9) << on_map.system;
    EXPECT_NE(on_points.geometry.chamfer_l1_m(), on_map.geometry.chamfer_l1_m());
  }
  ASSERT_EQ(experiment->asked.size(), experiment->systems.size());
  for (std::size_t i = 0; i < experiment->asked.size(); ++i) {
    const Scores& asked = experiment->asked[i];
    EXPECT_EQ(asked.system, experiment->systems[i].system);
    EXPECT_EQ(asked.semantics.num_elements, experiment->num_truth_points);
    EXPECT_NEAR(asked.semantics.accuracy, experiment->on_points[i].semantics.accuracy, 0.05) << asked.system;
  }
  EXPECT_EQ(experiment->on_points.back().panoptics.matches.size(), experiment->systems.back().panoptics.matches.size());
}

TEST_F(ExperimentTest, TakesFirstFramesAndSettings) {
  ExperimentOptions options = Options({"dhp"});
  options.num_frames = 2;
  options.settings = {{"voxel_size_m", "0.08"}, {"truncation_m", "0.16"}};
  const auto experiment = RunExperiment(options, {});
  ASSERT_TRUE(experiment.ok()) << experiment.status().ToString();
  EXPECT_EQ(experiment->num_frames, 2);
  EXPECT_DOUBLE_EQ(experiment->protocol.spacing_m, 0.04);
  EXPECT_DOUBLE_EQ(experiment->protocol.d_match_m, 0.16);
  EXPECT_DOUBLE_EQ(experiment->protocol.geometry.threshold_m, 0.08);
}

TEST_F(ExperimentTest, SaysWhatItCannotRun) {
  EXPECT_NE(RunExperiment(Options({"dhpp"}), {}).status().message().find("dhpp"), std::string::npos);
  ExperimentOptions options = Options({"dhp"});
  options.settings = {{"tracking.no_such_key", "1"}};
  const Status unknown_key = RunExperiment(options, {}).status();
  EXPECT_EQ(unknown_key.code(), StatusCode::kInvalidArgument);
  EXPECT_NE(unknown_key.ToString().find("no_such_key"), std::string::npos);
  options.settings = {{"voxel_size_m", "-3"}};
  EXPECT_EQ(RunExperiment(options, {}).status().code(), StatusCode::kInvalidArgument);
  options = Options({"dhp"});
  options.directory = (dir_->path() / "nowhere").string();
  EXPECT_FALSE(RunExperiment(options, {}).ok());
  options = Options({"dhp"});
  options.class_map = (dir_->path() / "no.csv").string();
  EXPECT_EQ(RunExperiment(options, {}).status().code(), StatusCode::kNotFound);
}

TEST_F(ExperimentTest, StopsWhereTheVisitorFails) {
  const auto failed =
      RunExperiment(Options({"dhp"}), [](const auto&, const auto&, const auto&) { return Aborted("no"); });
  EXPECT_EQ(failed.status().code(), StatusCode::kAborted);
}

TEST_F(ExperimentTest, LosesNothingInJson) {
  ExperimentOptions options = Options({"votes", "dhp"});
  options.num_frames = 3;
  const auto experiment = RunExperiment(options, {});
  ASSERT_TRUE(experiment.ok());
  const nlohmann::json json = nlohmann::json::parse(ToJson(*experiment).dump());
  EXPECT_EQ(json["num_frames"], 3);
  EXPECT_EQ(json["protocol"]["label_match_distance_m"], experiment->protocol.d_match_m);
  EXPECT_EQ(json["config"]["voxel_size_m"], "0.04");
  EXPECT_EQ(json["config"].size(), ConfigToText(experiment->config).size());
  EXPECT_EQ(json["class_map"].size(), experiment->classes.classes().size());
  EXPECT_EQ(json["num_truth_points"], experiment->num_truth_points);
  EXPECT_EQ(json["systems_on_points"].size(), json["systems"].size());
  EXPECT_EQ(json["systems_asked"][1]["semantic"]["mean_iou"], experiment->asked[1].semantics.mean_iou);
  EXPECT_FALSE(json["systems_asked"][1].contains("geometry")) << "who asks at a point sees no surface";
  EXPECT_EQ(json["systems_on_points"][1]["with_false_surface"]["pq"], experiment->on_points[1].with_false.pq);
  const nlohmann::json& dhp = json["systems"][1];
  const Scores& scores = experiment->systems[1];
  EXPECT_EQ(dhp["panoptic"]["all"]["pq"], scores.panoptics.all.pq);
  EXPECT_EQ(dhp["semantic"]["mean_iou"], scores.semantics.mean_iou);
  EXPECT_EQ(dhp["instance"]["map_50"], scores.precisions[2].mean);
  EXPECT_EQ(dhp["geometry"]["f_score"], scores.geometry.f_score());
  EXPECT_FALSE(json["systems"][0].contains("instance")) << "votes has no instances";
  double sum = 0;
  int num_present = 0;
  for (const nlohmann::json& row : dhp["classes"]) {
    if (row["num_truth_samples"] == 0) continue;
    sum += row["iou"].get<double>();
    ++num_present;
  }
  EXPECT_NEAR(sum / num_present, scores.semantics.mean_iou, 1e-12);
}

TEST_F(ExperimentTest, PrintsThresholdsClassMapAndEverySystem) {
  const auto experiment = RunExperiment(Options({"votes", "dhp"}), {});
  ASSERT_TRUE(experiment.ok());
  const std::string protocol = ProtocolText(*experiment);
  for (const char* part : {"0.080 m", "0.050 m", "30 samples", "predicted labels", "6 frames"}) {
    EXPECT_NE(protocol.find(part), std::string::npos) << part << " in " << protocol;
  }
  for (const std::string& table :
       {PointsTable(*experiment), AskedTable(*experiment), ScoreTable(*experiment), ClassTable(*experiment)}) {
    EXPECT_NE(table.find("votes"), std::string::npos);
    EXPECT_NE(table.find("dhp"), std::string::npos);
  }
}

TEST_F(ExperimentTest, FramesAreTheSameFromTheCacheAndFromTheDisk) {
  std::vector<std::int64_t> stamps[3];
  for (const std::size_t cache_bytes : {std::size_t{0}, std::size_t{1} << 20, std::size_t{1} << 30}) {
    auto recording = Recording::Open(dir_->path().string(), kAnyFormat, LabelSource::kPredicted, 0, cache_bytes);
    ASSERT_TRUE(recording.ok());
    for (auto& seen : stamps) {
      seen.clear();
      ASSERT_TRUE(recording
                      ->ForEach([&seen](const PanopticFrame& frame) {
                        seen.push_back(frame.stamp_ns);
                        return Status::Ok();
                      })
                      .ok());
      EXPECT_EQ(seen.size(), 6u);
    }
    EXPECT_EQ(stamps[0], stamps[1]);
    EXPECT_EQ(stamps[0], stamps[2]);
  }
}

TEST(Recording, LeavesOutUnreadableFramesAndSaysWhy) {
  const TempDir dir;
  WriteRenderedDataset(dir.path(), 3);
  std::filesystem::path depth;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(dir.path())) {
    if (entry.path().filename().string().find("1_depth.tiff") != std::string::npos) depth = entry.path();
  }
  ASSERT_FALSE(depth.empty());
  std::ofstream(depth, std::ios::trunc) << "not a picture";
  auto recording = Recording::Open(dir.path().string(), kAnyFormat, LabelSource::kPredicted, 0, 1 << 30);
  ASSERT_TRUE(recording.ok());
  for (int pass = 0; pass < 2; ++pass) {
    int num_frames = 0;
    ASSERT_TRUE(recording->ForEach([&](const PanopticFrame&) { return ++num_frames, Status::Ok(); }).ok());
    EXPECT_EQ(num_frames, 2);
    EXPECT_EQ(recording->num_skipped(), 1u);
    EXPECT_FALSE(recording->first_error().empty());
  }
}

}  // namespace
}  // namespace dhpmap::evaluator

// SPDX-License-Identifier: BSD-3-Clause
// An analytic scene through mapping and evaluation.
#include "clients/evaluator/evaluation.h"

#include <gtest/gtest.h>

#include <cmath>

#include "clients/evaluator/dhp_system.h"
#include "clients/evaluator/systems.h"
#include "clients/evaluator/truth_points.h"
#include "tests/support/scenes.h"

namespace dhpmap::evaluator {
namespace {

using dhpmap::testing::LookAt;
using dhpmap::testing::Scene;
using dhpmap::testing::SmallCamera;
using dhpmap::testing::Solid;

/// Floor (3), two balls (1) and a box (2).
std::vector<PanopticFrame> Frames() {
  using Shape = Solid::Shape;
  const Scene scene{{{Shape::kHalfSpace, {0, 0, 0}, {0, 0, 1}, 1, {120, 90, 60}},
                     {Shape::kSphere, {1.5, -0.8, 0.35}, {0.35, 0, 0}, 2, {220, 30, 30}},
                     {Shape::kSphere, {1.5, 0.9, 0.35}, {0.35, 0, 0}, 3, {220, 130, 30}},
                     {Shape::kBox, {2.2, 0.1, 0.3}, {0.25, 0.3, 0.3}, 4, {30, 60, 210}}}};
  std::vector<PanopticFrame> frames;
  for (int i = 0; i < 8; ++i) {
    PanopticFrame frame = Render(scene, SmallCamera(), LookAt({-0.6, 0.15 * i - 0.5, 1.4}, {1.7, 0, 0.2}));
    frame.stamp_ns = i;
    frame.has_persistent_ids = true;
    frame.segments = {{SegmentId(1), ClassId(3), 1},
                      {SegmentId(2), ClassId(1), 1},
                      {SegmentId(3), ClassId(1), 1},
                      {SegmentId(4), ClassId(2), 1}};
    frame.unlisted_ids_are_unknown = true;
    frames.push_back(std::move(frame));
  }
  return frames;
}

SystemSetup MapSetup() {
  SystemSetup setup;
  setup.label_set = dhpmap::testing::MakeLabelSet(2, 1);
  setup.num_threads = 1;
  return setup;
}

LabelledSurface MapOf(MappingSystem& system, const std::vector<PanopticFrame>& frames) {
  for (const PanopticFrame& frame : frames) EXPECT_TRUE(system.Integrate(frame).ok());
  system.Finish();
  return system.Surface();
}

class EvaluationTest : public ::testing::Test {
 protected:
  EvaluationTest() : truth_surface_(MapOf(*MakeTruthMap(MapSetup()), frames_)) {
    truth_ = std::make_unique<Truth>(truth_surface_.mesh, *ClassMap::Same(MapSetup().label_set->classes()),
                                     ProtocolFor(MapSetup().config.voxel_size_m));
  }

  Scores ScoresOf(const LabelledSurface& surface, bool has_instances = true) {
    return Evaluate(*truth_, surface, has_instances, pool_, nullptr);
  }

  std::vector<PanopticFrame> frames_ = Frames();
  LabelledSurface truth_surface_;
  std::unique_ptr<Truth> truth_;
  ThreadPool pool_{2};
};

TEST_F(EvaluationTest, TruthAsPredictionIsPerfect) {
  const Scores scores = ScoresOf(truth_surface_);
  EXPECT_GT(truth_->samples().size(), 5000u);
  EXPECT_DOUBLE_EQ(scores.panoptics.all.pq, 1);
  EXPECT_EQ(scores.panoptics.all.num_classes, 3);
  EXPECT_EQ(scores.panoptics.classes[0].num_matched, 2);
  EXPECT_DOUBLE_EQ(scores.semantics.mean_iou, 1);
  EXPECT_DOUBLE_EQ(scores.semantics.accuracy, 1);
  ASSERT_EQ(scores.precisions.size(), 3u);
  for (const PrecisionAt& at : scores.precisions) EXPECT_DOUBLE_EQ(at.mean, 1);
  EXPECT_EQ(scores.geometry.chamfer_l1_m(), 0);
  EXPECT_DOUBLE_EQ(scores.geometry.f_score(), 1);
}

TEST_F(EvaluationTest, MappingTheTruthsLabelsIsNearlyPerfect) {
  auto system = MakeSystem("dhp_management_only", MapSetup());
  ASSERT_TRUE(system.ok());
  const Scores scores = ScoresOf(MapOf(**system, frames_));
  EXPECT_GT(scores.panoptics.all.pq, 0.98) << "only contacts differ: management counts, the truth weighs by nearness";
  EXPECT_DOUBLE_EQ(scores.panoptics.all.rq, 1);
  EXPECT_GT(scores.semantics.mean_iou, 0.98);
  EXPECT_DOUBLE_EQ(scores.geometry.f_score(), 1);
}

TEST_F(EvaluationTest, NamesOfInstancesDoNotMatter) {
  LabelledSurface renamed = truth_surface_;
  for (std::uint32_t& instance : renamed.mesh.instances) instance = instance == 0 ? 0 : 1000 - 7 * instance;
  EXPECT_DOUBLE_EQ(ScoresOf(renamed).panoptics.all.pq, 1);
}

TEST_F(EvaluationTest, OneBallForTwoCostsRecognition) {
  LabelledSurface merged = truth_surface_;
  for (std::size_t i = 0; i < merged.mesh.classes.size(); ++i) {
    if (merged.mesh.classes[i] == 1) merged.mesh.instances[i] = 77;
  }
  const Scores scores = ScoresOf(merged);
  EXPECT_DOUBLE_EQ(scores.semantics.mean_iou, 1) << "classes are right";
  EXPECT_LT(scores.panoptics.classes[0].pq(), 0.5);
  EXPECT_DOUBLE_EQ(scores.panoptics.classes[1].pq(), 1);
  const Scores without = ScoresOf(truth_surface_, false);
  EXPECT_EQ(without.panoptics.classes[0].pq(), scores.panoptics.classes[0].pq());
  EXPECT_TRUE(without.precisions.empty());
}

TEST_F(EvaluationTest, SwappedThingClassesAreWorthNothing) {
  LabelledSurface swapped = truth_surface_;
  for (std::uint16_t& c : swapped.mesh.classes) c = c == 1 ? 2 : c == 2 ? 1 : c;
  const Scores scores = ScoresOf(swapped);
  EXPECT_DOUBLE_EQ(scores.semantics.mean_iou, 1.0 / 3);
  EXPECT_DOUBLE_EQ(scores.panoptics.all.pq, 1.0 / 3);
  EXPECT_DOUBLE_EQ(scores.geometry.f_score(), 1);
}

TEST_F(EvaluationTest, AgainstPointsASurfaceWhereThereIsNoneCostsPrecision) {
  TruthPoints points{MapSetup().config.integration};
  for (const PanopticFrame& frame : frames_) points.Add(frame);
  Truth truth(points.Elements(), *ClassMap::Same(MapSetup().label_set->classes()), truth_->protocol());
  truth.set_elements_a_sample(ElementsASample(truth, truth_->samples(), pool_));
  const Scores right = Evaluate(truth, truth_surface_, true, pool_, nullptr);
  EXPECT_GT(right.semantics.accuracy, 0.98);
  EXPECT_GT(right.panoptics.all.pq, 0.95);
  EXPECT_GT(right.geometry.recall, 0.99);
  EXPECT_GT(right.geometry.precision, 0.85) << "between the pixels of a small camera are gaps";
  LabelledSurface doubled = truth_surface_;  // and once more, a metre above
  const auto num_vertices = static_cast<std::uint32_t>(doubled.mesh.vertices_m.size());
  AppendMesh(truth_surface_.mesh, doubled.mesh);
  for (std::size_t i = num_vertices; i < doubled.mesh.vertices_m.size(); ++i) doubled.mesh.vertices_m[i].z() += 1;
  const Scores wrong = Evaluate(truth, doubled, true, pool_, nullptr);
  EXPECT_EQ(wrong.geometry.recall, right.geometry.recall);
  EXPECT_NEAR(wrong.geometry.precision, right.geometry.precision / 2, 0.02);
  EXPECT_EQ(wrong.semantics.mean_iou, right.semantics.mean_iou) << "no element is the nearer to it";
  EXPECT_GT(right.with_false.mean_iou, right.semantics.mean_iou - 0.1);
  EXPECT_LE(right.with_false.mean_iou, right.semantics.mean_iou);
  EXPECT_NEAR(wrong.with_false.mean_iou, right.with_false.mean_iou / 2, 0.05);
  EXPECT_LT(wrong.with_false.pq, 0.6 * right.with_false.pq) << "an IoU of a half is no match";
}

TEST_F(EvaluationTest, WhoAsksAtTheMeasuredPointsIsToldWhatIsThere) {
  TruthPoints points{MapSetup().config.integration};
  for (const PanopticFrame& frame : frames_) points.Add(frame);
  const Truth truth(points.Elements(), *ClassMap::Same(MapSetup().label_set->classes()), truth_->protocol());
  for (const char* name : {"dhp", "dhp_no_refine", "panmap", "kimera", "votes"}) {
    const auto system = MakeSystem(name, MapSetup());
    ASSERT_TRUE(system.ok());
    const LabelledSurface surface = MapOf(**system, frames_);
    const auto asked = (*system)->LabelsAt(truth.samples().positions_m);
    ASSERT_TRUE(asked) << name;
    const Scores scores = EvaluateAsked(truth, *asked, surface.instance_scores, (*system)->has_instances());
    EXPECT_GT(scores.semantics.accuracy, 0.97) << name;
    EXPECT_EQ(scores.precisions.empty(), !(*system)->has_instances()) << name;
    if ((*system)->has_instances()) {
      EXPECT_GT(scores.panoptics.all.pq, 0.9) << name;
    }
    const std::vector<Eigen::Vector3f> nowhere{{0, 0, 30}};
    EXPECT_EQ((*system)->LabelsAt(nowhere)->classes, std::vector<std::uint16_t>{0}) << name;
  }
  EXPECT_FALSE((*MakeSystem("votes_objects", MapSetup()))->LabelsAt({})) << "its objects are parts of a surface";
}

TEST_F(EvaluationTest, HalfASurfaceHasHalfTheRecall) {
  LabelledSurface half = truth_surface_;
  auto& triangles = half.mesh.triangles;
  float middle_m = 0;
  for (const auto& p : truth_->samples().positions_m) middle_m += p.y() / static_cast<float>(truth_->samples().size());
  triangles.erase(std::remove_if(triangles.begin(), triangles.end(),
                                 [&](const auto& t) { return half.mesh.vertices_m[t[0]].y() > middle_m; }),
                  triangles.end());
  const Scores scores = ScoresOf(half);
  const double answered =
      static_cast<double>(scores.semantics.num_answered) / static_cast<double>(scores.semantics.num_elements);
  EXPECT_NEAR(scores.semantics.accuracy, answered, 0.01) << "all that is there is right, but for the cut";
  EXPECT_NEAR(scores.geometry.recall, 0.5, 0.15);
  EXPECT_DOUBLE_EQ(scores.geometry.precision, 1);
  EXPECT_GT(scores.geometry.completion_m, 0.1);
}

TEST_F(EvaluationTest, LabelsAreTakenFromNearOnly) {
  LabelledSurface raised = truth_surface_;
  for (auto& p : raised.mesh.vertices_m) p.z() += 1.0f;
  const Scores scores = ScoresOf(raised);
  EXPECT_LT(scores.semantics.accuracy, 0.1);
  EXPECT_LT(scores.geometry.f_score(), 0.1);
}

TEST_F(EvaluationTest, DoesNotDependOnThreads) {
  LabelledSurface surface = MapOf(**MakeSystem("dhp_no_refine", MapSetup()), frames_);
  ThreadPool one(1), three(3);
  const Scores a = Evaluate(*truth_, surface, true, one, nullptr), b = Evaluate(*truth_, surface, true, three, nullptr);
  EXPECT_EQ(a.panoptics.all.pq, b.panoptics.all.pq);
  EXPECT_EQ(a.semantics.accuracy, b.semantics.accuracy);
  EXPECT_EQ(a.geometry.accuracy_m, b.geometry.accuracy_m);
}

TEST(Systems, AreAllMadeByName) {
  for (const std::string& name : SystemNames()) {
    const auto system = MakeSystem(name, MapSetup());
    ASSERT_TRUE(system.ok()) << name << ": " << system.status().ToString();
    EXPECT_EQ((*system)->name(), name);
  }
}

TEST(Systems, RefuseUnknownNamesAndBadConfigurations) {
  const auto unknown = MakeSystem("dhpp", MapSetup());
  ASSERT_FALSE(unknown.ok());
  EXPECT_NE(unknown.status().message().find("kimera"), std::string::npos) << "lists the names";
  SystemSetup setup = MapSetup();
  setup.config.voxel_size_m = -1;
  EXPECT_FALSE(MakeSystem("dhp", setup).ok());
}

TEST(Systems, WhatIsNotRefinedIsOneFieldOnlyIfThatIsAskedFor) {
  const auto frames = Frames();
  auto each = MakeSystem("dhp_no_refine", MapSetup()), one = MakeSystem("dhp_no_refine_one_field", MapSetup());
  const LabelledSurface surface_of_each = MapOf(**each, frames), surface_of_one = MapOf(**one, frames);
  EXPECT_EQ((*one)->times().refine_s, 0);
  EXPECT_NE(surface_of_one.mesh.triangles.size(), surface_of_each.mesh.triangles.size())
      << "where objects meet: no gaps, and nothing twice";
  EXPECT_FALSE(surface_of_one.mesh.triangles.empty());
}

TEST(Systems, DifferInTheRefinementThatTheyRun) {
  const auto frames = Frames();
  auto none = MakeSystem("dhp_no_refine", MapSetup()), both = MakeSystem("dhp", MapSetup());
  MapOf(**none, frames);
  MapOf(**both, frames);
  EXPECT_EQ((*none)->times().refine_s, 0);
  EXPECT_GT((*both)->times().refine_s, 0);
  EXPECT_EQ((*both)->times().num_frames, 8);
}

}  // namespace
}  // namespace dhpmap::evaluator

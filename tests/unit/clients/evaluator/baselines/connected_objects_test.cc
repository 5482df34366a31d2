// SPDX-License-Identifier: BSD-3-Clause
#include "clients/evaluator/baselines/connected_objects.h"

#include <gtest/gtest.h>

#include <map>
#include <set>

#include "clients/evaluator/baselines/baselines.h"
#include "tests/support/scenes.h"

namespace dhpmap::evaluator {
namespace {

constexpr double kCell_m = 0.1;  // of two voxels of 5 cm
constexpr std::uint16_t kSeat = 1, kDesk = 2, kGround = 3;

/// Vertices along x, at the middle of a cell each.
LabelledSurface VerticesAt(const std::vector<std::pair<int, std::uint16_t>>& cells_and_classes) {
  LabelledSurface surface;
  for (const auto& [cell, class_id] : cells_and_classes) {
    surface.mesh.vertices_m.emplace_back(static_cast<float>(kCell_m * (cell + 0.5)), 0.05f, 0.05f);
    surface.mesh.classes.push_back(class_id);
    surface.mesh.instances.push_back(77);
  }
  NumberConnectedObjects(*dhpmap::testing::MakeLabelSet(2, 1), kCell_m / 2, 2, surface);
  return surface;
}

TEST(ConnectedObjects, AreWhatLiesTogetherOfOneClassOfThings) {
  const LabelledSurface surface =
      VerticesAt({{-1, kSeat}, {3, kSeat}, {0, kSeat}, {1, kDesk}, {2, kDesk}, {5, kSeat}, {4, kSeat}});
  EXPECT_EQ(surface.mesh.instances, (std::vector<std::uint32_t>{1, 2, 1, 3, 3, 2, 2}));
}

TEST(ConnectedObjects, AnotherClassBetweenDoesNotJoinThem) {
  EXPECT_EQ(VerticesAt({{0, kSeat}, {1, kDesk}, {2, kSeat}}).mesh.instances, (std::vector<std::uint32_t>{1, 2, 3}));
}

TEST(ConnectedObjects, BackgroundAndWhatHasNoClassAreNone) {
  EXPECT_EQ(VerticesAt({{0, kGround}, {1, 0}, {9, kGround}, {20, 999}}).mesh.instances,
            (std::vector<std::uint32_t>{0, 0, 0, 0}));
  EXPECT_TRUE(VerticesAt({}).mesh.instances.empty());
}

TEST(ConnectedObjects, OfVotesAreTheThingsThatStandApart) {
  using dhpmap::testing::Solid;
  const dhpmap::testing::Scene scene{
      {{.shape = Solid::Shape::kSphere, .center_m = {1.5, 0.6, 1}, .size_m = {0.3, 0, 0}, .segment = 1},
       {.shape = Solid::Shape::kSphere, .center_m = {1.5, -0.6, 1}, .size_m = {0.3, 0, 0}, .segment = 2},
       {.shape = Solid::Shape::kHalfSpace, .center_m = {3, 0, 0}, .size_m = {-1, 0, 0}, .segment = 3}}};
  PanopticFrame frame = Render(scene, dhpmap::testing::SmallCamera(), dhpmap::testing::LookAt({0, 0, 1}, {1.5, 0, 1}));
  frame.segments = {{.id = SegmentId(1), .class_id = ClassId(1)},
                    {.id = SegmentId(2), .class_id = ClassId(1)},
                    {.id = SegmentId(3), .class_id = ClassId(3)}};
  const auto system = MakeVotesWithObjects({IndoorConfig(), dhpmap::testing::MakeLabelSet(2, 1), 1});
  EXPECT_TRUE(system->has_instances());
  ASSERT_TRUE(system->Integrate(frame).ok());
  system->Finish();
  const LabelledSurface surface = system->Surface();
  std::map<std::uint32_t, std::int64_t> on_left, on_right;
  for (std::size_t i = 0; i < surface.mesh.vertices_m.size(); ++i) {
    if (surface.mesh.classes[i] != 1) continue;
    ++(surface.mesh.vertices_m[i].y() > 0 ? on_left : on_right)[surface.mesh.instances[i]];
  }
  for (const auto* ball : {&on_left, &on_right}) {
    std::int64_t most = 0, all = 0;
    for (const auto& [id, count] : *ball) most = std::max(most, count), all += count;
    EXPECT_GT(all, 100);
    EXPECT_GT(most, all * 9 / 10) << "scraps of the rim may lie apart";
  }
  for (const auto& [id, count] : on_left) EXPECT_EQ(on_right.count(id), 0u) << id;
}

}  // namespace
}  // namespace dhpmap::evaluator

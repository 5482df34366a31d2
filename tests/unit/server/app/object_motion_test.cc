// SPDX-License-Identifier: BSD-3-Clause
#include "server/app/edits/object_motion.h"

#include <gtest/gtest.h>

#include <numbers>

#include "mapping/submap/submap_outline.h"
#include "server/app/edits/edit_list.h"
#include "server/app/edits/edit_summary.h"
#include "tests/unit/mapping/query/surface_scene.h"

namespace dhpmap {
namespace {

constexpr double kQuarter = std::numbers::pi / 2;

/// Far from the origin: a table 0.6 m high, a crate on it, a small box on the crate, and another crate nearby.
class ObjectMotionTest : public ::testing::Test {
 protected:
  ObjectMotionTest() {
    for (std::size_t i = 0; i < solids_.size(); ++i) {
      Submap& submap = testing::AddThing(map_);
      // Each has the voxels that are nearest to it, as after label management.
      testing::ObserveBand(submap, solids_[i], Around(), [this, i](const Eigen::Vector3d& p) {
        for (std::size_t j = 0; j < solids_.size(); ++j) {
          const double own_m = solids_[i](p), other_m = solids_[j](p);
          if (other_m < own_m || (other_m == own_m && j < i)) return false;
        }
        return true;
      });
    }
    map_.Publish(0);
  }
  static Eigen::AlignedBox3d Around() { return {Eigen::Vector3d(2.2, 1.3, -0.2), Eigen::Vector3d(4.7, 2.7, 1.35)}; }
  [[nodiscard]] UprightBox BoxOf(SubmapId id) const { return OutlineInMap(*map_.Find(id))->box; }
  [[nodiscard]] double LowOf(SubmapId id) const { return BoxOf(id).center_m.z() - BoxOf(id).size_m.z() / 2; }
  [[nodiscard]] double HighOf(SubmapId id) const { return BoxOf(id).center_m.z() + BoxOf(id).size_m.z() / 2; }

  Result<std::vector<EditResult>> Make(EditTarget target, decltype(Edit::action) action) {
    EditList list;
    list.edits.push_back({.target = target, .etag = {}, .action = std::move(action)});
    return ApplyEdits(list, map_);
  }
  static Eigen::Vector3d Away(const UprightBox& from, const UprightBox& to) { return to.center_m - from.center_m; }

  const std::vector<testing::SolidDistance> solids_ = {
      testing::Block({3, 2, 0.3}, {0.6, 0.5, 0.3}), testing::Block({3.1, 2, 0.75}, {0.3, 0.25, 0.15}),
      testing::Block({3.1, 2, 1.0}, {0.1, 0.1, 0.1}), testing::Block({4.2, 2, 0.2}, {0.2, 0.3, 0.2})};
  Map map_{testing::SceneInfo()};
  const SubmapId table_{1}, crate_{2}, box_{3}, beside_{4};
};

TEST_F(ObjectMotionTest, SupportedObjectsAreFoundThroughObjectsInBetween) {
  EXPECT_EQ(SupportedBy(table_, map_), (std::vector<SubmapId>{crate_, box_}));
  EXPECT_EQ(SupportedBy(crate_, map_), std::vector<SubmapId>{box_});
  EXPECT_TRUE(SupportedBy(box_, map_).empty());
  EXPECT_TRUE(SupportedBy(beside_, map_).empty());
}

TEST_F(ObjectMotionTest, ATurnKeepsTheCentreInPlace) {
  const UprightBox before = BoxOf(table_), on_it = BoxOf(crate_);
  const auto made = Make(table_, TurnEdit{kQuarter});
  ASSERT_TRUE(made.ok()) << made.status().ToString();
  EXPECT_EQ(made->at(0).changed, std::vector<SubmapId>{table_});
  EXPECT_LT(Away(before, BoxOf(table_)).norm(), 1e-9);
  EXPECT_NEAR(std::abs(BoxOf(table_).yaw_rad), kQuarter, 1e-6);
  EXPECT_EQ(BoxOf(crate_).center_m, on_it.center_m);
}

TEST_F(ObjectMotionTest, ATurnRotatesSupportedObjectsAboutTheSameCentre) {
  const Eigen::Vector3d before = Away(BoxOf(table_), BoxOf(crate_)), of_box = Away(BoxOf(crate_), BoxOf(box_));
  const auto made = Make(table_, TurnEdit{kQuarter, true});
  ASSERT_TRUE(made.ok()) << made.status().ToString();
  EXPECT_EQ(made->at(0).changed, (std::vector<SubmapId>{table_, crate_, box_}));
  const Eigen::Vector3d turned(-before.y(), before.x(), before.z());
  EXPECT_LT((Away(BoxOf(table_), BoxOf(crate_)) - turned).norm(), 1e-9);
  EXPECT_LT((Away(BoxOf(crate_), BoxOf(box_)) - Eigen::Vector3d(-of_box.y(), of_box.x(), of_box.z())).norm(), 1e-9);
}

TEST_F(ObjectMotionTest, AShiftFollowsTheMapsAxes) {
  ASSERT_TRUE(Make(table_, TurnEdit{0.3, true}).ok());
  const UprightBox table = BoxOf(table_), crate = BoxOf(crate_);
  const Eigen::Vector3d offset_m(0.5, -2, 0.1);
  ASSERT_TRUE(Make(table_, TranslateEdit{offset_m, true}).ok());
  EXPECT_LT((Away(table, BoxOf(table_)) - offset_m).norm(), 1e-9);
  EXPECT_LT((Away(crate, BoxOf(crate_)) - offset_m).norm(), 1e-9);
}

TEST_F(ObjectMotionTest, AMoveIncludesSupportedObjects) {
  const UprightBox crate = BoxOf(crate_), box = BoxOf(box_);
  const Transform T(Eigen::Translation3d(1, 0, 0));
  const auto made = Make(crate_, PatchEdit{{.T_map_submap = T}, true});
  ASSERT_TRUE(made.ok()) << made.status().ToString();
  EXPECT_EQ(made->at(0).changed, (std::vector<SubmapId>{crate_, box_}));
  EXPECT_LT((Away(crate, BoxOf(crate_)) - T.translation()).norm(), 1e-9);
  EXPECT_LT((Away(box, BoxOf(box_)) - T.translation()).norm(), 1e-9);
}

TEST_F(ObjectMotionTest, APlacedObjectStandsOnTheCentreOfTheUpperSide) {
  const auto made = Make(beside_, PlaceEdit{.support = table_});
  ASSERT_TRUE(made.ok()) << made.status().ToString();
  EXPECT_LT((BoxOf(beside_).center_m - BoxOf(table_).center_m).head<2>().norm(), 0.03);
  EXPECT_NEAR(LowOf(beside_), HighOf(table_), 0.02);
  EXPECT_EQ(SupportedBy(table_, map_), (std::vector<SubmapId>{crate_, box_, beside_}));
}

TEST_F(ObjectMotionTest, AnObjectPlacedAtAPointStandsOnTheSurfaceThere) {
  const auto made = Make(crate_, PlaceEdit{.support = beside_, .point_m = Eigen::Vector2d(4.25, 2.1)});
  ASSERT_TRUE(made.ok()) << made.status().ToString();
  EXPECT_EQ(made->at(0).changed, std::vector<SubmapId>{crate_});
  EXPECT_NEAR(BoxOf(crate_).center_m.x(), 4.25, 1e-9);
  EXPECT_NEAR(BoxOf(crate_).center_m.y(), 2.1, 1e-9);
  EXPECT_NEAR(LowOf(crate_), 0.4, 0.02);
}

TEST_F(ObjectMotionTest, LaterPlacementsOfAListUseTheResultsOfEarlierEdits) {
  EditList list;
  list.edits.push_back({.target = beside_, .etag = {}, .action = CloneEdit{}});
  list.edits.push_back({.target = EarlierResult{0}, .etag = {}, .action = PlaceEdit{.support = beside_}});
  list.edits.push_back({.target = beside_, .etag = {}, .action = TranslateEdit{{0, 1, 0}, true}});
  const auto made = ApplyEdits(list, map_);
  ASSERT_TRUE(made.ok()) << made.status().ToString();
  const SubmapId copy = made->at(0).created.at(0);
  EXPECT_NEAR(LowOf(copy), HighOf(beside_), 0.02);
  EXPECT_EQ(made->at(2).changed, (std::vector<SubmapId>{beside_, copy}));
  EXPECT_LT((BoxOf(copy).center_m - BoxOf(beside_).center_m).head<2>().norm(), 0.03);
  const EditSummary summary = SummaryOfList(list, *made);
  EXPECT_EQ(
      summary.steps,
      (std::vector<EditStep>{{EditAction::kClone, beside_}, {EditAction::kMove, copy}, {EditAction::kMove, beside_}}));
}

TEST_F(ObjectMotionTest, AnObjectCannotBePlacedOnItselfOrOnWhatMovesWithIt) {
  EXPECT_EQ(Make(table_, PlaceEdit{.support = table_}).status().reason().name(), "SUPPORT_MOVES");
  const PlaceEdit on_crate{.support = crate_, .point_m = std::nullopt, .include_supported = true};
  EXPECT_EQ(Make(table_, on_crate).status().reason().name(), "SUPPORT_MOVES");
  EXPECT_EQ(Make(table_, PlaceEdit{.support = SubmapId(99)}).status().code(), StatusCode::kNotFound);
}

TEST_F(ObjectMotionTest, APlacementNeedsASurfaceOfTheSupport) {
  const auto made = Make(crate_, PlaceEdit{.support = beside_, .point_m = Eigen::Vector2d(7, 7)});
  EXPECT_EQ(made.status().reason().name(), "NO_SURFACE");
  ASSERT_EQ(made.status().violations().size(), 1u);
  EXPECT_EQ(made.status().violations()[0].field, "edits[0].place.support");
}

TEST_F(ObjectMotionTest, AnObjectWithoutASurfaceCannotBeTurnedOrPlaced) {
  const SubmapId empty = testing::AddThing(map_).id();
  EXPECT_EQ(Make(empty, TurnEdit{1}).status().reason().name(), "NO_SURFACE");
  EXPECT_EQ(Make(empty, PlaceEdit{.support = table_}).status().reason().name(), "NO_SURFACE");
  EXPECT_TRUE(Make(empty, TranslateEdit{{1, 0, 0}}).ok());
}

}  // namespace
}  // namespace dhpmap

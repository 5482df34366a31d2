// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/query/submap_search.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "tests/unit/mapping/query/surface_scene.h"

namespace dhpmap {
namespace {

/// A room with many small things at random poses, and all their triangles.
class Clutter : public ::testing::Test {
 protected:
  Clutter() {
    std::mt19937 random(9);
    for (int i = 0; i < 12; ++i) {
      Submap& copy = *map.Clone(SubmapId(1 + i % 3));
      copy.mutable_info().T_map_submap = testing::RandomPose(random, 2);
    }
    map.FindMutable(SubmapId(2))->mutable_info().display_name = "Grandma's Chest";
    surfaces = cache.Of(map.Publish(0));
    for (const auto& submap : map.published()->submaps()) {
      triangles[submap->id()] = testing::TrianglesInMap(*submap);
    }
  }
  [[nodiscard]] double DistanceTo(SubmapId id, const Eigen::Vector3d& p_map) const {
    double least_m = 1e9;
    for (const auto& triangle : triangles.at(id))
      least_m = std::min(least_m, testing::DistanceToTriangle(p_map, triangle));
    return least_m;
  }
  static std::vector<SubmapId> Ids(const std::vector<SubmapMatch>& matches) {
    std::vector<SubmapId> ids;
    for (const SubmapMatch& match : matches) ids.push_back(match.submap->id());
    return ids;
  }

  Map map = testing::FurnishedRoom();
  SurfaceCache cache{std::size_t{1} << 30};
  std::shared_ptr<const MapSurfaces> surfaces;
  std::map<SubmapId, std::vector<std::array<Eigen::Vector3d, 3>>> triangles;
};

TEST_F(Clutter, TheNearestEqualThoseOfBruteForce) {
  std::mt19937 random(4);
  const Transform T = testing::RandomPose(random, 1);
  for (const Eigen::Vector3d& p : testing::RandomPoints(12, 2, 6)) {
    const auto matches = SearchSubmaps(*surfaces, {.T_map_query = T, .near_m = p, .most = 5});
    ASSERT_EQ(matches.size(), 5u);
    std::vector<double> all_m;
    for (const auto& entry : triangles) all_m.push_back(DistanceTo(entry.first, T * p));
    std::sort(all_m.begin(), all_m.end());
    for (std::size_t i = 0; i < matches.size(); ++i) {
      EXPECT_NEAR(matches[i].distance_m, all_m[i], 1e-4);
      EXPECT_NEAR(DistanceTo(matches[i].submap->id(), T * p), all_m[i], 1e-4);
      EXPECT_NEAR((matches[i].nearest_m - p).norm(), matches[i].distance_m, 1e-4);
    }
  }
  const auto near = SearchSubmaps(*surfaces, {.near_m = Eigen::Vector3d::Zero(), .max_distance_m = 1.0, .most = 100});
  EXPECT_FALSE(near.empty());
  for (const SubmapMatch& match : near) EXPECT_LE(match.distance_m, 1.0);
  for (const auto& entry : triangles) {
    const bool is_near = DistanceTo(entry.first, Eigen::Vector3d::Zero()) < 1.0;
    const auto ids = Ids(near);
    EXPECT_EQ(std::find(ids.begin(), ids.end(), entry.first) != ids.end(), is_near) << entry.first.value;
  }
}

TEST_F(Clutter, RegionsHoldThoseWithSomeOfTheirSurfaceInThem) {
  for (const Eigen::Vector3d& center : testing::RandomPoints(10, 2, 8)) {
    const BoundingSphere sphere{center, 0.6};
    std::vector<SubmapId> expected, in_box;
    const Eigen::AlignedBox3d box(center - Eigen::Vector3d(0.3, 0.5, 0.2), center + Eigen::Vector3d(0.3, 0.5, 0.2));
    for (const auto& [id, all] : triangles) {
      if (DistanceTo(id, center) <= sphere.radius_m) expected.push_back(id);
      // Dense points of each triangle instead of cutting it.
      const bool is_in = std::any_of(all.begin(), all.end(), [&box](const auto& t) {
        if (!Eigen::AlignedBox3d(t[0]).extend(t[1]).extend(t[2]).intersects(box)) return false;
        for (int i = 0; i <= 20; ++i) {
          for (int j = 0; i + j <= 20; ++j) {
            if (box.contains(t[0] + i / 20.0 * (t[1] - t[0]) + j / 20.0 * (t[2] - t[0]))) return true;
          }
        }
        return false;
      });
      if (is_in) in_box.push_back(id);
    }
    EXPECT_EQ(Ids(SearchSubmaps(*surfaces, {.sphere_m = sphere})), expected);
    EXPECT_EQ(Ids(SearchSubmaps(*surfaces, {.box_m = box})), in_box);
  }
}

TEST_F(Clutter, NamesAndClassesChooseAndTheFirstComeFirst) {
  EXPECT_EQ(Ids(SearchSubmaps(*surfaces, {.name_part = "grandMA"})), std::vector{SubmapId(2)});
  const auto of_class = SearchSubmaps(*surfaces, {.scope = {.classes = std::vector{ClassId(2)}}, .most = 3});
  ASSERT_EQ(of_class.size(), 3u);
  for (const SubmapMatch& match : of_class) EXPECT_EQ(match.submap->info().class_id, ClassId(2));
  EXPECT_EQ(of_class[0].submap->id(), SubmapId(2)) << "not the unknown submap, which has no class";
  EXPECT_TRUE(SearchSubmaps(*surfaces, {.name_part = "no such"}).empty());
  EXPECT_TRUE(SearchSubmaps(*surfaces, {.most = 0}).empty());
}

TEST_F(Clutter, PagesTogetherAreAllMatches) {
  for (const auto& near_m : {std::optional<Eigen::Vector3d>(), std::optional(Eigen::Vector3d(0.3, -0.2, 0.5))}) {
    const auto all = SearchSubmaps(*surfaces, {.near_m = near_m, .most = 1000});
    ASSERT_GT(all.size(), 5u);
    SubmapQuestion question{.near_m = near_m, .most = 3};
    std::vector<SubmapId> paged;
    for (;;) {
      const auto page = SearchSubmaps(*surfaces, question);
      if (page.empty()) break;
      for (const SubmapMatch& match : page) paged.push_back(match.submap->id());
      ASSERT_LE(paged.size(), all.size());
      question.after = MatchPlace{page.back().distance_m, page.back().submap->id()};
    }
    EXPECT_EQ(paged, Ids(all));
  }
}

TEST_F(Clutter, BoxesAreTightAroundTheSurfaceInTheAskersFrame) {
  std::mt19937 random(14);
  const Transform T = testing::RandomPose(random, 1);
  for (const SubmapMatch& match : SearchSubmaps(*surfaces, {.T_map_query = T})) {
    Eigen::AlignedBox3d expected;
    for (const auto& triangle : triangles.at(match.submap->id())) {
      for (const Eigen::Vector3d& corner : triangle) expected.extend(T.inverse() * corner);
    }
    EXPECT_TRUE(match.box_m.isApprox(expected, 1e-6));
  }
}

}  // namespace
}  // namespace dhpmap

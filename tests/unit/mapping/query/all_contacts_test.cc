// SPDX-License-Identifier: BSD-3-Clause
// All contacts of a motion, against what looking at very many moments of it finds.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <memory>
#include <random>
#include <utility>
#include <vector>

#include "mapping/query/trajectory_query.h"
#include "tests/unit/mapping/query/surface_scene.h"

namespace dhpmap {
namespace {

using Course = std::vector<SphereKnot>;

/// The surface of one object, to be looked at triangle by triangle.
struct Shell {
  SubmapId id;
  std::vector<std::array<Eigen::Vector3d, 3>> triangles;  ///< map frame
  BoundingSphere around;

  /// To the surface, from either side; a lower bound of it if that is above `enough_m`.
  [[nodiscard]] double DistanceTo(const Eigen::Vector3d& p, double enough_m) const {
    const double bound_m = (p - around.center_m).norm() - around.radius_m;
    if (bound_m > enough_m) return bound_m;
    double best_m = std::numeric_limits<double>::infinity();
    for (const auto& triangle : triangles) best_m = std::min(best_m, testing::DistanceToTriangle(p, triangle));
    return best_m;
  }
};

std::vector<Shell> ShellsOf(const MapSnapshot& map) {
  std::vector<Shell> shells;
  for (const auto& submap : map.submaps()) {
    Shell shell{.id = submap->id(), .triangles = testing::TrianglesInMap(*submap), .around = {}};
    if (shell.triangles.empty()) continue;
    Eigen::AlignedBox3d box;
    for (const auto& triangle : shell.triangles) {
      for (const Eigen::Vector3d& corner : triangle) box.extend(corner);
    }
    shell.around = {box.center(), 0.5 * box.diagonal().norm()};
    shells.push_back(std::move(shell));
  }
  return shells;
}

SphereKnot MomentOf(const Course& course, double at) {
  const auto i = std::min(static_cast<std::size_t>(at), course.size() - 2);
  const double share = at - static_cast<double>(i);
  return {at, course[i].center_m + share * (course[i + 1].center_m - course[i].center_m),
          course[i].radius_m + share * (course[i + 1].radius_m - course[i].radius_m)};
}

/// How far the sphere is from touching the object's surface.
double GapOf(const Course& course, double at, const Shell& shell) {
  const SphereKnot moment = MomentOf(course, at);
  return shell.DistanceTo(moment.center_m, moment.radius_m + 0.1) - moment.radius_m;
}

constexpr int kMomentsAWaypoint = 50;

/// The first of many moments at which the sphere touches the object; infinity: at none of them.
double FirstMoment(const Course& course, const Shell& shell) {
  const auto last = static_cast<int>(course.size() - 1) * kMomentsAWaypoint;
  for (int i = 0; i <= last; ++i) {
    const double at = static_cast<double>(i) / kMomentsAWaypoint;
    if (GapOf(course, at, shell) <= 0) return at;
  }
  return std::numeric_limits<double>::infinity();
}

/// Four balls and a block that is turned, whose surfaces are closed: nobody gets inside without a touch.
Map FiveSolids() {
  Map map(testing::SceneInfo());
  for (const Eigen::Vector3d& center :
       {Eigen::Vector3d(0.5, 0.4, 0.1), {-0.5, 0.5, -0.3}, {-0.4, -0.5, 0.4}, {0.45, -0.4, -0.5}}) {
    testing::ObserveBand(testing::AddThing(map), testing::Ball(center, 0.2), testing::CubeAt(center, 0.45));
  }
  Transform turned = Transform::Identity();
  turned.rotate(Eigen::AngleAxisd(0.6, Eigen::Vector3d(1, 2, 3).normalized()));
  testing::ObserveBand(testing::AddThing(map, ClassId(2), turned), testing::Block({0, 0, 0}, {0.12, 0.15, 0.1}),
                       testing::CubeAt({0, 0, 0}, 0.35));
  return map;
}

/// Three spheres on ways of their own, each beginning where it touches nothing.
RobotMotion RandomMotion(std::mt19937& random, const std::vector<Shell>& shells) {
  std::uniform_real_distribution<double> unit(-1, 1);
  const auto anywhere = [&] {
    return Eigen::Vector3d(0.9 * Eigen::Vector3d{unit(random), unit(random), unit(random)});
  };
  RobotMotion motion;
  while (motion.spheres.size() < 3) {
    Course course;
    course.reserve(5);
    for (int h = 0; h < 5; ++h) course.push_back({static_cast<double>(h), anywhere(), 0.06 + 0.03 * unit(random)});
    const bool is_clear = std::all_of(shells.begin(), shells.end(), [&](const Shell& shell) {
      return (course[0].center_m - shell.around.center_m).norm() > shell.around.radius_m + 0.1;  // and outside of it
    });
    if (is_clear) motion.spheres.push_back(std::move(course));
  }
  return motion;
}

Result<TrajectoryAnswer> CheckWith(const std::shared_ptr<const MapSurfaces>& surfaces, const RobotMotion& motion,
                                   std::size_t max_contacts) {
  return TrajectoryQuery::Make(surfaces, {.bodies = {.unknown = UnknownSpace::kFree}, .max_contacts = max_contacts})
      ->Check(motion);
}

using Pair = std::pair<std::size_t, SubmapId>;  ///< a sphere and an object
Pair PairOf(const TrajectoryContact& contact) { return {contact.sphere.value(), contact.contact.submap->id}; }

/// Every contact is the first touch of its pair, and every pair that touches at one of the moments has one.
void ExpectAllAreFirstTouches(const RobotMotion& motion, const std::vector<Shell>& shells,
                              const TrajectoryAnswer& all) {
  std::map<Pair, double> told;
  for (const TrajectoryContact& contact : all.contacts) {
    EXPECT_TRUE(told.emplace(PairOf(contact), contact.at).second) << "a pair is told once";
  }
  for (std::size_t s = 0; s < motion.spheres.size(); ++s) {
    for (const Shell& shell : shells) {
      const double moment = FirstMoment(motion.spheres[s], shell);
      const auto contact = told.find({s, shell.id});
      if (contact == told.end()) {
        EXPECT_EQ(moment, std::numeric_limits<double>::infinity()) << "sphere " << s << ", object " << shell.id.value;
        continue;
      }
      // Between two moments it may touch and be off again.
      EXPECT_LE(contact->second, moment + 1e-4);
      EXPECT_NEAR(GapOf(motion.spheres[s], contact->second, shell), 0, 1e-4);
    }
  }
}

TEST(AllContacts, AreTheFirstTouchesOfAllPairsThatDenseSamplingFindsInTheirOrder) {
  Map map = FiveSolids();
  const auto state = map.Publish(0);
  SurfaceCache cache(std::size_t{1} << 30);
  const auto surfaces = cache.Of(state);
  const std::vector<Shell> shells = ShellsOf(*state);
  ASSERT_EQ(shells.size(), 5u);
  std::mt19937 random(12);
  std::size_t num_contacts = 0, num_later = 0;
  for (int round = 0; round < 12; ++round) {
    SCOPED_TRACE(round);
    const RobotMotion motion = RandomMotion(random, shells);
    const auto first = CheckWith(surfaces, motion, 1), all = CheckWith(surfaces, motion, 100);
    ASSERT_TRUE(first.ok() && all.ok());
    ExpectAllAreFirstTouches(motion, shells, *all);
    EXPECT_TRUE(std::is_sorted(all->contacts.begin(), all->contacts.end(),
                               [](const auto& a, const auto& b) { return a.at < b.at; }));
    EXPECT_EQ(first->is_valid, all->is_valid);
    ASSERT_EQ(first->contacts.empty(), all->contacts.empty());
    if (all->contacts.empty()) continue;
    EXPECT_NEAR(first->contacts[0].at, all->contacts[0].at, 1e-9) << "the first is among them";
    EXPECT_EQ(PairOf(first->contacts[0]), PairOf(all->contacts[0]));
    num_contacts += all->contacts.size();
    num_later += all->contacts.size() - 1;
  }
  EXPECT_GT(num_contacts, 15u);
  EXPECT_GT(num_later, 5u);
}

TEST(AllContacts, AreTheEarliestWhereFewerAreAskedFor) {
  Map map = FiveSolids();
  const auto state = map.Publish(0);
  SurfaceCache cache(std::size_t{1} << 30);
  const auto surfaces = cache.Of(state);
  const std::vector<Shell> shells = ShellsOf(*state);
  std::mt19937 random(21);
  std::size_t num_cut = 0;
  for (int round = 0; round < 20; ++round) {
    SCOPED_TRACE(round);
    const RobotMotion motion = RandomMotion(random, shells);
    const auto all = CheckWith(surfaces, motion, 100);
    ASSERT_TRUE(all.ok());
    for (const std::size_t most : {2u, 3u}) {
      const auto some = CheckWith(surfaces, motion, most);
      ASSERT_TRUE(some.ok());
      ASSERT_EQ(some->contacts.size(), std::min(most, all->contacts.size()));
      for (std::size_t i = 0; i < some->contacts.size(); ++i) {
        EXPECT_EQ(some->contacts[i].at, all->contacts[i].at);
        EXPECT_EQ(PairOf(some->contacts[i]), PairOf(all->contacts[i]));
      }
      num_cut += all->contacts.size() - some->contacts.size();
    }
  }
  EXPECT_GT(num_cut, 5u);
}

TEST(AllContacts, UnseenSpaceIsToldOnceAPartBesideTheObjects) {
  Map map(testing::SceneInfo());
  const Eigen::Vector3d center(1.0, 0.5, 0.5);
  testing::ObserveBand(testing::AddThing(map), testing::Ball(center, 0.2), testing::CubeAt(center, 0.45));
  FreeBlocks seen;
  seen.full = ~std::uint64_t{0};  // 0 to 1.6 m, the inside of the ball too
  map.mutable_free_space().Add({0, 0, 0}, seen, 1);
  SurfaceCache cache(std::size_t{1} << 30);
  const auto surfaces = cache.Of(map.Publish(0));
  RobotMotion motion;
  for (const double y : {0.5, 1.2}) motion.spheres.push_back({{0, {0.4, y, 0.5}, 0.1}, {1, {2.4, y, 0.5}, 0.1}});
  const auto all = TrajectoryQuery::Make(surfaces, {.max_contacts = 10})->Check(motion);
  ASSERT_TRUE(all.ok());
  ASSERT_EQ(all->contacts.size(), 3u);
  EXPECT_EQ(all->contacts[0].contact.submap->id, SubmapId(1));
  EXPECT_EQ(all->contacts[0].sphere, 0u);
  EXPECT_NEAR(all->contacts[0].at, 0.3 / 2, 0.005);
  for (const std::size_t i : {1u, 2u}) {
    EXPECT_EQ(all->contacts[i].contact.submap, nullptr);
    EXPECT_NEAR(all->contacts[i].at, (1.625 - 0.1 - 0.4) / 2, 0.03) << "where the voxels end that somebody has seen";
  }
  EXPECT_FALSE(all->is_valid);
  EXPECT_FALSE(all->is_unknown) << "it touches the ball before";
}

}  // namespace
}  // namespace dhpmap

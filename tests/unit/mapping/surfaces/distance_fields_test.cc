// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/surfaces/distance_fields.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <functional>
#include <thread>
#include <utility>
#include <vector>

#include "mapping/geometry/field_normals.h"
#include "mapping/query/distance_query.h"
#include "mapping/surfaces/near_field_maker.h"
#include "tests/unit/mapping/query/scene_surfaces.h"
#include "tests/unit/mapping/query/surface_scene.h"

namespace dhpmap {
namespace {

using testing::AllTriangles;
using testing::DisarrayedRoom;
using testing::kPlenty;
using testing::kSceneVoxel_m;

constexpr int kTimesAField = 70;  // more often than a cell must be asked for to be made
constexpr double kRounding_m = 2e-5;
constexpr double kMost_m = NearField::kTolerance_vox * kSceneVoxel_m;

DistanceOptions Approximate(DistanceOptions options = {}) {
  options.tolerance_vox = 0.5;
  return options;
}

/// Answers of near fields, where there are any after so many questions.
std::vector<SurfaceDistance> AskOften(const DistanceQuery& query, const std::vector<Eigen::Vector3d>& points) {
  std::vector<SurfaceDistance> answers(points.size());
  for (int n = 0; n < kTimesAField; ++n) query.At(points, answers);
  return answers;
}

struct Errors {
  std::vector<double> distances_vox, angles_deg;
  int num_points = 0, num_sides = 0, num_states = 0;

  void Add(const SurfaceDistance& quick, const SurfaceDistance& exact) {
    ++num_points;
    num_states += quick.status != exact.status;
    distances_vox.push_back(std::abs(std::abs(quick.distance_m) - std::abs(exact.distance_m)) / kSceneVoxel_m);
    if (quick.submap == nullptr || exact.submap == nullptr) return;
    num_sides += (quick.distance_m < 0) != (exact.distance_m < 0);
    angles_deg.push_back(std::acos(std::clamp(quick.gradient.dot(exact.gradient), -1.0, 1.0)) * 180 / M_PI);
  }
  static double Quantile(std::vector<double>& values, double share) {
    std::sort(values.begin(), values.end());
    return values.empty() ? 0 : values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1))];
  }
  void ExpectSmall(const char* what) {
    const double median = Quantile(distances_vox, 0.5), p99 = Quantile(distances_vox, 0.99);
    const double most = Quantile(distances_vox, 1);
    const double turned = Quantile(angles_deg, 0.5), turned99 = Quantile(angles_deg, 0.99);
    std::printf(
        "%-10s distance, voxels: median %.4f p99 %.4f max %.4f; gradient, degrees: median %.2f p99 %.2f; "
        "other side %d, other status %d of %d\n",
        what, median, p99, most, turned, turned99, num_sides, num_states, num_points);
    EXPECT_LT(most, NearField::kTolerance_vox + 1e-3);
    EXPECT_LT(p99, 0.35);
    EXPECT_LT(turned, 5);
    EXPECT_LT(turned99, 30);
    EXPECT_LT(num_sides, 1 + num_points / 200);
    EXPECT_LT(num_states, 1 + num_points / 200);
  }
};

void ExpectNearExact(const std::shared_ptr<const MapSnapshot>& state, SurfaceCache& cache,
                     const DistanceOptions& options, const std::vector<Eigen::Vector3d>& points, Errors& errors) {
  SurfaceCache fresh(kPlenty);
  const DistanceQuery quick(cache.Of(state), Approximate(options)), exact(fresh.Of(state), options);
  const std::vector<SurfaceDistance> batch = AskOften(quick, points);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const SurfaceDistance truth = exact.At(points[i]);
    errors.Add(batch[i], truth);
    errors.Add(quick.At(points[i]), truth);
    if (batch[i].submap == nullptr) continue;
    const double padding_m = options.scope.padding.default_m;
    EXPECT_NEAR((points[i] - batch[i].nearest_m).norm(), std::abs(batch[i].distance_m + padding_m), 1e-5);
    EXPECT_NEAR(batch[i].gradient.norm(), 1, 1e-5);
  }
}

TEST(NearField, IsWithinItsToleranceOfAllTriangles) {
  Map map = DisarrayedRoom(3);
  SurfaceCache cache(kPlenty);
  const auto state = map.Publish(0);
  const auto surfaces = cache.Of(state);
  const AllTriangles all(*state);
  const auto ledger = std::make_shared<SurfaceLedger>();
  std::mt19937 random(5);
  std::uniform_int_distribution<int> block(-6, 5);
  std::uniform_real_distribution<double> unit(-0.5, 0.5);
  constexpr double kSide_m = kBlockSide * kSceneVoxel_m;
  int num_known = 0, num_asked = 0;
  for (int n = 0; n < 10; ++n) {
    const auto field = NearFieldMaker(*surfaces).Make({block(random), block(random), block(random)}, ledger);
    ASSERT_NE(field, nullptr);
    ASSERT_FALSE(field->is_far());
    for (int k = 0; k < 10; ++k) {
      const Eigen::Vector3d offset = kSide_m * Eigen::Vector3d{unit(random), unit(random), unit(random)};
      const Eigen::Vector3f p = offset.cast<float>();
      const NearField::List list = field->ListOf(field->CubeAt(p));
      ++num_asked;
      if (list.count == 0) continue;
      ++num_known;
      const double distance_m = field->Find(p, list).away.norm();
      const double truth_m = all.Nearest(field->centre_m() + offset).distance_m;
      EXPECT_GT(distance_m, truth_m - kRounding_m);
      EXPECT_LT(distance_m, truth_m + std::min(kMost_m, NearField::kShare * truth_m) + kRounding_m);
    }
  }
  EXPECT_EQ(num_known, num_asked);
  EXPECT_EQ(ledger->cell_bytes, 0u) << "given back";
}

TEST(NearField, KnowsThatThereIsNothing) {
  Map map(testing::SceneInfo());
  testing::ObserveBand(testing::AddThing(map), testing::Ball({0, 0, 0}, 0.3), testing::CubeAt({0, 0, 0}, 0.5));
  SurfaceCache cache(kPlenty);
  const auto state = map.Publish(0);
  const auto surfaces = cache.Of(state);
  EXPECT_TRUE(NearFieldMaker(*surfaces).Make({10, 0, 0}, std::make_shared<SurfaceLedger>())->is_far());
  EXPECT_FALSE(NearFieldMaker(*surfaces).Make({8, 0, 0}, std::make_shared<SurfaceLedger>())->is_far());
  const DistanceQuery query(surfaces, Approximate({.max_distance_m = 3.2}));
  const std::vector<Eigen::Vector3d> points = {{4.1, 0.1, 0.1}, {3.45, 0.1, 0.1}, {0.7, 0.1, 0.1}};
  const auto answers = AskOften(query, points);
  EXPECT_EQ(answers[0].status, DistanceStatus::kClamped);
  EXPECT_EQ(answers[0].distance_m, 3.2);
  EXPECT_NEAR(answers[1].distance_m, 3.15, kMost_m);
  EXPECT_NEAR(answers[2].distance_m, 0.41, kMost_m);
}

TEST(DistanceFields, AnswerAsTheExactSearchWithinTheTolerance) {
  Errors errors;
  for (const unsigned seed : {3u, 4u}) {
    Map map = DisarrayedRoom(seed);
    SurfaceCache cache(kPlenty);
    const auto state = map.Publish(0);
    ExpectNearExact(state, cache, {}, testing::RandomPoints(250, 0.7, seed), errors);
    EXPECT_GT(cache.Of(state)->fields().store()->num_fields(), 30u);
    ExpectNearExact(state, cache, {.max_distance_m = 0.3}, testing::RandomPoints(30, 1.9, 40 + seed), errors);
  }
  errors.ExpectSmall("scenes");
}

TEST(DistanceFields, ServeWhateverIsExcludedAndHoweverAllIsGrown) {
  Errors errors;
  Map map = DisarrayedRoom(6);
  SurfaceCache cache(kPlenty);
  const auto state = map.Publish(0);
  const auto points = testing::RandomPoints(120, 0.9, 9);
  DistanceOptions options;
  options.scope.excluded_submaps = {SubmapId(4), SubmapId(2)};
  ExpectNearExact(state, cache, options, points, errors);
  options.scope = {.attached = {SubmapId(1)}};
  ExpectNearExact(state, cache, options, points, errors);
  options.scope = {.padding = {.default_m = 0.1}};
  ExpectNearExact(state, cache, options, points, errors);
  errors.ExpectSmall("excluded");
}

TEST(DistanceFields, GoOnThroughRandomEditsAsIfMadeAnew) {
  Errors errors;
  Map map = DisarrayedRoom(7);
  SurfaceCache cache(kPlenty);
  std::mt19937 random(8);
  std::uniform_real_distribution<double> unit(-1, 1);
  std::vector<SubmapId> clones;
  std::size_t num_carried = 0;
  std::shared_ptr<const MapSnapshot> state = map.Publish(0);
  const auto points = testing::RandomPoints(30, 1.8, 1);
  ExpectNearExact(state, cache, {}, points, errors);
  for (unsigned step = 0; step < 10; ++step) {
    const SubmapId any(1 + random() % 3);
    switch (step % 5) {
      case 0:
        map.FindMutable(any)->mutable_info().T_map_submap.translation() +=
            0.2 * Eigen::Vector3d{unit(random), unit(random), 0};
        break;
      case 1: {
        Submap& clone = *map.Clone(any);
        clone.mutable_info().T_map_submap = testing::RandomPose(random, 0.9);
        clones.push_back(clone.id());
        break;
      }
      case 2: {  // one more thing is seen, in the frame of one that is there
        const Eigen::Vector3d at{unit(random), unit(random), unit(random)};
        testing::ObserveBand(*map.FindMutable(any), testing::Ball(at, 0.12), testing::CubeAt(at, 0.2));
        break;
      }
      case 3:
        EXPECT_TRUE(map.Remove(clones.back()));
        clones.pop_back();
        break;
      default: map.FindMutable(kUnknownSubmap)->mutable_info().T_map_submap = testing::RandomPose(random, 0.3);
    }
    state = map.Publish(static_cast<std::int64_t>(step) + 1);
    const auto surfaces = cache.Of(state);
    // Before anything is made in the new state: what is there already must be right, too.
    const DistanceQuery quick(surfaces, Approximate());
    SurfaceCache fresh(kPlenty);
    const DistanceQuery exact(fresh.Of(state), {});
    for (const Eigen::Vector3d& p : points) {
      errors.Add(quick.At(p), exact.At(p));
      DistanceFields::Slot* slot = surfaces->fields().SlotAt(p);
      num_carried += slot != nullptr && slot->load() > CellSlots::kMostAsked;
    }
    ExpectNearExact(state, cache, {}, points, errors);
  }
  EXPECT_GT(num_carried, 10u) << "of what is far from what changes";
  errors.ExpectSmall("edits");
}

TEST(DistanceFields, AreNotAskedForExactAnswers) {
  Map map = DisarrayedRoom(9);
  SurfaceCache cache(kPlenty), fresh(kPlenty);
  const auto state = map.Publish(0);
  const auto points = testing::RandomPoints(100, 0.9, 2);
  (void)AskOften(DistanceQuery(cache.Of(state), Approximate()), points);
  const DistanceQuery after(cache.Of(state), {}), reference(fresh.Of(state), {});
  const DistanceQuery within(cache.Of(state), Approximate());
  std::vector<SurfaceDistance> batch(points.size());
  after.At(points, batch);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const SurfaceDistance truth = reference.At(points[i]);
    for (const SurfaceDistance& answer : {batch[i], after.At(points[i]), within.Within(points[i], 3)}) {
      EXPECT_EQ(answer.distance_m, truth.distance_m);
      EXPECT_EQ(answer.gradient, truth.gradient);
      EXPECT_EQ(answer.submap, truth.submap);
      EXPECT_EQ(answer.status, truth.status);
    }
  }
}

TEST(DistanceFields, OfManyThreadsAreRight) {
  Map map = DisarrayedRoom(10);
  SurfaceCache cache(kPlenty), fresh(kPlenty);
  const auto state = map.Publish(0);
  const auto points = testing::RandomPoints(60, 0.7, 3);
  const DistanceQuery quick(cache.Of(state), Approximate()), exact(fresh.Of(state), {});
  std::vector<std::vector<SurfaceDistance>> answers(4);
  std::vector<std::thread> threads;
  threads.reserve(answers.size());
  for (auto& mine : answers) threads.emplace_back([&] { mine = AskOften(quick, points); });
  for (std::thread& thread : threads) thread.join();
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double truth_m = std::abs(exact.At(points[i]).distance_m);
    for (const auto& mine : answers) EXPECT_NEAR(std::abs(mine[i].distance_m), truth_m, kMost_m + kRounding_m);
  }
}

TEST(DistanceFields, TakeNoMoreMemoryThanTheyMay) {
  Map map = DisarrayedRoom(11);
  constexpr std::size_t kLimit = 4 << 20;
  SurfaceCache cache(kLimit);
  const auto state = map.Publish(0);
  const auto points = testing::RandomPoints(192, 1.0, 4);
  std::size_t most = 0, least_after = 0;
  for (int n = 0; n < kTimesAField; ++n) {
    const DistanceQuery query(cache.Of(state), Approximate());
    std::vector<SurfaceDistance> answers(64);
    for (std::size_t i = 0; i + 64 <= points.size(); i += 64) query.At(std::span(points).subspan(i, 64), answers);
    most = std::max(most, cache.bytes() + cache.cell_bytes());
    least_after = cache.cell_bytes();
  }
  EXPECT_GT(least_after, 0u);
  EXPECT_LT(most, 8 * kLimit) << "what is in use goes only when the query does";
}

/// A field at the origin that sees as far as a metre or so, and states around it.
class FieldStoreTest : public ::testing::Test {
 protected:
  FieldStoreTest() {
    testing::ObserveBand(testing::AddThing(map_), testing::Ball({0, 0, 0}, 0.3), testing::CubeAt({0, 0, 0}, 0.5));
    state_ = map_.Publish(0);
    surfaces_ = cache_.Of(state_);
  }
  std::shared_ptr<const NearField> MakeField() { return NearFieldMaker(*surfaces_).Make({0, 0, 0}, ledger_); }
  static std::vector<SurfaceChange> ChangeIn(const Eigen::AlignedBox3d& box_m, std::uint32_t id, bool is_gone) {
    return {{.submap = SubmapId(id),
             .is_gone = is_gone,
             .T_submap_map = Transform::Identity(),
             .boxes_m = {box_m},
             .around_m = box_m}};
  }
  static Eigen::AlignedBox3d BoxAt(double x_m) {
    return {Eigen::Vector3d(x_m, -0.1, -0.1), Eigen::Vector3d(x_m + 0.2, 0.1, 0.1)};
  }
  static std::vector<SurfaceChange> ComesAt(double x_m) { return ChangeIn(BoxAt(x_m), 7, false); }

  Map map_{testing::SceneInfo()};
  SurfaceCache cache_{kPlenty};
  std::shared_ptr<const MapSnapshot> state_;
  std::shared_ptr<const MapSurfaces> surfaces_;
  const std::shared_ptr<SurfaceLedger> ledger_ = std::make_shared<SurfaceLedger>();
  FieldStore store_{ledger_};
};

TEST_F(FieldStoreTest, KeepsAFieldUntilSomethingNearChanges) {
  store_.Put({0, 0, 0}, 0, MakeField());
  EXPECT_EQ(store_.Append(0, ComesAt(5)), 1u);
  EXPECT_EQ(store_.Append(1, {}), 2u);
  EXPECT_NE(store_.Find({0, 0, 0}, 2), nullptr);
  EXPECT_EQ(store_.Find({1, 0, 0}, 2), nullptr) << "another cell";
  EXPECT_EQ(store_.Append(2, ComesAt(0.4)), 3u);
  EXPECT_NE(store_.Find({0, 0, 0}, 1), nullptr) << "states before that";
  EXPECT_EQ(store_.Find({0, 0, 0}, 3), nullptr);
  EXPECT_EQ(store_.num_fields(), 0u);
}

TEST_F(FieldStoreTest, KeepsAFieldWhereWhatGoesIsNoneOfIts) {
  store_.Put({0, 0, 0}, 0, MakeField());
  ASSERT_EQ(MakeField()->submaps(), std::vector{SubmapId(1)});
  EXPECT_EQ(store_.Append(0, ChangeIn(BoxAt(0.4), 7, true)), 1u);
  EXPECT_NE(store_.Find({0, 0, 0}, 1), nullptr) << "another goes";
  EXPECT_EQ(store_.Append(1, ChangeIn(BoxAt(5), 1, true)), 2u);
  EXPECT_NE(store_.Find({0, 0, 0}, 2), nullptr) << "its own, but where that is nearest to no point";
  EXPECT_EQ(store_.Append(2, ChangeIn(BoxAt(0.2), 1, true)), 3u);
  EXPECT_EQ(store_.Find({0, 0, 0}, 3), nullptr);
}

TEST_F(FieldStoreTest, KeepsAFieldWhereWhatComesIsHiddenByWhatItHolds) {
  // On the other side of the ball, though within the horizon.
  const auto cell = MakeField();
  store_.Put({0, 0, 0}, 0, cell);
  const Eigen::AlignedBox3d beyond(Eigen::Vector3d(-0.32, -0.32, -0.32), Eigen::Vector3d(-0.22, -0.22, -0.22));
  ASSERT_LT(beyond.exteriorDistance(cell->centre_m()), cell->horizon_m());
  EXPECT_EQ(store_.Append(0, ChangeIn(beyond, 7, false)), 1u);
  EXPECT_NE(store_.Find({0, 0, 0}, 1), nullptr);
  // The same box of one that is turned by half a turn: on this side of the ball.
  std::vector<SurfaceChange> turned = ChangeIn(beyond, 7, false);
  turned[0].T_submap_map.rotate(Eigen::AngleAxisd(M_PI, Eigen::Vector3d::UnitZ()));
  EXPECT_EQ(store_.Append(1, std::move(turned)), 2u);
  EXPECT_EQ(store_.Find({0, 0, 0}, 2), nullptr);
}

TEST(DistanceFields, AfterAMoveOnlyThoseThatHadTheThingOrMayHaveItAreMadeAgain) {
  Map map = testing::FurnishedRoom();
  SurfaceCache cache(kPlenty);
  const auto points = testing::RandomPoints(600, 1.6, 12);
  const auto still = map.Publish(0);
  const DistanceQuery before(cache.Of(still), Approximate());
  (void)AskOften(before, points);
  const SubmapId ball(3);  // of 0.2 m
  map.FindMutable(ball)->mutable_info().T_map_submap.translation().x() += 0.15;
  const auto state = map.Publish(1);
  const auto surfaces = cache.Of(state);
  const std::size_t num_before = surfaces->fields().store()->num_fields();
  const DistanceQuery after(surfaces, Approximate());
  SurfaceCache fresh(kPlenty);
  const DistanceQuery exact(fresh.Of(state), {});
  Errors errors;
  for (const Eigen::Vector3d& p : points) errors.Add(after.At(p), exact.At(p));
  const std::size_t num_after = surfaces->fields().store()->num_fields();
  errors.ExpectSmall("moved");
  EXPECT_LT(num_after, num_before) << "those that had it are dropped when asked for";
  EXPECT_GT(num_after, num_before * 3 / 10) << "walls beside it may have been one surface with it";
}

TEST_F(FieldStoreTest, GivesNoFieldToStatesBeforeTheOneItIsOf) {
  EXPECT_EQ(store_.Append(0, ComesAt(5)), 1u);
  store_.Put({0, 0, 0}, 1, MakeField());
  EXPECT_EQ(store_.Find({0, 0, 0}, 0), nullptr);
  EXPECT_NE(store_.Find({0, 0, 0}, 1), nullptr);
}

TEST_F(FieldStoreTest, IsContinuedOnlyFromTheLastState) {
  EXPECT_EQ(store_.Append(0, {}), 1u);
  EXPECT_EQ(store_.Append(0, {}), std::nullopt);
}

TEST_F(FieldStoreTest, ForgetsChangesThatNobodyAskedAbout) {
  store_.Put({0, 0, 0}, 0, MakeField());
  for (std::uint64_t n = 0; n < 256; ++n) EXPECT_EQ(store_.Append(n, {}), n + 1);
  EXPECT_NE(store_.Find({0, 0, 0}, 256), nullptr);
  for (std::uint64_t n = 256; n < 513; ++n) EXPECT_EQ(store_.Append(n, {}), n + 1);
  EXPECT_EQ(store_.Find({0, 0, 0}, 513), nullptr);
}

TEST_F(FieldStoreTest, DropsThoseNotAskedForLongest) {
  ledger_->most_field_bytes = 5 * MakeField()->MemoryBytes() / 2;
  store_.Put({0, 0, 0}, 0, MakeField());
  ++ledger_->time;
  store_.Put({0, 0, 1}, 0, MakeField());
  ++ledger_->time;
  store_.Put({0, 0, 2}, 0, MakeField());
  EXPECT_NE(store_.Find({0, 0, 2}, 0), nullptr);
  EXPECT_EQ(store_.Find({0, 0, 0}, 0), nullptr);
  EXPECT_LE(ledger_->cell_bytes, ledger_->most_field_bytes);
}

/// Two triangles a square of a metre, of `size` times `size` of them in the plane z = 0, seen from above.
std::vector<TriangleCorners> Sheet(int size) {
  std::vector<TriangleCorners> triangles;
  for (int x = 0; x < size; ++x) {
    for (int y = 0; y < size; ++y) {
      const Eigen::Vector3f a(static_cast<float>(x), static_cast<float>(y), 0), u = Eigen::Vector3f::UnitX(),
                                                                                v = Eigen::Vector3f::UnitY();
      triangles.push_back({a, a + u, a + v});
      triangles.push_back({a + u, a + u + v, a + v});
    }
  }
  return triangles;
}

bool IsInside(const Eigen::Vector3f& p, int size) {
  return p.x() > 0 && p.y() > 0 && p.x() < static_cast<float>(size) && p.y() < static_cast<float>(size);
}

TEST(FieldNormals, ASheetEndsAtItsBorderAndNowhereElse) {
  constexpr int kSize = 4;
  const auto sheet = Sheet(kSize);
  FieldNormals normals(sheet.size());
  std::vector<FieldNormals::Places> places;
  places.reserve(sheet.size());
  for (const TriangleCorners& triangle : sheet) places.push_back(normals.Want(triangle));
  for (const TriangleCorners& triangle : sheet) normals.Add(triangle, 7);
  for (std::size_t i = 0; i < sheet.size(); ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      const Eigen::Vector3f &a = sheet[i][k], &b = sheet[i][(k + 1) % 3];
      EXPECT_EQ(normals.GoesOn(places[i].corners[k]), IsInside(a, kSize)) << a.transpose();
      EXPECT_EQ(normals.GoesOn(places[i].edges[k]), IsInside((a + b) / 2, kSize))
          << a.transpose() << ", " << b.transpose();
      EXPECT_TRUE(normals.sums()[places[i].edges[k]].normalized().isApprox(Eigen::Vector3f::UnitZ()));
    }
  }
}

TEST(FieldNormals, ASurfaceDoesNotGoOnInAnotherThatMeetsIt) {
  const auto sheet = Sheet(2);
  FieldNormals normals(sheet.size());
  const FieldNormals::Places places = normals.Want(sheet[0]);
  for (std::size_t i = 0; i < sheet.size(); ++i) normals.Add(sheet[i], i == 1 ? 1 : 0);
  EXPECT_FALSE(normals.GoesOn(places.edges[1])) << "the other triangle of the square is of another surface";
  EXPECT_FALSE(normals.GoesOn(places.corners[1]));
}

TEST(FieldNormals, AClosedSurfaceGoesOnEverywhere) {
  const Eigen::Vector3f o(0, 0, 0), x(1, 0, 0), y(0, 1, 0), z(0, 0, 1);
  const std::vector<TriangleCorners> tetrahedron = {{o, y, x}, {o, x, z}, {o, z, y}, {x, y, z}};
  FieldNormals normals(tetrahedron.size());
  std::vector<FieldNormals::Places> places;
  places.reserve(tetrahedron.size());
  for (const TriangleCorners& triangle : tetrahedron) places.push_back(normals.Want(triangle));
  for (const TriangleCorners& triangle : tetrahedron) normals.Add(triangle, 0);
  for (const FieldNormals::Places& of : places) {
    for (std::size_t k = 0; k < 3; ++k) {
      EXPECT_TRUE(normals.GoesOn(of.corners[k]));
      EXPECT_TRUE(normals.GoesOn(of.edges[k]));
    }
  }
}

}  // namespace
}  // namespace dhpmap

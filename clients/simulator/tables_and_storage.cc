// SPDX-License-Identifier: BSD-3-Clause
#include "clients/simulator/finishes.h"
#include "clients/simulator/furniture.h"

namespace dhpmap::simulator {
namespace {

/// A top on four legs.
void Table(SceneBuilder& scene, const Eigen::Vector3d& size_m, double leg_m, const Material& top,
           const Material& legs) {
  constexpr double kTop_m = 0.04;
  scene.Box({0, 0, size_m.z() - kTop_m / 2}, {size_m.x(), size_m.y(), kTop_m}, top, 0.008);
  const double height_m = size_m.z() - kTop_m;
  for (double side : {-1.0, 1.0}) {
    for (double end : {-1.0, 1.0}) {
      scene.Box({side * (size_m.x() / 2 - leg_m), end * (size_m.y() / 2 - leg_m), height_m / 2},
                {leg_m, leg_m, height_m}, legs);
    }
  }
}

/// A body on a plinth, with a grid of drawers or doors with knobs on its front.
void Chest(SceneBuilder& scene, const Eigen::Vector3d& size_m, int columns, int rows, const Material& body,
           const Material& front) {
  constexpr double kPlinth_m = 0.06, kGap_m = 0.012;
  const double height_m = size_m.z() - kPlinth_m;
  scene.Box({0, -0.01, kPlinth_m / 2}, {size_m.x() - 0.06, size_m.y() - 0.06, kPlinth_m}, kGraphite);
  scene.Box({0, -0.01, kPlinth_m + height_m / 2}, {size_m.x(), size_m.y() - 0.02, height_m}, body);
  const double w = size_m.x() / columns, h = height_m / rows;
  for (int i = 0; i < columns; ++i) {
    for (int j = 0; j < rows; ++j) {
      const double x = -size_m.x() / 2 + (i + 0.5) * w, z = kPlinth_m + (j + 0.5) * h;
      scene.Box({x, size_m.y() / 2 - 0.01, z}, {w - kGap_m, 0.02, h - kGap_m}, front, 0.004);
      scene.Sphere({x, size_m.y() / 2 + 0.01, z}, 0.014, kBrass);
    }
  }
}

}  // namespace

void AddCoffeeTable(SceneBuilder& scene, const Place& place) {
  scene.BeginThing(ObjectClass::kCoffeeTable, place);
  Table(scene, {1.1, 0.6, 0.42}, 0.05, kWalnut, kWalnut);
  scene.Box({0, 0, 0.16}, {0.98, 0.5, 0.025}, kWalnut);
}

void AddSideTable(SceneBuilder& scene, const Place& place) {
  scene.BeginThing(ObjectClass::kCoffeeTable, place);
  scene.Cylinder({0, 0, 0.505}, 0.23, 0.03, kOak);
  scene.Cylinder({0, 0, 0.25}, 0.03, 0.48, kBlack);
  scene.Cylinder({0, 0, 0.0125}, 0.17, 0.025, kBlack);
}

void AddDiningTable(SceneBuilder& scene, const Place& place) {
  scene.BeginThing(ObjectClass::kDiningTable, place);
  Table(scene, {1.7, 0.9, 0.75}, 0.08, kOak, kWhite);
  for (double end : {-1.0, 1.0}) scene.Box({0, end * 0.37, 0.67}, {1.5, 0.025, 0.08}, kWhite);
}

void AddDesk(SceneBuilder& scene, const Place& place) {
  scene.BeginThing(ObjectClass::kDesk, place);
  scene.Box({0, 0, 0.73}, {1.5, 0.7, 0.035}, kPine, 0.006);
  for (double side : {-1.0, 1.0}) {
    scene.Box({side * 0.7, 0, 0.36}, {0.04, 0.62, 0.71}, kWhite);
    scene.Box({side * 0.7, 0, 0.02}, {0.06, 0.7, 0.04}, kWhite);
  }
  scene.Box({0, -0.3, 0.5}, {1.36, 0.02, 0.4}, kWhite);
  for (double z : {0.62, 0.5}) scene.Box({0.48, 0.05, z}, {0.4, 0.5, 0.11}, kWhite, 0.006);
}

void AddTvCabinet(SceneBuilder& scene, const Place& place) {
  scene.BeginThing(ObjectClass::kTvCabinet, place);
  Chest(scene, {1.8, 0.42, 0.48}, 3, 1, kWalnut, kWhite);
}

void AddBookshelf(SceneBuilder& scene, const Place& place, double width_m, double height_m, int num_shelves) {
  constexpr double kDepth_m = 0.3, kBoard_m = 0.03;
  scene.BeginThing(ObjectClass::kBookshelf, place);
  for (double side : {-1.0, 1.0}) {
    scene.Box({side * (width_m - kBoard_m) / 2, 0, height_m / 2}, {kBoard_m, kDepth_m, height_m}, kOak);
  }
  scene.Box({0, -kDepth_m / 2 + 0.01, height_m / 2}, {width_m - 2 * kBoard_m, 0.02, height_m - 0.02}, kOak);
  for (int i = 0; i <= num_shelves; ++i) {
    const double z = kBoard_m / 2 + i * (height_m - kBoard_m) / num_shelves;
    scene.Box({0, 0.01, z}, {width_m - 2 * kBoard_m, kDepth_m - 0.02, kBoard_m}, kOak);
  }
}

void AddDresser(SceneBuilder& scene, const Place& place, double width_m, const Material& wood) {
  scene.BeginThing(ObjectClass::kDresser, place);
  Chest(scene, {width_m, 0.45, 0.82}, 2, 3, wood, wood);
  scene.Box({0, 0, 0.835}, {width_m + 0.04, 0.47, 0.03}, wood, 0.006);
}

void AddNightstand(SceneBuilder& scene, const Place& place) {
  scene.BeginThing(ObjectClass::kNightstand, place);
  Chest(scene, {0.45, 0.4, 0.5}, 1, 2, kOak, kWhite);
}

void AddWardrobe(SceneBuilder& scene, const Place& place) {
  scene.BeginThing(ObjectClass::kWardrobe, place);
  constexpr double kWidth_m = 1.5, kDepth_m = 0.58, kHeight_m = 2.1;
  scene.Box({0, -0.01, kHeight_m / 2}, {kWidth_m, kDepth_m - 0.02, kHeight_m}, kWhite);
  for (int i = 0; i < 3; ++i) {
    const double x = (i - 1) * kWidth_m / 3;
    scene.Box({x, kDepth_m / 2 - 0.01, kHeight_m / 2 + 0.02}, {kWidth_m / 3 - 0.012, 0.02, kHeight_m - 0.1}, kPine,
              0.004);
    scene.Capsule({x + 0.18, kDepth_m / 2 + 0.02, 0.95}, {x + 0.18, kDepth_m / 2 + 0.02, 1.2}, 0.011, kSteel);
  }
}

}  // namespace dhpmap::simulator

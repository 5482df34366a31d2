// SPDX-License-Identifier: BSD-3-Clause
#include <array>
#include <cmath>

#include "clients/simulator/finishes.h"
#include "clients/simulator/furniture.h"

namespace dhpmap::simulator {
namespace {

constexpr std::array<std::uint32_t, 8> kBookColors{0x9c3b34, 0x2f5d7c, 0xd8b45a, 0x4c7a57,
                                                   0xe6dfd0, 0x6b4a72, 0xc9773e, 0x30343b};

void Leaf(SceneBuilder& scene, const Eigen::Vector3d& from_m, double angle, double reach_m, double rise_m,
          const Material& leaf) {
  const Eigen::Vector3d out(std::cos(angle), std::sin(angle), 0);
  const Eigen::Vector3d bend = from_m + 0.5 * reach_m * out + Eigen::Vector3d(0, 0, rise_m);
  const Eigen::Vector3d tip = from_m + reach_m * out + Eigen::Vector3d(0, 0, 0.75 * rise_m);
  scene.Capsule(from_m, bend, 0.03, leaf);
  scene.Capsule(bend, tip, 0.045, leaf);
}

}  // namespace

void AddTv(SceneBuilder& scene, const Place& place, double width_m) {
  const double height_m = width_m * 9 / 16;
  scene.BeginThing(ObjectClass::kTv, place);
  scene.Box({0, 0, 0.1 + height_m / 2}, {width_m, 0.045, height_m}, kBlack, 0.008);
  scene.Box({0, 0.02, 0.1 + height_m / 2}, {width_m - 0.03, 0.012, height_m - 0.03}, kScreen);
  scene.Box({0, 0, 0.07}, {0.1, 0.03, 0.1}, kBlack);
  scene.Box({0, 0, 0.01}, {0.45, 0.2, 0.02}, kBlack);
}

void AddMonitor(SceneBuilder& scene, const Place& place) {
  scene.BeginThing(ObjectClass::kMonitor, place);
  scene.Box({0, 0, 0.3}, {0.6, 0.03, 0.36}, kBlack, 0.006);
  scene.Box({0, 0.012, 0.3}, {0.58, 0.01, 0.34}, kScreen);
  scene.Box({0, -0.02, 0.14}, {0.06, 0.02, 0.26}, kSteel);
  scene.Box({0, 0, 0.008}, {0.24, 0.18, 0.016}, kSteel);
}

void AddFloorLamp(SceneBuilder& scene, const Place& place) {
  scene.BeginThing(ObjectClass::kLamp, place);
  scene.Cylinder({0, 0, 0.0125}, 0.15, 0.025, kBlack);
  scene.Cylinder({0, 0, 0.72}, 0.016, 1.4, kBrass);
  scene.Cone({0, 0, 1.52}, 0.22, 0.14, 0.28, kLampShade);
}

void AddTableLamp(SceneBuilder& scene, const Place& place, const Material& base) {
  scene.BeginThing(ObjectClass::kLamp, place);
  scene.Cylinder({0, 0, 0.01}, 0.07, 0.02, base);
  scene.Sphere({0, 0, 0.09}, 0.075, base);
  scene.Cylinder({0, 0, 0.2}, 0.012, 0.12, kBrass);
  scene.Cone({0, 0, 0.34}, 0.14, 0.09, 0.2, kLampShade);
}

void AddCeilingLamp(SceneBuilder& scene, const Place& place) {
  scene.BeginThing(ObjectClass::kLamp, place);
  scene.Cylinder({0, 0, -0.02}, 0.08, 0.04, kSteel);
  scene.Cone({0, 0, -0.075}, 0.16, 0.24, 0.07, kLampGlass);
}

void AddPendantLamp(SceneBuilder& scene, const Place& place, double drop_m) {
  scene.BeginThing(ObjectClass::kLamp, place);
  scene.Cylinder({0, 0, -drop_m / 2}, 0.008, drop_m, kBlack);
  scene.Cone({0, 0, -drop_m - 0.09}, 0.24, 0.07, 0.18, kMustardCloth);
  scene.Sphere({0, 0, -drop_m - 0.17}, 0.06, kLampGlass);
}

void AddPlant(SceneBuilder& scene, const Place& place, double height_m) {
  scene.BeginThing(ObjectClass::kPlant, place);
  scene.Cone({0, 0, 0.16}, 0.13, 0.18, 0.32, kTerracotta);
  scene.Torus({0, 0, 0.32}, 0.175, 0.02, kTerracotta);
  scene.Cylinder({0, 0, 0.31}, 0.165, 0.03, kSoil);
  scene.Capsule({0, 0, 0.3}, {0.02, 0.01, height_m * 0.6}, 0.022, kWalnut);
  constexpr int kLeaves = 13;
  for (int i = 0; i < kLeaves; ++i) {
    const double share = static_cast<double>(i) / (kLeaves - 1);
    const double reach = 0.36 - 0.14 * share;
    Leaf(scene, {0.01, 0, 0.42 + share * (height_m * 0.62 - 0.42)}, 2.4 * i, reach, 0.16 + 0.16 * share,
         i % 2 == 0 ? kLeaf : kDarkLeaf);
  }
}

void AddSmallPlant(SceneBuilder& scene, const Place& place) {
  scene.BeginThing(ObjectClass::kPlant, place);
  scene.Cone({0, 0, 0.06}, 0.055, 0.075, 0.12, kWhite);
  for (int i = 0; i < 7; ++i) {
    const double angle = 2.4 * i, reach = 0.05 + 0.012 * i;
    scene.Capsule({0, 0, 0.11}, {reach * std::cos(angle), reach * std::sin(angle), 0.34 - 0.02 * i}, 0.022, kLeaf);
  }
  scene.Sphere({0, 0, 0.2}, 0.07, kDarkLeaf);
}

void AddPicture(SceneBuilder& scene, const Place& place, double width_m, double height_m, const Material& picture) {
  scene.BeginThing(ObjectClass::kPicture, place);
  scene.Box({0, 0.015, 0}, {width_m, 0.03, height_m}, kWalnut);
  scene.Box({0, 0.03, 0}, {width_m - 0.06, 0.008, height_m - 0.06}, kWhite);
  scene.Box({0, 0.034, 0}, {width_m - 0.14, 0.008, height_m - 0.14}, picture);
}

void AddMirror(SceneBuilder& scene, const Place& place, double width_m, double height_m) {
  scene.BeginThing(ObjectClass::kMirror, place);
  scene.Box({0, 0.015, 0}, {width_m, 0.03, height_m}, kOak, 0.01);
  scene.Box({0, 0.03, 0}, {width_m - 0.06, 0.008, height_m - 0.06}, kMirrorGlass);
}

void AddBooks(SceneBuilder& scene, const Place& place, int count, std::uint32_t first_color) {
  scene.BeginThing(ObjectClass::kBooks, place);
  double x = 0;
  for (int i = 0; i < count; ++i) {
    const auto pick = static_cast<std::uint32_t>(i) * 5 + first_color;
    const double thick = 0.028 + 0.006 * (pick % 4), high = 0.2 + 0.012 * (pick % 6), deep = 0.16 + 0.01 * (pick % 3);
    scene.Box({x + thick / 2, 0, high / 2}, {thick - 0.002, deep, high}, Paint(kBookColors[pick % kBookColors.size()]),
              0.003);
    x += thick;
  }
}

void AddBox(SceneBuilder& scene, const Place& place, const Eigen::Vector3d& size_m, const Material& material) {
  scene.BeginThing(ObjectClass::kBox, place);
  scene.Box({0, 0, size_m.z() / 2}, size_m, material, 0.006);
  scene.Box({0, 0, size_m.z() - 0.03}, {size_m.x() + 0.016, size_m.y() + 0.016, 0.06}, material, 0.006);
}

void AddBall(SceneBuilder& scene, const Place& place, double radius_m, const Material& material) {
  scene.BeginThing(ObjectClass::kBall, place);
  scene.Turn({30, 35, 0});
  scene.Sphere({0, 0, radius_m}, radius_m, material);
  scene.Turn({0, 0, 0});
}

void AddVase(SceneBuilder& scene, const Place& place, const Material& material) {
  scene.BeginThing(ObjectClass::kVase, place);
  scene.Cone({0, 0, 0.1}, 0.05, 0.09, 0.2, material);
  scene.Sphere({0, 0, 0.2}, 0.09, material);
  scene.Cylinder({0, 0, 0.31}, 0.04, 0.1, material);
  scene.Torus({0, 0, 0.36}, 0.042, 0.012, material);
}

void AddBottle(SceneBuilder& scene, const Place& place, const Material& glass) {
  scene.BeginThing(ObjectClass::kBottle, place);
  scene.Cylinder({0, 0, 0.1}, 0.042, 0.2, glass);
  scene.Cone({0, 0, 0.235}, 0.042, 0.017, 0.07, glass);
  scene.Cylinder({0, 0, 0.29}, 0.017, 0.06, glass);
  scene.Cylinder({0, 0, 0.325}, 0.019, 0.02, kGraphite);
  scene.Cylinder({0, 0, 0.1}, 0.0425, 0.08, kLinen);
}

void AddCup(SceneBuilder& scene, const Place& place, const Material& material) {
  scene.BeginThing(ObjectClass::kCup, place);
  scene.Cone({0, 0, 0.05}, 0.034, 0.044, 0.1, material);
  scene.Torus({0, 0, 0.1}, 0.042, 0.005, material);
  scene.Turn({0, 0, 90});
  scene.Torus({0.05, 0, 0.052}, 0.025, 0.007, material);
  scene.Turn({0, 0, 0});
}

void AddFruitBowl(SceneBuilder& scene, const Place& place) {
  scene.BeginThing(ObjectClass::kBowl, place);
  scene.Cylinder({0, 0, 0.01}, 0.07, 0.02, kBlueCloth);
  scene.Cone({0, 0, 0.05}, 0.08, 0.15, 0.08, Paint(0x4f8fa8));
  scene.Torus({0, 0, 0.09}, 0.15, 0.01, Paint(0x4f8fa8));
  scene.Sphere({0.06, 0.02, 0.115}, 0.042, Paint(0xd8492f));
  scene.Sphere({-0.04, 0.06, 0.115}, 0.042, Paint(0xe8a92e));
  scene.Sphere({-0.03, -0.06, 0.113}, 0.04, Paint(0x9fbf3b));
  scene.Sphere({0.0, 0.0, 0.15}, 0.042, Paint(0xd8492f));
}

void AddBin(SceneBuilder& scene, const Place& place, const Material& material) {
  scene.BeginThing(ObjectClass::kBin, place);
  scene.Cone({0, 0, 0.2}, 0.13, 0.16, 0.4, material);
  scene.Cylinder({0, 0, 0.41}, 0.165, 0.02, kGraphite);
}

void AddTowel(SceneBuilder& scene, const Place& place, const Material& cloth) {
  scene.BeginThing(ObjectClass::kTowel, place);
  scene.Capsule({-0.32, 0.06, 0}, {0.32, 0.06, 0}, 0.012, kSteel);
  scene.Box({0, 0.065, -0.3}, {0.5, 0.05, 0.64}, cloth, 0.02);
}

}  // namespace dhpmap::simulator

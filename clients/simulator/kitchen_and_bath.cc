// SPDX-License-Identifier: BSD-3-Clause
#include "clients/simulator/finishes.h"
#include "clients/simulator/furniture.h"

namespace dhpmap::simulator {
namespace {

constexpr double kCounterDepth_m = 0.6, kCounterHeight_m = 0.9;
constexpr Material kCabinetPaint{Pattern::kPlain, 0x6f8f86};

/// A row of doors on the +y face, with bar handles.
void Doors(SceneBuilder& scene, double width_m, double front_m, double low_m, double high_m, int count,
           const Material& material) {
  const double each_m = width_m / count;
  for (int i = 0; i < count; ++i) {
    const double x = -width_m / 2 + (i + 0.5) * each_m;
    scene.Box({x, front_m, (low_m + high_m) / 2}, {each_m - 0.01, 0.02, high_m - low_m - 0.01}, material, 0.004);
    scene.Capsule({x - 0.07, front_m + 0.02, high_m - 0.06}, {x + 0.07, front_m + 0.02, high_m - 0.06}, 0.008, kSteel);
  }
}

void ApplianceBody(SceneBuilder& scene, double width_m, double depth_m, double height_m, const Material& material) {
  scene.Box({0, 0, 0.02}, {width_m - 0.04, depth_m - 0.06, 0.04}, kGraphite);
  scene.Box({0, 0, 0.04 + (height_m - 0.04) / 2}, {width_m, depth_m, height_m - 0.04}, material, 0.012);
}

}  // namespace

void AddKitchenCounter(SceneBuilder& scene, const Place& place, double width_m, bool has_sink) {
  scene.BeginThing(ObjectClass::kKitchenCounter, place);
  scene.Box({0, -0.03, 0.05}, {width_m, kCounterDepth_m - 0.1, 0.1}, kGraphite);
  scene.Box({0, -0.02, 0.48}, {width_m, kCounterDepth_m - 0.04, 0.76}, kWhite);
  Doors(scene, width_m, kCounterDepth_m / 2 - 0.04, 0.1, 0.86, static_cast<int>(width_m / 0.45), kCabinetPaint);
  if (!has_sink) {
    scene.Box({0, 0, kCounterHeight_m - 0.02}, {width_m, kCounterDepth_m, 0.04}, kStone, 0.004);
    return;
  }
  // The worktop has a hole for the sink.
  constexpr double kSinkWidth_m = 0.5, kSinkDepth_m = 0.38;
  const double side_m = (width_m - kSinkWidth_m) / 2, rim_m = (kCounterDepth_m - kSinkDepth_m) / 2;
  for (double side : {-1.0, 1.0}) {
    scene.Box({side * (kSinkWidth_m + side_m) / 2, 0, 0.88}, {side_m, kCounterDepth_m, 0.04}, kStone);
    scene.Box({0, side * (kSinkDepth_m + rim_m) / 2, 0.88}, {kSinkWidth_m, rim_m, 0.04}, kStone);
  }
  scene.Box({0, 0, 0.862}, {kSinkWidth_m, kSinkDepth_m, 0.004}, kSteel);
  scene.Capsule({0, -0.22, 0.9}, {0, -0.22, 1.15}, 0.014, kSteel);
  scene.Capsule({0, -0.22, 1.15}, {0, -0.06, 1.12}, 0.012, kSteel);
}

void AddWallCabinet(SceneBuilder& scene, const Place& place, double width_m) {
  scene.BeginThing(ObjectClass::kWallCabinet, place);
  scene.Box({0, -0.01, 0.35}, {width_m, 0.33, 0.7}, kWhite);
  const int count = static_cast<int>(width_m / 0.4);
  for (int i = 0; i < count; ++i) {
    const double each_m = width_m / count, x = -width_m / 2 + (i + 0.5) * each_m;
    scene.Box({x, 0.165, 0.35}, {each_m - 0.01, 0.02, 0.69}, kCabinetPaint, 0.004);
    scene.Sphere({x + each_m / 2 - 0.05, 0.185, 0.08}, 0.013, kSteel);
  }
}

void AddStove(SceneBuilder& scene, const Place& place) {
  scene.BeginThing(ObjectClass::kStove, place);
  ApplianceBody(scene, 0.6, 0.6, 0.9, kEnamel);
  scene.Box({0, 0.3, 0.42}, {0.5, 0.016, 0.4}, kBlack, 0.004);
  scene.Capsule({-0.22, 0.325, 0.67}, {0.22, 0.325, 0.67}, 0.011, kSteel);
  scene.Box({0, 0, 0.903}, {0.56, 0.52, 0.012}, kBlack);
  scene.Turn({0, 0, 90});
  for (double x : {-0.2, -0.07, 0.07, 0.2}) scene.Cylinder({x, 0.305, 0.79}, 0.022, 0.03, kGraphite);
  scene.Turn({0, 0, 0});
  for (double x : {-0.14, 0.14}) {
    for (double y : {-0.12, 0.13}) scene.Torus({x, y, 0.91}, 0.075, 0.008, kGraphite);
  }
  // A pot on the left rear ring.
  scene.Cylinder({-0.14, -0.12, 0.98}, 0.1, 0.13, Paint(0xc0392b));
  scene.Cylinder({-0.14, -0.12, 1.05}, 0.104, 0.014, kSteel);
  scene.Sphere({-0.14, -0.12, 1.07}, 0.018, kBlack);
}

void AddRangeHood(SceneBuilder& scene, const Place& place) {
  scene.BeginThing(ObjectClass::kRangeHood, place);
  scene.Box({0, 0, 0.04}, {0.6, 0.45, 0.08}, kSteel, 0.01);
  scene.Box({0, -0.02, 0.16}, {0.4, 0.36, 0.18}, kSteel, 0.01);
  scene.Box({0, -0.07, 0.57}, {0.26, 0.24, 0.66}, kSteel);
}

void AddFridge(SceneBuilder& scene, const Place& place) {
  scene.BeginThing(ObjectClass::kFridge, place);
  ApplianceBody(scene, 0.66, 0.62, 1.82, kEnamel);
  scene.Box({0, 0.315, 0.42}, {0.64, 0.03, 0.7}, kEnamel, 0.012);
  scene.Box({0, 0.315, 1.3}, {0.64, 0.03, 1.0}, kEnamel, 0.012);
  scene.Capsule({0.26, 0.355, 0.5}, {0.26, 0.355, 0.72}, 0.012, kSteel);
  scene.Capsule({0.26, 0.355, 0.9}, {0.26, 0.355, 1.3}, 0.012, kSteel);
  scene.Box({-0.1, 0.333, 1.45}, {0.15, 0.008, 0.2}, kLinen);
  scene.Box({0.05, 0.333, 1.6}, {0.07, 0.01, 0.07}, Paint(0xd8492f));
}

void AddMicrowave(SceneBuilder& scene, const Place& place) {
  scene.BeginThing(ObjectClass::kMicrowave, place);
  scene.Box({0, 0, 0.15}, {0.48, 0.36, 0.28}, kSteel, 0.01);
  scene.Box({-0.06, 0.18, 0.15}, {0.32, 0.012, 0.22}, kBlack);
  scene.Box({0.18, 0.18, 0.15}, {0.09, 0.012, 0.22}, kGraphite);
}

void AddKettle(SceneBuilder& scene, const Place& place) {
  scene.BeginThing(ObjectClass::kKettle, place);
  scene.Cone({0, 0, 0.11}, 0.085, 0.06, 0.2, kRedCloth);
  scene.Sphere({0, 0, 0.21}, 0.055, kSteel);
  scene.Sphere({0, 0, 0.275}, 0.016, kBlack);
  scene.Turn({0, 0, 90});
  scene.Torus({0.08, 0, 0.13}, 0.06, 0.011, kBlack);
  scene.Turn({0, 0, 0});
  scene.Capsule({-0.05, 0, 0.14}, {-0.12, 0, 0.2}, 0.016, kRedCloth);
}

void AddToilet(SceneBuilder& scene, const Place& place) {
  scene.BeginThing(ObjectClass::kToilet, place);
  scene.Box({0, -0.26, 0.62}, {0.38, 0.18, 0.36}, kEnamel, 0.03);
  scene.Box({0, -0.26, 0.81}, {0.4, 0.2, 0.03}, kEnamel, 0.01);
  scene.Box({0, -0.08, 0.2}, {0.24, 0.48, 0.4}, kEnamel, 0.06);
  scene.Cone({0, 0.1, 0.28}, 0.12, 0.2, 0.24, kEnamel);
  scene.Torus({0, 0.1, 0.41}, 0.17, 0.03, kEnamel);
  scene.Cylinder({0, 0.1, 0.44}, 0.195, 0.03, kWhite);
  scene.Box({0, -0.1, 0.42}, {0.36, 0.18, 0.05}, kEnamel, 0.02);
}

void AddBathtub(SceneBuilder& scene, const Place& place) {
  constexpr double kLength_m = 1.7, kWidth_m = 0.76, kHeight_m = 0.56, kRim_m = 0.08;
  scene.BeginThing(ObjectClass::kBathtub, place);
  for (double side : {-1.0, 1.0}) {
    scene.Box({0, side * (kWidth_m - kRim_m) / 2, kHeight_m / 2}, {kLength_m, kRim_m, kHeight_m}, kEnamel, 0.03);
    scene.Box({side * (kLength_m - kRim_m) / 2, 0, kHeight_m / 2}, {kRim_m, kWidth_m, kHeight_m}, kEnamel, 0.03);
  }
  scene.Box({0, 0, 0.08}, {kLength_m - 0.05, kWidth_m - 0.05, 0.16}, kEnamel);
  scene.Box({0, 0, 0.3}, {kLength_m - 0.1, kWidth_m - 0.1, 0.02}, Paint(0x9fd0d8));
  scene.Capsule({-0.78, -0.2, 0.56}, {-0.78, -0.2, 0.74}, 0.016, kSteel);
  scene.Capsule({-0.78, -0.2, 0.74}, {-0.62, -0.2, 0.72}, 0.014, kSteel);
}

void AddWashbasin(SceneBuilder& scene, const Place& place) {
  scene.BeginThing(ObjectClass::kWashbasin, place);
  scene.Box({0, 0, 0.42}, {0.6, 0.4, 0.6}, kPine);
  for (double x : {-0.15, 0.15}) {
    scene.Box({x, 0.2, 0.42}, {0.28, 0.02, 0.57}, kWhite, 0.004);
    scene.Sphere({x * 0.2, 0.218, 0.6}, 0.012, kSteel);
  }
  for (double side : {-1.0, 1.0}) {
    scene.Box({side * 0.29, 0.02, 0.8}, {0.06, 0.46, 0.16}, kEnamel, 0.02);
    scene.Box({0, 0.02 + side * 0.2, 0.8}, {0.64, 0.06, 0.16}, kEnamel, 0.02);
  }
  scene.Box({0, 0.02, 0.75}, {0.58, 0.4, 0.06}, kEnamel);
  scene.Capsule({0, -0.17, 0.86}, {0, -0.17, 1.0}, 0.014, kSteel);
  scene.Capsule({0, -0.17, 1.0}, {0, -0.04, 0.98}, 0.012, kSteel);
}

void AddWashingMachine(SceneBuilder& scene, const Place& place) {
  scene.BeginThing(ObjectClass::kWashingMachine, place);
  ApplianceBody(scene, 0.6, 0.58, 0.85, kEnamel);
  scene.Turn({0, 0, 90});
  scene.Torus({0, 0.295, 0.42}, 0.17, 0.025, kSteel);
  scene.Cylinder({0, 0.285, 0.42}, 0.16, 0.03, kBlueCloth);
  scene.Cylinder({0.18, 0.295, 0.75}, 0.035, 0.04, kGraphite);
  scene.Turn({0, 0, 0});
  scene.Box({-0.15, 0.288, 0.75}, {0.2, 0.012, 0.09}, kGraphite);
}

}  // namespace dhpmap::simulator

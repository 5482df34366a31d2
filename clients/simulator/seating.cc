// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>

#include "clients/simulator/finishes.h"
#include "clients/simulator/furniture.h"

namespace dhpmap::simulator {
namespace {

void UpholsteredSeat(SceneBuilder& scene, double width_m, double depth_m, int num_cushions, const Material& cloth) {
  constexpr double kArm_m = 0.18, kBack_m = 0.2, kSeatTop_m = 0.44, kSoft_m = 0.05;
  const double inner_m = width_m - 2 * kArm_m;
  scene.Box({0, 0, 0.2}, {width_m - 0.04, depth_m - 0.04, 0.2}, cloth, 0.02);
  scene.Box({0, -depth_m / 2 + kBack_m / 2, 0.5}, {width_m, kBack_m, 0.72}, cloth, kSoft_m);
  const double each_m = inner_m / num_cushions;
  for (int i = 0; i < num_cushions; ++i) {
    const double x = -inner_m / 2 + (i + 0.5) * each_m;
    scene.Box({x, kBack_m / 2, kSeatTop_m - 0.08}, {each_m - 0.005, depth_m - kBack_m, 0.18}, cloth, kSoft_m);
    scene.Turn({0, 0, 12});
    scene.Box({x, -depth_m / 2 + kBack_m + 0.08, 0.64}, {each_m - 0.01, 0.16, 0.42}, cloth, 0.06);
    scene.Turn({0, 0, 0});
  }
  for (double side : {-1.0, 1.0}) {
    scene.Box({side * (width_m - kArm_m) / 2, 0, 0.36}, {kArm_m, depth_m, 0.52}, cloth, kSoft_m);
    for (double end : {-1.0, 1.0}) {
      scene.Cylinder({side * (width_m / 2 - 0.1), end * (depth_m / 2 - 0.1), 0.05}, 0.025, 0.1, kWalnut);
    }
  }
}

}  // namespace

void AddSofa(SceneBuilder& scene, const Place& place, double width_m, const Material& cloth) {
  scene.BeginThing(ObjectClass::kSofa, place);
  UpholsteredSeat(scene, width_m, 0.92, 3, cloth);
}

void AddArmchair(SceneBuilder& scene, const Place& place, const Material& cloth) {
  scene.BeginThing(ObjectClass::kArmchair, place);
  UpholsteredSeat(scene, 0.86, 0.84, 1, cloth);
}

void AddChair(SceneBuilder& scene, const Place& place, const Material& wood, const Material& seat) {
  constexpr double kWidth_m = 0.45, kDepth_m = 0.44, kSeat_m = 0.45, kLeg_m = 0.04;
  scene.BeginThing(ObjectClass::kChair, place);
  scene.Box({0, 0, kSeat_m - 0.03}, {kWidth_m, kDepth_m, 0.05}, wood);
  scene.Box({0, 0.01, kSeat_m + 0.005}, {kWidth_m - 0.04, kDepth_m - 0.04, 0.05}, seat, 0.02);
  for (double side : {-1.0, 1.0}) {
    const double x = side * (kWidth_m - kLeg_m) / 2;
    scene.Box({x, (kDepth_m - kLeg_m) / 2, (kSeat_m - 0.05) / 2}, {kLeg_m, kLeg_m, kSeat_m - 0.05}, wood);
    scene.Box({x, -(kDepth_m - kLeg_m) / 2, 0.45}, {kLeg_m, kLeg_m, 0.9}, wood);
  }
  for (double z : {0.62, 0.74, 0.86}) {
    scene.Box({0, -(kDepth_m - kLeg_m) / 2, z}, {kWidth_m - 2 * kLeg_m, 0.025, 0.07}, wood);
  }
}

void AddDeskChair(SceneBuilder& scene, const Place& place, const Material& cloth) {
  scene.BeginThing(ObjectClass::kChair, place);
  scene.Box({0, 0, 0.47}, {0.5, 0.48, 0.1}, cloth, 0.045);
  scene.Turn({0, 0, 8});
  scene.Box({0, -0.23, 0.8}, {0.46, 0.08, 0.52}, cloth, 0.039);
  scene.Turn({0, 0, 0});
  scene.Capsule({0, -0.2, 0.44}, {0, -0.25, 0.7}, 0.025, kBlack);
  scene.Cylinder({0, 0, 0.26}, 0.03, 0.34, kSteel);
  for (int i = 0; i < 5; ++i) {
    const double angle = 0.3 + i * 1.2566370614;
    const double x = 0.29 * std::cos(angle), y = 0.29 * std::sin(angle);
    scene.Capsule({0, 0, 0.1}, {x, y, 0.07}, 0.022, kBlack);
    scene.Sphere({x, y, 0.03}, 0.03, kBlack);
  }
}

void AddPouf(SceneBuilder& scene, const Place& place, const Material& cloth) {
  scene.BeginThing(ObjectClass::kPouf, place);
  scene.Cylinder({0, 0, 0.19}, 0.24, 0.3, cloth);
  scene.Torus({0, 0, 0.04}, 0.22, 0.04, cloth);
  scene.Torus({0, 0, 0.34}, 0.2, 0.06, cloth);
}

void AddBed(SceneBuilder& scene, const Place& place) {
  constexpr double kWidth_m = 1.64, kLength_m = 2.08;
  scene.BeginThing(ObjectClass::kBed, place);
  scene.Box({0, 0, 0.2}, {kWidth_m, kLength_m, 0.2}, kOak, 0.01);
  scene.Box({0, -kLength_m / 2 + 0.04, 0.55}, {kWidth_m + 0.06, 0.08, 1.1}, kOak, 0.02);
  for (double side : {-1.0, 1.0}) {
    for (double end : {-1.0, 1.0}) scene.Box({side * 0.74, end * 0.96, 0.06}, {0.09, 0.09, 0.12}, kOak);
  }
  scene.Box({0, 0.04, 0.39}, {kWidth_m - 0.06, kLength_m - 0.1, 0.22}, kLinen, 0.06);
  scene.Box({0, 0.36, 0.47}, {kWidth_m + 0.02, kLength_m - 0.78, 0.16}, kDuvet, 0.07);
  for (double side : {-1.0, 1.0}) {
    scene.Turn({0, 0, 24});
    scene.Box({side * 0.38, -0.74, 0.58}, {0.66, 0.42, 0.15}, kLinen, 0.07);
  }
  scene.Turn({0, 0, 0});
}

void AddCushion(SceneBuilder& scene, const Place& place, const Material& cloth, double lean_deg) {
  scene.BeginThing(ObjectClass::kCushion, place);
  scene.Turn({0, 0, lean_deg});
  scene.Box({0, 0, 0.2}, {0.42, 0.14, 0.42}, cloth, 0.065);
  scene.Turn({0, 0, 0});
}

}  // namespace dhpmap::simulator

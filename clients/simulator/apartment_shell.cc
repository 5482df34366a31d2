// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <vector>

#include "clients/simulator/apartment.h"
#include "clients/simulator/finishes.h"
#include "clients/simulator/furniture.h"

namespace dhpmap::simulator {
namespace {

constexpr double kOuterWall_m = 0.2;
constexpr double kInnerWall_m = 0.1;
constexpr double kWidth_m = 11.0, kDepth_m = 8.0;
constexpr double kBetweenRows_m = 4.6;  ///< y of the wall between living room and kitchen, and the other rooms

struct Opening {
  double from_m, to_m;  ///< along the wall
  double sill_m, top_m;
  [[nodiscard]] bool is_door() const { return sill_m == 0; }
};

/// A straight wall along x or y; `line_m` is the other coordinate of its centre plane.
struct Wall {
  bool is_along_x;
  double line_m, from_m, to_m, thickness_m;
  Material material;
  std::vector<Opening> openings;
};

class WallBuilder {
 public:
  WallBuilder(SceneBuilder& scene, const Wall& wall) : scene_(scene), wall_(wall) {}

  void Build() {
    scene_.BeginStuff(ObjectClass::kWall);
    double at = wall_.from_m;
    for (const Opening& opening : wall_.openings) {
      Piece(at, opening.from_m, 0, kRoomHeight_m, wall_.thickness_m, wall_.material);
      Piece(opening.from_m, opening.to_m, opening.top_m, kRoomHeight_m, wall_.thickness_m, wall_.material);
      Piece(opening.from_m, opening.to_m, 0, opening.sill_m, wall_.thickness_m, wall_.material);
      at = opening.to_m;
    }
    Piece(at, wall_.to_m, 0, kRoomHeight_m, wall_.thickness_m, wall_.material);
    for (const Opening& opening : wall_.openings) opening.is_door() ? DoorFrame(opening) : Window(opening);
  }

 private:
  void Piece(double from_m, double to_m, double low_m, double high_m, double thickness_m, const Material& material,
             double shift_m = 0) {
    if (to_m <= from_m || high_m <= low_m) return;
    const double middle = (from_m + to_m) / 2, z = (low_m + high_m) / 2, line = wall_.line_m + shift_m;
    if (wall_.is_along_x) {
      scene_.Box({middle, line, z}, {to_m - from_m, thickness_m, high_m - low_m}, material);
    } else {
      scene_.Box({line, middle, z}, {thickness_m, to_m - from_m, high_m - low_m}, material);
    }
  }

  void DoorFrame(const Opening& o) {
    constexpr double kFrame_m = 0.06;
    const double deep = wall_.thickness_m + 0.04;
    scene_.BeginStuff(ObjectClass::kDoor);
    Piece(o.from_m, o.from_m + kFrame_m, 0, o.top_m, deep, kWhite);
    Piece(o.to_m - kFrame_m, o.to_m, 0, o.top_m, deep, kWhite);
    Piece(o.from_m, o.to_m, o.top_m - kFrame_m, o.top_m, deep, kWhite);
  }

  void Window(const Opening& o) {
    constexpr double kFrame_m = 0.05;
    const double middle = (o.from_m + o.to_m) / 2;
    scene_.BeginStuff(ObjectClass::kWindow);
    Piece(o.from_m, o.to_m, o.sill_m, o.top_m, 0.02, kWindowView);
    Piece(o.from_m, o.to_m, o.sill_m, o.sill_m + kFrame_m, 0.07, kWhite);
    Piece(o.from_m, o.to_m, o.top_m - kFrame_m, o.top_m, 0.07, kWhite);
    for (double at : {o.from_m, middle - kFrame_m / 2, o.to_m - kFrame_m}) {
      Piece(at, at + kFrame_m, o.sill_m, o.top_m, 0.07, kWhite);
    }
    const double inward = wall_.line_m < 1 ? 1 : -1;
    Piece(o.from_m - 0.04, o.to_m + 0.04, o.sill_m - 0.03, o.sill_m, 0.2, kWhite, inward * 0.08);
  }

  SceneBuilder& scene_;
  const Wall& wall_;
};

std::vector<Wall> Walls() {
  constexpr double kHalf_m = kOuterWall_m / 2;
  const double west = -kHalf_m, east = kWidth_m + kHalf_m, south = -kHalf_m, north = kDepth_m + kHalf_m;
  const Material& paint = kWallPaint;
  return {
      // Outer walls, one piece for each room, so that each has its own paint.
      {true, south, -kOuterWall_m, 6.2, kOuterWall_m, kAccentPaint, {{4.3, 5.7, 0.9, 2.1}}},
      {true, south, 6.2, kWidth_m + kOuterWall_m, kOuterWall_m, paint, {}},
      {true, north, -kOuterWall_m, 4.2, kOuterWall_m, kBedroomPaint, {{1.5, 3.1, 0.9, 2.1}}},
      {true, north, 4.2, 6.8, kOuterWall_m, kBathTiles, {{5.0, 6.0, 1.4, 2.1}}},
      {true, north, 6.8, kWidth_m + kOuterWall_m, kOuterWall_m, kStudyPaint, {{8.5, 10.1, 0.95, 2.1}}},
      {false, west, 0, kBetweenRows_m, kOuterWall_m, paint, {{1.0, 2.6, 0.9, 2.1}}},
      {false, west, kBetweenRows_m, kDepth_m, kOuterWall_m, kBedroomPaint, {}},
      {false, east, 0, kBetweenRows_m, kOuterWall_m, paint, {{2.0, 3.8, 0.9, 2.1}}},
      {false, east, kBetweenRows_m, kDepth_m, kOuterWall_m, kStudyPaint, {}},
      // Inner walls
      {true, kBetweenRows_m, 0, 4.2, kInnerWall_m, paint, {{2.9, 3.9, 0, 2.05}}},
      {true, kBetweenRows_m, 4.2, 6.8, kInnerWall_m, paint, {}},
      {true, kBetweenRows_m, 6.8, kWidth_m, kInnerWall_m, paint, {{7.4, 8.4, 0, 2.05}}},
      {false, 6.2, 0, kBetweenRows_m - 0.05, kInnerWall_m, paint, {{1.1, 3.2, 0, 2.2}}},
      {false, 4.2, kBetweenRows_m + 0.05, kDepth_m, kInnerWall_m, paint, {{5.25, 6.25, 0, 2.05}}},
      {false, 6.8, kBetweenRows_m + 0.05, kDepth_m, kInnerWall_m, paint, {{5.25, 6.25, 0, 2.05}}},
  };
}

void Slab(SceneBuilder& scene, double min_x, double max_x, double min_y, double max_y, double top_m, double thick_m,
          const Material& material) {
  scene.Box({(min_x + max_x) / 2, (min_y + max_y) / 2, top_m - thick_m / 2}, {max_x - min_x, max_y - min_y, thick_m},
            material);
}

}  // namespace

void AddWallsAndFloors(SceneBuilder& scene) {
  for (const Wall& wall : Walls()) WallBuilder(scene, wall).Build();
  constexpr double kSlab_m = 0.2;
  scene.BeginStuff(ObjectClass::kFloor);
  Slab(scene, -kOuterWall_m, 6.2, -kOuterWall_m, kBetweenRows_m, 0, kSlab_m, kFloorBoards);
  Slab(scene, 6.2, kWidth_m + kOuterWall_m, -kOuterWall_m, kBetweenRows_m, 0, kSlab_m, kFloorTiles);
  Slab(scene, -kOuterWall_m, 4.2, kBetweenRows_m, kDepth_m + kOuterWall_m, 0, kSlab_m, kFloorBoards);
  Slab(scene, 4.2, 6.8, kBetweenRows_m, kDepth_m + kOuterWall_m, 0, kSlab_m, kBathTiles);
  Slab(scene, 6.8, kWidth_m + kOuterWall_m, kBetweenRows_m, kDepth_m + kOuterWall_m, 0, kSlab_m, kFloorBoards);
}

void AddCeiling(SceneBuilder& scene) {
  scene.BeginStuff(ObjectClass::kCeiling);
  Slab(scene, -kOuterWall_m, kWidth_m + kOuterWall_m, -kOuterWall_m, kDepth_m + kOuterWall_m, kRoomHeight_m + 0.2, 0.2,
       kCeilingPaint);
  for (const Room& room : ApartmentScene::Rooms()) {
    AddCeilingLamp(scene, {room.lamp_m.x(), room.lamp_m.y(), kRoomHeight_m});
  }
  AddPendantLamp(scene, {9.4, 3.0, kRoomHeight_m}, 0.75);
}

}  // namespace dhpmap::simulator

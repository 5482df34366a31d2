// SPDX-License-Identifier: BSD-3-Clause
#include "clients/simulator/apartment.h"
#include "clients/simulator/finishes.h"
#include "clients/simulator/furniture.h"

namespace dhpmap::simulator {
namespace {

constexpr double kFacesWest_deg = 90, kFacesSouth_deg = 180, kFacesEast_deg = -90, kFacesNorth_deg = 0;

void AddRug(SceneBuilder& scene, const Place& place, double width_m, double depth_m, const Material& material) {
  scene.BeginStuff(ObjectClass::kRug, place);
  scene.Box({0, 0, 0.006}, {width_m, depth_m, 0.012}, material, 0.005);
}

void AddRoundRug(SceneBuilder& scene, const Place& place, double radius_m, const Material& material) {
  scene.BeginStuff(ObjectClass::kRug, place);
  scene.Cylinder({0, 0, 0.006}, radius_m, 0.012, material);
}

/// Two bundles of folds at a window of this width, and the rod above it.
void AddCurtains(SceneBuilder& scene, const Place& place, double window_m) {
  constexpr double kFold_m = 0.045, kHeight_m = 2.1;
  scene.BeginStuff(ObjectClass::kCurtain, place);
  const double reach = window_m / 2 + 0.35;
  scene.Capsule({-reach, 0.12, 2.25}, {reach, 0.12, 2.25}, 0.014, kBrass);
  for (double side : {-1.0, 1.0}) {
    for (int i = 0; i < 4; ++i) {
      scene.Cylinder({side * (window_m / 2 + 0.02 + i * 1.7 * kFold_m), 0.1 + 0.02 * (i % 2), 2.24 - kHeight_m / 2},
                     kFold_m, kHeight_m, kCurtainCloth);
    }
  }
}

/// Height of the top of a bookshelf's board; board 0 is the lowest.
double BoardTop(double height_m, int num_shelves, int board) { return 0.03 + board * (height_m - 0.03) / num_shelves; }

}  // namespace

void FurnishLivingRoom(SceneBuilder& scene) {
  AddRug(scene, {2.6, 1.75}, 2.9, 2.0, {Pattern::kStripes, 0xb8604a, 0xe7d7bd, 0.11});
  AddSofa(scene, {2.6, 3.0, 0, kFacesSouth_deg}, 2.2, kBlueCloth);
  AddCushion(scene, {1.95, 3.04, 0.42, kFacesSouth_deg}, kMustardCloth, 18);
  AddCushion(scene, {3.28, 3.04, 0.42, kFacesSouth_deg + 12}, kRedCloth, 18);
  AddCoffeeTable(scene, {2.6, 1.8});
  AddCup(scene, {2.4, 1.72, 0.42, 40}, kRedCloth);
  AddBooks(scene, {2.75, 1.85, 0.42, 25}, 3, 1);
  AddArmchair(scene, {0.75, 2.05, 0, kFacesEast_deg + 10}, kMustardCloth);
  AddPouf(scene, {4.3, 2.0}, kGreyCloth);
  AddTvCabinet(scene, {2.6, 0.23, 0, kFacesNorth_deg});
  AddTv(scene, {2.6, 0.22, 0.48, kFacesNorth_deg}, 1.25);
  AddVase(scene, {1.85, 0.22, 0.48}, Paint(0x3f8f8a));
  AddPlant(scene, {0.5, 0.5}, 1.5);
  AddFloorLamp(scene, {0.42, 3.05});
  AddSideTable(scene, {4.05, 3.05});
  AddTableLamp(scene, {4.05, 3.05, 0.52}, Paint(0x2f7f7a));
  AddBookshelf(scene, {5.2, 4.38, 0, kFacesSouth_deg}, 1.2, 1.9, 5);
  AddBooks(scene, {5.72, 4.36, BoardTop(1.9, 5, 1), kFacesSouth_deg}, 9, 0);
  AddBooks(scene, {5.70, 4.36, BoardTop(1.9, 5, 2), kFacesSouth_deg}, 7, 3);
  AddBooks(scene, {5.15, 4.36, BoardTop(1.9, 5, 3), kFacesSouth_deg}, 8, 6);
  AddBox(scene, {4.9, 4.37, BoardTop(1.9, 5, 0), kFacesSouth_deg}, {0.4, 0.24, 0.26}, kCardboard);
  AddBox(scene, {5.45, 4.37, BoardTop(1.9, 5, 0), kFacesSouth_deg}, {0.36, 0.24, 0.22}, Paint(0x7aa6b8));
  AddVase(scene, {5.5, 4.38, BoardTop(1.9, 5, 3)}, Paint(0xd98f5c));
  AddSmallPlant(scene, {5.0, 4.38, 1.9});
  AddPicture(scene, {1.35, 4.55, 1.5, kFacesSouth_deg}, 1.0, 0.7, {Pattern::kLandscape, 0x86b6d9, 0x3f6d4e});
  AddPicture(scene, {0.0, 3.5, 1.55, kFacesEast_deg}, 0.6, 0.8, {Pattern::kLandscape, 0xe9b08a, 0x6a4a72});
  AddPicture(scene, {6.15, 3.9, 1.55, kFacesWest_deg}, 0.6, 0.6, {Pattern::kRings, 0xd9533b, 0xf0e2c0, 0.05});
  AddDresser(scene, {0.85, 4.32, 0, kFacesSouth_deg}, 1.1, kOak);
  AddSmallPlant(scene, {0.55, 4.34, 0.85});
  AddBooks(scene, {1.3, 4.36, 0.85, kFacesSouth_deg}, 6, 5);
  AddBall(scene, {4.75, 0.7}, 0.14, {Pattern::kStripes, 0xd9472f, 0xf2efe6, 0.05});
  AddBox(scene, {5.65, 0.4, 0, 8}, {0.6, 0.45, 0.4}, kCardboard);
  AddBox(scene, {5.62, 0.42, 0.4, -12}, {0.42, 0.34, 0.28}, Paint(0x8c6fa8));
  AddCurtains(scene, {5.0, 0.0, 0, kFacesNorth_deg}, 1.4);
  AddCurtains(scene, {0.0, 1.8, 0, kFacesEast_deg}, 1.6);
}

void FurnishBedroom(SceneBuilder& scene) {
  AddRug(scene, {2.4, 6.5}, 1.6, 2.2, {Pattern::kChecker, 0xd8d2c4, 0x8aa0a8, 0.2});
  AddBed(scene, {1.06, 6.55, 0, kFacesEast_deg});
  AddNightstand(scene, {0.22, 5.42, 0, kFacesEast_deg});
  AddNightstand(scene, {0.22, 7.68, 0, kFacesEast_deg});
  AddTableLamp(scene, {0.2, 5.42, 0.5}, Paint(0xb35f4a));
  AddTableLamp(scene, {0.2, 7.68, 0.5}, Paint(0xb35f4a));
  AddWardrobe(scene, {3.85, 7.18, 0, kFacesWest_deg});
  AddDresser(scene, {1.3, 4.89, 0, kFacesNorth_deg}, 1.0, kWalnut);
  AddMirror(scene, {1.3, 4.65, 1.45, kFacesNorth_deg}, 0.8, 0.9);
  AddVase(scene, {1.0, 4.85, 0.85}, Paint(0xe0d3c0));
  AddBox(scene, {1.6, 4.88, 0.85, 20}, {0.26, 0.18, 0.14}, kRedCloth);
  AddPicture(scene, {0.0, 6.55, 1.75, kFacesEast_deg}, 1.1, 0.6, {Pattern::kLandscape, 0x9fb4d9, 0x35566e});
  AddBox(scene, {3.2, 7.75, 0}, {0.5, 0.4, 0.35}, kCardboard);
  AddBall(scene, {3.98, 6.33}, 0.1, {Pattern::kChecker, 0x3f7fb5, 0xf0ede2, 0.05});
  AddPlant(scene, {2.5, 7.6}, 1.25);
  AddCurtains(scene, {2.3, 8.0, 0, kFacesSouth_deg}, 1.6);
}

void FurnishBath(SceneBuilder& scene) {
  AddBathtub(scene, {5.3, 7.6, 0, kFacesSouth_deg});
  AddBottle(scene, {4.75, 7.95, 0.56}, Paint(0x5fa37f));
  AddToilet(scene, {6.38, 6.75, 0, kFacesWest_deg});
  AddBin(scene, {6.55, 7.3}, kSteel);
  AddWashbasin(scene, {4.47, 6.7, 0, kFacesEast_deg});
  AddMirror(scene, {4.25, 6.7, 1.5, kFacesEast_deg}, 0.6, 0.8);
  AddWashingMachine(scene, {5.0, 4.95, 0, kFacesNorth_deg});
  AddBox(scene, {5.0, 4.93, 0.85}, {0.4, 0.3, 0.22}, kLinen);
  AddBox(scene, {5.75, 4.9, 0}, {0.45, 0.36, 0.55}, kPine);
  AddTowel(scene, {6.1, 4.65, 1.6, kFacesNorth_deg}, kBlueCloth);
  AddRug(scene, {5.3, 6.75}, 0.9, 0.55, kMustardCloth);
}

void FurnishStudy(SceneBuilder& scene) {
  AddRoundRug(scene, {8.7, 6.1}, 0.95, {Pattern::kRings, 0x5f8f9f, 0xe9e2d0, 0.09});
  AddDesk(scene, {9.3, 7.62, 0, kFacesSouth_deg});
  AddMonitor(scene, {9.3, 7.72, 0.75, kFacesSouth_deg});
  AddTableLamp(scene, {8.72, 7.72, 0.75}, kGraphite);
  AddCup(scene, {9.75, 7.55, 0.75, 120}, Paint(0x3f8f8a));
  AddBooks(scene, {9.98, 7.74, 0.75, kFacesSouth_deg}, 5, 2);
  AddDeskChair(scene, {9.3, 6.95, 0, 14}, kRedCloth);
  AddBookshelf(scene, {7.02, 7.25, 0, kFacesEast_deg}, 1.1, 1.6, 4);
  AddBooks(scene, {7.02, 7.72, BoardTop(1.6, 4, 1), kFacesEast_deg}, 8, 4);
  AddBooks(scene, {7.02, 7.30, BoardTop(1.6, 4, 2), kFacesEast_deg}, 9, 7);
  AddBox(scene, {7.03, 7.5, BoardTop(1.6, 4, 0), kFacesEast_deg}, {0.4, 0.24, 0.28}, Paint(0xc9773e));
  AddBox(scene, {7.03, 7.0, BoardTop(1.6, 4, 0), kFacesEast_deg}, {0.4, 0.24, 0.28}, Paint(0x4c7a57));
  AddBall(scene, {7.03, 7.6, BoardTop(1.6, 4, 2)}, 0.1, {Pattern::kRings, 0x2f6fae, 0xf2efe6, 0.04});
  AddSofa(scene, {10.5, 5.9, 0, kFacesWest_deg}, 1.7, kGreyCloth);
  AddCushion(scene, {10.55, 6.4, 0.42, kFacesWest_deg}, kBlueCloth, 18);
  AddPlant(scene, {10.6, 7.6}, 1.4);
  AddPicture(scene, {11.0, 5.9, 1.6, kFacesWest_deg}, 1.1, 0.7, {Pattern::kLandscape, 0xf0c38a, 0x2f6a6a});
  AddBox(scene, {9.2, 4.95, 0, 6}, {0.55, 0.4, 0.36}, Paint(0xd0574a));
  AddBox(scene, {9.85, 4.93, 0, -5}, {0.5, 0.4, 0.3}, Paint(0x3f78a8));
  AddBox(scene, {9.22, 4.93, 0.36, -14}, {0.34, 0.3, 0.24}, Paint(0xe0b04a));
  AddBall(scene, {8.72, 5.03}, 0.12, {Pattern::kChecker, 0xf2c230, 0x2c3640, 0.06});
  AddFloorLamp(scene, {10.65, 4.9});
  AddBin(scene, {8.3, 7.75}, Paint(0x8a5a3c));
  AddCurtains(scene, {9.3, 8.0, 0, kFacesSouth_deg}, 1.6);
}

void FurnishKitchen(SceneBuilder& scene) {
  AddFridge(scene, {6.62, 0.34, 0, kFacesNorth_deg});
  AddKitchenCounter(scene, {7.85, 0.31, 0, kFacesNorth_deg}, 1.8, true);
  AddStove(scene, {9.06, 0.31, 0, kFacesNorth_deg});
  AddKitchenCounter(scene, {10.17, 0.31, 0, kFacesNorth_deg}, 1.6, false);
  AddWallCabinet(scene, {7.85, 0.18, 1.45, kFacesNorth_deg}, 1.7);
  AddRangeHood(scene, {9.06, 0.24, 1.6, kFacesNorth_deg});
  AddWallCabinet(scene, {10.2, 0.18, 1.45, kFacesNorth_deg}, 1.5);
  AddKettle(scene, {9.7, 0.3, 0.9, 30});
  AddBottle(scene, {9.98, 0.16, 0.9}, Paint(0x3d6b3a));
  AddBottle(scene, {10.1, 0.2, 0.9}, Paint(0x8a5a2c));
  AddMicrowave(scene, {10.6, 0.26, 0.9, kFacesNorth_deg});
  AddCup(scene, {7.2, 0.3, 0.9, 70}, kWhite);
  AddCup(scene, {7.33, 0.38, 0.9, 200}, Paint(0xd9a13b));
  AddVase(scene, {8.6, 0.2, 0.9}, kTerracotta);

  AddDiningTable(scene, {9.4, 3.0});
  // Two touching pairs, side by side: one class, hard to separate.
  for (double x : {9.175, 9.625}) {
    AddChair(scene, {x, 2.42, 0, kFacesNorth_deg}, kOak, kRedCloth);
    AddChair(scene, {x, 3.58, 0, kFacesSouth_deg}, kOak, kRedCloth);
  }
  AddChair(scene, {10.42, 3.05, 0, kFacesWest_deg - 8}, kOak, kBlueCloth);
  AddFruitBowl(scene, {9.4, 3.0, 0.75});
  AddCup(scene, {9.0, 2.8, 0.75, 10}, Paint(0x3f78a8));
  AddCup(scene, {9.75, 3.2, 0.75, 160}, kRedCloth);
  AddBottle(scene, {9.0, 3.2, 0.75}, Paint(0x2f5f4a));
  AddDresser(scene, {9.9, 4.3, 0, kFacesSouth_deg}, 1.2, kPine);
  AddSmallPlant(scene, {9.55, 4.32, 0.85});
  AddTableLamp(scene, {10.3, 4.32, 0.85}, Paint(0x4f6f9f));
  AddPicture(scene, {9.9, 4.55, 1.55, kFacesSouth_deg}, 0.9, 0.65, {Pattern::kLandscape, 0xf2d9a0, 0x8a3f3a});
  AddBin(scene, {6.55, 3.6}, Paint(0x5f7f6a));
  AddBox(scene, {6.62, 4.2, 0, 4}, {0.55, 0.5, 0.42}, kCardboard);
  AddRug(scene, {8.3, 1.15}, 1.5, 0.6, {Pattern::kStripes, 0x5f7f8f, 0xe7e2d4, 0.05});
  AddCurtains(scene, {11.0, 2.9, 0, kFacesWest_deg}, 1.8);
}

}  // namespace dhpmap::simulator

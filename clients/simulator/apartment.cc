// SPDX-License-Identifier: BSD-3-Clause
#include "clients/simulator/apartment.h"

#include <array>

namespace dhpmap::simulator {
namespace {

const std::array<Room, 5> kRooms{{
    {"living room", 0.0, 6.15, 0.0, 4.55, {2.9, 2.1, 2.45}},
    {"bedroom", 0.0, 4.15, 4.65, 8.0, {2.3, 6.4, 2.45}},
    {"bath", 4.25, 6.75, 4.65, 8.0, {5.5, 6.2, 2.45}},
    {"study", 6.85, 11.0, 4.65, 8.0, {8.9, 6.3, 2.45}},
    {"kitchen", 6.25, 11.0, 0.0, 4.55, {8.3, 1.7, 2.45}},
}};

SceneBuilder Furnish(ApartmentScene::Ceiling ceiling) {
  SceneBuilder builder;
  AddWallsAndFloors(builder);
  FurnishLivingRoom(builder);
  FurnishBedroom(builder);
  FurnishBath(builder);
  FurnishStudy(builder);
  FurnishKitchen(builder);
  // Last, so that the ids of other instances do not depend on it.
  if (ceiling == ApartmentScene::Ceiling::kClosed) AddCeiling(builder);
  return builder;
}

}  // namespace

ApartmentScene::ApartmentScene(Ceiling ceiling) : ApartmentScene(Furnish(ceiling)) {}

ApartmentScene::ApartmentScene(const SceneBuilder& builder)
    : instances_(builder.instances()), materials_(builder.materials()), tree_(builder.solids()) {}

std::span<const Room> ApartmentScene::Rooms() { return kRooms; }

}  // namespace dhpmap::simulator

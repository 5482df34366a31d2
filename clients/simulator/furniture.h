// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "clients/simulator/scene_builder.h"

// Each function adds one thing (a new instance) at a place. Sizes are full sizes in metres.
namespace dhpmap::simulator {

// Seating and sleeping
void AddSofa(SceneBuilder& scene, const Place& place, double width_m, const Material& cloth);
void AddArmchair(SceneBuilder& scene, const Place& place, const Material& cloth);
void AddChair(SceneBuilder& scene, const Place& place, const Material& wood, const Material& seat);
void AddDeskChair(SceneBuilder& scene, const Place& place, const Material& cloth);
void AddPouf(SceneBuilder& scene, const Place& place, const Material& cloth);
void AddBed(SceneBuilder& scene, const Place& place);
void AddCushion(SceneBuilder& scene, const Place& place, const Material& cloth, double lean_deg);

// Tables and storage
void AddCoffeeTable(SceneBuilder& scene, const Place& place);
void AddSideTable(SceneBuilder& scene, const Place& place);
void AddDiningTable(SceneBuilder& scene, const Place& place);
void AddDesk(SceneBuilder& scene, const Place& place);
void AddTvCabinet(SceneBuilder& scene, const Place& place);
void AddBookshelf(SceneBuilder& scene, const Place& place, double width_m, double height_m, int num_shelves);
void AddDresser(SceneBuilder& scene, const Place& place, double width_m, const Material& wood);
void AddNightstand(SceneBuilder& scene, const Place& place);
void AddWardrobe(SceneBuilder& scene, const Place& place);

// Things on floors, tables, shelves and walls
void AddTv(SceneBuilder& scene, const Place& place, double width_m);
void AddMonitor(SceneBuilder& scene, const Place& place);
void AddFloorLamp(SceneBuilder& scene, const Place& place);
void AddTableLamp(SceneBuilder& scene, const Place& place, const Material& base);
void AddCeilingLamp(SceneBuilder& scene, const Place& place);
void AddPendantLamp(SceneBuilder& scene, const Place& place, double drop_m);
void AddPlant(SceneBuilder& scene, const Place& place, double height_m);
void AddSmallPlant(SceneBuilder& scene, const Place& place);
/// The place is the centre of its back.
void AddPicture(SceneBuilder& scene, const Place& place, double width_m, double height_m, const Material& picture);
void AddMirror(SceneBuilder& scene, const Place& place, double width_m, double height_m);
void AddBooks(SceneBuilder& scene, const Place& place, int count, std::uint32_t first_color);
void AddBox(SceneBuilder& scene, const Place& place, const Eigen::Vector3d& size_m, const Material& material);
void AddBall(SceneBuilder& scene, const Place& place, double radius_m, const Material& material);
void AddVase(SceneBuilder& scene, const Place& place, const Material& material);
void AddBottle(SceneBuilder& scene, const Place& place, const Material& glass);
void AddCup(SceneBuilder& scene, const Place& place, const Material& material);
void AddFruitBowl(SceneBuilder& scene, const Place& place);
void AddBin(SceneBuilder& scene, const Place& place, const Material& material);
void AddTowel(SceneBuilder& scene, const Place& place, const Material& cloth);

// Kitchen and bath
void AddKitchenCounter(SceneBuilder& scene, const Place& place, double width_m, bool has_sink);
void AddWallCabinet(SceneBuilder& scene, const Place& place, double width_m);
void AddStove(SceneBuilder& scene, const Place& place);
void AddRangeHood(SceneBuilder& scene, const Place& place);
void AddFridge(SceneBuilder& scene, const Place& place);
void AddMicrowave(SceneBuilder& scene, const Place& place);
void AddKettle(SceneBuilder& scene, const Place& place);
void AddToilet(SceneBuilder& scene, const Place& place);
void AddBathtub(SceneBuilder& scene, const Place& place);
void AddWashbasin(SceneBuilder& scene, const Place& place);
void AddWashingMachine(SceneBuilder& scene, const Place& place);

}  // namespace dhpmap::simulator

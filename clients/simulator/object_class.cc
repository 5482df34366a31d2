// SPDX-License-Identifier: BSD-3-Clause
#include "clients/simulator/object_class.h"

#include <array>

namespace dhpmap::simulator {
namespace {

using C = ObjectClass;

constexpr std::array<ObjectClassInfo, static_cast<std::size_t>(C::kCount)> kClasses{{
    {C::kUnknown, "unknown", false, 'M', C::kUnknown},
    {C::kWall, "wall", false, 'L', C::kCeiling},
    {C::kFloor, "floor", false, 'L', C::kRug},
    {C::kCeiling, "ceiling", false, 'L', C::kWall},
    {C::kDoor, "door", false, 'L', C::kWall},
    {C::kWindow, "window", false, 'L', C::kWall},
    {C::kRug, "rug", false, 'L', C::kFloor},
    {C::kCurtain, "curtain", false, 'L', C::kWall},
    {C::kSofa, "sofa", true, 'L', C::kArmchair},
    {C::kArmchair, "armchair", true, 'M', C::kSofa},
    {C::kChair, "chair", true, 'M', C::kArmchair},
    {C::kCoffeeTable, "coffee table", true, 'M', C::kDiningTable},
    {C::kDiningTable, "dining table", true, 'L', C::kDesk},
    {C::kDesk, "desk", true, 'L', C::kDiningTable},
    {C::kTvCabinet, "tv cabinet", true, 'L', C::kDresser},
    {C::kTv, "tv", true, 'M', C::kPicture},
    {C::kMonitor, "monitor", true, 'M', C::kTv},
    {C::kBookshelf, "bookshelf", true, 'L', C::kWardrobe},
    {C::kWardrobe, "wardrobe", true, 'L', C::kBookshelf},
    {C::kDresser, "dresser", true, 'M', C::kNightstand},
    {C::kNightstand, "nightstand", true, 'M', C::kDresser},
    {C::kBed, "bed", true, 'L', C::kSofa},
    {C::kCushion, "cushion", true, 'S', C::kPouf},
    {C::kLamp, "lamp", true, 'M', C::kVase},
    {C::kPlant, "plant", true, 'M', C::kVase},
    {C::kPicture, "picture", true, 'M', C::kMirror},
    {C::kMirror, "mirror", true, 'M', C::kPicture},
    {C::kBooks, "books", true, 'S', C::kBox},
    {C::kBox, "box", true, 'M', C::kBooks},
    {C::kBall, "ball", true, 'S', C::kPouf},
    {C::kVase, "vase", true, 'S', C::kBottle},
    {C::kBottle, "bottle", true, 'S', C::kVase},
    {C::kCup, "cup", true, 'S', C::kBowl},
    {C::kBowl, "bowl", true, 'S', C::kCup},
    {C::kKitchenCounter, "kitchen counter", true, 'L', C::kTvCabinet},
    {C::kWallCabinet, "wall cabinet", true, 'L', C::kWardrobe},
    {C::kStove, "stove", true, 'M', C::kWashingMachine},
    {C::kRangeHood, "range hood", true, 'M', C::kWallCabinet},
    {C::kFridge, "fridge", true, 'L', C::kWardrobe},
    {C::kMicrowave, "microwave", true, 'M', C::kTv},
    {C::kKettle, "kettle", true, 'S', C::kBottle},
    {C::kBin, "bin", true, 'M', C::kBox},
    {C::kToilet, "toilet", true, 'M', C::kWashbasin},
    {C::kBathtub, "bathtub", true, 'L', C::kBed},
    {C::kWashbasin, "washbasin", true, 'M', C::kToilet},
    {C::kWashingMachine, "washing machine", true, 'M', C::kStove},
    {C::kTowel, "towel", true, 'S', C::kPicture},
    {C::kPouf, "pouf", true, 'M', C::kArmchair},
}};

constexpr bool IsInOrder() {
  for (std::size_t i = 0; i < kClasses.size(); ++i) {
    if (static_cast<std::size_t>(kClasses[i].object_class) != i) return false;
  }
  return true;
}
static_assert(IsInOrder());

}  // namespace

std::span<const ObjectClassInfo> ObjectClasses() { return kClasses; }

}  // namespace dhpmap::simulator

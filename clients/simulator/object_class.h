// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>

namespace dhpmap::simulator {

/// Classes of the apartment. The number is the ClassID and category_id in the files; 0 = no label.
enum class ObjectClass : std::uint8_t {
  kUnknown,
  // Stuff
  kWall,
  kFloor,
  kCeiling,
  kDoor,
  kWindow,
  kRug,
  kCurtain,
  // Things
  kSofa,
  kArmchair,
  kChair,
  kCoffeeTable,
  kDiningTable,
  kDesk,
  kTvCabinet,
  kTv,
  kMonitor,
  kBookshelf,
  kWardrobe,
  kDresser,
  kNightstand,
  kBed,
  kCushion,
  kLamp,
  kPlant,
  kPicture,
  kMirror,
  kBooks,
  kBox,
  kBall,
  kVase,
  kBottle,
  kCup,
  kBowl,
  kKitchenCounter,
  kWallCabinet,
  kStove,
  kRangeHood,
  kFridge,
  kMicrowave,
  kKettle,
  kBin,
  kToilet,
  kBathtub,
  kWashbasin,
  kWashingMachine,
  kTowel,
  kPouf,
  kCount
};

struct ObjectClassInfo {
  ObjectClass object_class;
  const char* name;
  bool is_thing;
  char size;                 ///< S, M or L, as in the label tables
  ObjectClass mistaken_for;  ///< the most likely misclassification by a network
};

/// By class number, kUnknown first.
std::span<const ObjectClassInfo> ObjectClasses();

inline const ObjectClassInfo& InfoOf(ObjectClass object_class) {
  return ObjectClasses()[static_cast<std::size_t>(object_class)];
}

}  // namespace dhpmap::simulator

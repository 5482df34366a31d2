// SPDX-License-Identifier: BSD-3-Clause
#include "clients/datasets/semantic_kitti_classes.h"

#include <algorithm>

#include "clients/datasets/label_table.h"

namespace dhpmap {
namespace {

struct Row {
  std::uint16_t id;
  const char* name;
  Panoptic panoptic;
  SizeClass size;
};

constexpr Panoptic kThing = Panoptic::kThing;
constexpr Panoptic kStuff = Panoptic::kStuff;
constexpr SizeClass kS = SizeClass::kSmall;
constexpr SizeClass kM = SizeClass::kMedium;
constexpr SizeClass kL = SizeClass::kLarge;

// Names and kinds as in the data set; sizes are ours.
constexpr Row kRows[] = {
    {10, "car", kThing, kM},
    {11, "bicycle", kThing, kS},
    {13, "bus", kThing, kL},
    {15, "motorcycle", kThing, kS},
    {16, "on-rails", kThing, kL},
    {18, "truck", kThing, kL},
    {20, "other-vehicle", kThing, kM},
    {30, "person", kThing, kS},
    {31, "bicyclist", kThing, kS},
    {32, "motorcyclist", kThing, kS},
    {40, "road", kStuff, kL},
    {44, "parking", kStuff, kL},
    {48, "sidewalk", kStuff, kL},
    {49, "other-ground", kStuff, kL},
    {50, "building", kStuff, kL},
    {51, "fence", kStuff, kL},
    {52, "other-structure", kStuff, kL},
    {60, "lane-marking", kStuff, kL},
    {70, "vegetation", kStuff, kL},
    {71, "trunk", kStuff, kM},
    {72, "terrain", kStuff, kL},
    {80, "pole", kStuff, kS},
    {81, "traffic-sign", kStuff, kS},
    {99, "other-object", kStuff, kM},
    {252, "moving-car", kThing, kM},
    {253, "moving-bicyclist", kThing, kS},
    {254, "moving-person", kThing, kS},
    {255, "moving-motorcyclist", kThing, kS},
    {256, "moving-on-rails", kThing, kL},
    {257, "moving-bus", kThing, kL},
    {258, "moving-truck", kThing, kL},
    {259, "moving-other-vehicle", kThing, kM},
};

}  // namespace

const std::vector<LabelClass>& SemanticKittiClasses() {
  static const std::vector<LabelClass> classes = [] {
    std::vector<LabelClass> result;
    for (const Row& row : kRows) {
      result.push_back({ClassId(row.id), row.name, row.panoptic, row.size, PaletteColor(row.id)});
    }
    return result;
  }();
  return classes;
}

std::uint32_t PersistentId(std::uint32_t word) {
  const KittiLabel label(word);
  const Row* row = std::lower_bound(std::begin(kRows), std::end(kRows), label.class_id,
                                    [](const Row& a, std::uint16_t id) { return a.id < id; });
  if (row == std::end(kRows) || row->id != label.class_id) return 0;
  if (row->panoptic == Panoptic::kStuff) return label.class_id;
  return label.instance == 0 ? 0 : word;
}

}  // namespace dhpmap

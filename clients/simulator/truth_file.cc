// SPDX-License-Identifier: BSD-3-Clause
#include "clients/simulator/truth_file.h"

#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
#include <vector>

#include "clients/simulator/rounded_point.h"

namespace dhpmap::simulator {
namespace {

// Keeps the order of keys as written.
using Json = nlohmann::ordered_json;

/// The yaw to a hundredth of a degree: 1 mm at 6 m.
Json SeenBox(const UprightBox& box) {
  return {{"center", RoundedPoint(box.center_m)},
          {"size", RoundedPoint(box.size_m)},
          {"yaw_deg", std::round(box.yaw_rad * 180 / std::numbers::pi * 1e2) / 1e2}};
}

Json TruthOf(const Instance& instance, const Eigen::AlignedBox3d& box, const InstanceView& view) {
  const ObjectClassInfo& info = InfoOf(instance.object_class);
  return {{"id", instance.id},
          {"class", info.name},
          {"name", instance.name},
          {"kind", info.is_thing ? "thing" : "stuff"},
          {"size", std::string(1, info.size)},
          {"box_m", {{"min", RoundedPoint(box.min())}, {"max", RoundedPoint(box.max())}}},
          {"seen_box_m", SeenBox(view.seen.Box())},
          {"point_m", RoundedPoint(view.point_m)},
          {"margin_px", view.margin_px},
          {"num_frames", view.num_frames}};
}

}  // namespace

std::string TruthJson(const ApartmentScene& scene, std::span<const InstanceView> views) {
  std::vector<Eigen::AlignedBox3d> boxes(scene.instances().size());
  for (const Solid& solid : scene.solids()) boxes[solid.instance].extend(solid.Bounds());
  std::string text = "[";
  for (const Instance& instance : scene.instances()) {
    if (instance.id == 0 || views[instance.id].margin_px == 0) continue;
    text += (text.size() > 1 ? ",\n " : "\n ") + TruthOf(instance, boxes[instance.id], views[instance.id]).dump();
  }
  return text + "\n]\n";
}

}  // namespace dhpmap::simulator

// SPDX-License-Identifier: BSD-3-Clause
#include "clients/simulator/truth_file.h"

#include <cmath>
#include <nlohmann/json.hpp>
#include <vector>

namespace dhpmap::simulator {
namespace {

// Keeps the order of keys as written.
using Json = nlohmann::ordered_json;

/// To a tenth of a millimetre, so that files are short and the same everywhere.
Json Rounded(const Eigen::Vector3d& p) {
  Json json = Json::array();
  for (int i = 0; i < 3; ++i) json.push_back(std::round(p[i] * 1e4) / 1e4);
  return json;
}

Json TruthOf(const Instance& instance, const Eigen::AlignedBox3d& box, const InstanceView& view) {
  const ObjectClassInfo& info = InfoOf(instance.object_class);
  return {{"id", instance.id},
          {"class", info.name},
          {"name", instance.name},
          {"kind", info.is_thing ? "thing" : "stuff"},
          {"size", std::string(1, info.size)},
          {"box_m", {{"min", Rounded(box.min())}, {"max", Rounded(box.max())}}},
          {"point_m", Rounded(view.point_m)},
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

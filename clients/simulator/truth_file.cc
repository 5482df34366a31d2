// SPDX-License-Identifier: BSD-3-Clause
#include "clients/simulator/truth_file.h"

#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
#include <vector>

#include "clients/simulator/rounded_point.h"
#include "clients/simulator/truth_relations.h"

namespace dhpmap::simulator {
namespace {

// Keeps keys in the order of writing.
using Json = nlohmann::ordered_json;

bool IsSeen(const InstanceView& view) { return view.margin_px > 0; }

/// Yaw is rounded to 0.01 degrees: 1 mm at 6 m.
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

double Rounded(double value) { return std::round(value * 1e4) / 1e4; }

Json JsonOf(const TruthRelation& relation) {
  Json json = {{"kind", NameOf(relation.kind)}, {"object", relation.object}};
  if (relation.kind == TruthRelationKind::kOn) json["support"] = Rounded(relation.support);
  if (relation.kind == TruthRelationKind::kNextTo) {
    json["gap_m"] = Rounded(relation.gap_m);
    json["height_share"] = Rounded(relation.height_share);
  }
  return json;
}

/// Relations of one instance to others that were seen.
Json JsonOfSeen(const std::vector<TruthRelation>& relations, std::uint8_t subject,
                std::span<const InstanceView> views) {
  Json json = Json::array();
  for (const TruthRelation& relation : relations) {
    if (relation.subject == subject && IsSeen(views[relation.object])) json.push_back(JsonOf(relation));
  }
  return json;
}

}  // namespace

std::string TruthJson(const ApartmentScene& scene, std::span<const InstanceView> views) {
  std::vector<Eigen::AlignedBox3d> boxes(scene.instances().size());
  for (const Solid& solid : scene.solids()) boxes[solid.instance].extend(solid.Bounds());
  const std::vector<TruthRelation> relations = RelationsOf(scene.instances(), scene.solids());
  std::string text = "[";
  for (const Instance& instance : scene.instances()) {
    if (instance.id == 0 || !IsSeen(views[instance.id])) continue;
    Json entry = TruthOf(instance, boxes[instance.id], views[instance.id]);
    entry["relations"] = JsonOfSeen(relations, instance.id, views);
    text += (text.size() > 1 ? ",\n " : "\n ") + entry.dump();
  }
  return text + "\n]\n";
}

}  // namespace dhpmap::simulator

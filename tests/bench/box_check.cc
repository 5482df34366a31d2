// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cstdio>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <numbers>
#include <optional>
#include <vector>

#include "mapping/query/point_lookup.h"
#include "mapping/submap/submap_outline.h"
#include "tests/bench/bench.h"
#include "tests/bench/cpu_time.h"
#include "tests/bench/frames.h"
#include "tests/bench/recording.h"

namespace dhpmap::bench {
namespace {

/// A thing of the simulator's truth.json.
struct TrueThing {
  std::string name, size;
  Eigen::Vector3d point_m;
  UprightBox seen;
};

Eigen::Vector3d PointOf(const nlohmann::json& list) {
  return {list.at(0).get<double>(), list.at(1).get<double>(), list.at(2).get<double>()};
}

Result<std::vector<TrueThing>> ReadTrueThings(const std::string& directory) {
  const std::string path = directory + "/truth.json";
  std::ifstream file(path);
  const nlohmann::json truth = nlohmann::json::parse(file, nullptr, false);
  if (!truth.is_array()) return NotFound(path + " is not there, or no list");
  std::vector<TrueThing> things;
  for (const nlohmann::json& entry : truth) {
    if (entry.value("kind", "") != "thing") continue;
    if (!entry.contains("seen_box_m")) return InvalidArgument(path + " has no seen_box_m: render it again");
    const nlohmann::json& box = entry["seen_box_m"];
    things.push_back({.name = entry.at("name").get<std::string>(),
                      .size = entry.at("size").get<std::string>(),
                      .point_m = PointOf(entry.at("point_m")),
                      .seen = {.center_m = PointOf(box.at("center")),
                               .yaw_rad = box.at("yaw_deg").get<double>() * std::numbers::pi / 180,
                               .size_m = PointOf(box.at("size"))}});
  }
  return things;
}

/// Around a submap's blocks.
UprightBox BlockBox(const Submap& submap) {
  Eigen::AlignedBox3d box;
  for (const BlockEntry& entry : submap.blocks().entries()) {
    const Eigen::Vector3d low = BlockCorner(entry.index, submap.info().voxel_size_m);
    box.extend(low);
    box.extend(low + Eigen::Vector3d::Constant(kBlockSide * submap.info().voxel_size_m));
  }
  return {.center_m = box.center(), .yaw_rad = 0, .size_m = box.sizes()};
}

double MedianShare(std::vector<double> values) {
  if (values.empty()) return 0;
  std::sort(values.begin(), values.end());
  const std::size_t middle = values.size() / 2;
  return values.size() % 2 == 1 ? values[middle] : (values[middle - 1] + values[middle]) / 2;
}

/// The thing that a map has at a point; null: none.
const Submap* ThingAt(const Eigen::Vector3d& p_map, const PointLookup& lookup, const MapSnapshot& state) {
  const PointInfo info = lookup.At(p_map);
  return info.is_observed && info.panoptic == Panoptic::kThing ? state.Find(info.submap) : nullptr;
}

void PrintThing(const TrueThing& thing, const std::optional<SubmapOutline>& found, double share) {
  const Eigen::Vector3d size_m = found ? found->box.size_m : Eigen::Vector3d::Zero();
  std::printf("%-24s %s  %.3f  seen %.2f x %.2f x %.2f m, mapped %.2f x %.2f x %.2f m\n", thing.name.c_str(),
              thing.size.c_str(), share, thing.seen.size_m.x(), thing.seen.size_m.y(), thing.seen.size_m.z(),
              size_m.x(), size_m.y(), size_m.z());
}

/// Intersection over union by group of things.
using Shares = std::map<std::string, std::vector<double>>;

Status CheckBoxes(const std::string& directory, LabelSource labels, bool list) {
  DHPMAP_ASSIGN_OR_RETURN(const std::vector<TrueThing> things, ReadTrueThings(directory));
  DHPMAP_ASSIGN_OR_RETURN(const Recording recording, MapRecording(directory, 0, labels));
  const auto state = recording.builder->map().Publish(0);
  const PointLookup lookup(state);
  Shares of_outlines, of_blocks;
  int num_without = 0;
  for (const TrueThing& thing : things) {
    const Submap* submap = ThingAt(thing.point_m, lookup, *state);
    const auto outline = submap == nullptr ? std::nullopt : OutlineInMap(*submap);
    const double share = outline ? IntersectionOverUnion(outline->box, thing.seen) : 0;
    const double by_blocks = submap == nullptr ? 0 : IntersectionOverUnion(BlockBox(*submap), thing.seen);
    for (const std::string& group : {std::string("all"), thing.size}) {
      of_outlines[group].push_back(share);
      of_blocks[group].push_back(by_blocks);
    }
    num_without += outline ? 0 : 1;
    if (list) PrintThing(thing, outline, share);
  }
  const double begin_s = ThreadCpu_s();
  for (const auto& submap : state->submaps()) (void)OutlineInMap(*submap);
  const double all_ms = 1e3 * (ThreadCpu_s() - begin_s);
  std::printf("%s, %s labels: %zu things, %d without a box; outlines of all %zu objects in %.1f ms\n",
              directory.c_str(), labels == LabelSource::kGroundTruth ? "true" : "predicted", things.size(), num_without,
              state->submaps().size(), all_ms);
  for (const auto& [group, shares] : of_outlines) {
    std::printf("  %-4s median IoU %.3f, of boxes around blocks %.3f\n", group.c_str(), MedianShare(shares),
                MedianShare(of_blocks[group]));
  }
  return Status::Ok();
}

}  // namespace

Status RunBoxCheck(const BoxCheckOptions& options) {
  for (const std::string& directory : options.directories) {
    for (const LabelSource labels : {LabelSource::kPredicted, LabelSource::kGroundTruth}) {
      DHPMAP_RETURN_IF_ERROR(CheckBoxes(directory, labels, options.list));
    }
  }
  return Status::Ok();
}

}  // namespace dhpmap::bench

// SPDX-License-Identifier: BSD-3-Clause
#include "storage/rows/map_checksum_v1.h"

#include <algorithm>
#include <string_view>

#include "storage/codec/crc32c.h"

namespace dhpmap {
namespace {

// Frozen: the fields of mapping/map/map_config.h when rows of version 1 were written.
constexpr std::string_view kKeys[] = {
    "voxel_size_m",
    "truncation_m",
    "integration.min_range_m",
    "integration.max_range_m",
    "integration.weighting",
    "integration.max_weight",
    "integration.weight_dropoff",
    "integration.anti_grazing",
    "integration.carving",
    "tracking.iou_threshold",
    "tracking.depth_tolerance_vox",
    "tracking.match_requires_class",
    "tracking.split_gap_vox",
    "tracking.min_points_stuff",
    "tracking.min_points_small",
    "tracking.min_points_medium",
    "tracking.min_points_large",
    "activity.required_reobservations",
    "activity.deactivate_after_missed",
    "refinement.every_frames",
    "refinement.management",
    "refinement.crf",
    "refinement.drop_voxel_labels",
    "refinement.crf_iterations",
    "refinement.smoothness.position_m",
    "refinement.smoothness.weight",
    "refinement.appearance.position_m",
    "refinement.appearance.color",
    "refinement.appearance.weight",
};

const ConfigRow* Find(const std::vector<ConfigRow>& config, std::string_view key) {
  const auto found = std::find_if(config.begin(), config.end(), [&](const ConfigRow& row) { return row.key == key; });
  return found == config.end() ? nullptr : &*found;
}

}  // namespace

Result<std::uint32_t> MapChecksumV1(const MapRow& row, const std::vector<ConfigRow>& config,
                                    const std::vector<ClassRow>& classes) {
  for (const ConfigRow& stored : config) {
    if (std::find(std::begin(kKeys), std::end(kKeys), stored.key) != std::end(kKeys)) continue;
    return FailedPrecondition("the map's config is not of this version: unknown config key " + stored.key)
        .WithReason("NEWER_CONFIG");
  }
  Bytes bytes;
  Maps().Cover(row, 1, bytes);
  ByteWriter writer(bytes);
  for (const std::string_view key : kKeys) {
    const ConfigRow* stored = Find(config, key);
    if (stored == nullptr) continue;
    writer.PutText(stored->key);
    writer.PutText(stored->value);
  }
  for (const ClassRow& stored : classes) {
    const LabelClass& label = stored.label;
    writer.PutU32(label.id.value);
    writer.PutText(label.name);
    writer.PutU8(static_cast<std::uint8_t>(label.panoptic));
    writer.PutU8(static_cast<std::uint8_t>(label.size));
    writer.PutU32(static_cast<std::uint32_t>(ToInteger(label.color)));
  }
  return Crc32c(bytes);
}

}  // namespace dhpmap

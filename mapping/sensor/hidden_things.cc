// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/sensor/hidden_things.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace dhpmap {
namespace {

std::vector<std::uint32_t> ThingIds(const PanopticFrame& frame, const LabelSet& label_set) {
  std::vector<std::uint32_t> ids;
  for (const SegmentInfo& segment : frame.segments) {
    const LabelClass* label = segment.class_id ? label_set.Find(*segment.class_id) : nullptr;
    if (label != nullptr && label->panoptic == Panoptic::kThing) ids.push_back(segment.id.value);
  }
  std::sort(ids.begin(), ids.end());
  return ids;
}

}  // namespace

std::optional<PanopticFrame> WithoutHiddenThings(const PanopticFrame& frame, const LabelSet& label_set) {
  if (!frame.lidar || frame.lidar->is_hidden.empty() || frame.lidar->segments.empty()) return std::nullopt;
  const LidarData& scan = *frame.lidar;
  const std::vector<std::uint32_t> things = ThingIds(frame, label_set);
  std::optional<PanopticFrame> rest;
  for (std::size_t i = 0; i < scan.segments.size(); ++i) {
    if (scan.is_hidden[i] == 0 || !std::binary_search(things.begin(), things.end(), scan.segments[i])) continue;
    if (!rest) rest = frame;
    rest->lidar->segments[i] = kNoSegment.value;
  }
  return rest;
}

}  // namespace dhpmap

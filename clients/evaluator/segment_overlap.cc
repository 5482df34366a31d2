// SPDX-License-Identifier: BSD-3-Clause
#include "clients/evaluator/segment_overlap.h"

#include <cstddef>
#include <unordered_map>

namespace dhpmap::evaluator {
namespace {

struct PairHash {
  std::size_t operator()(const std::pair<ElementLabel, ElementLabel>& pair) const noexcept {
    const auto word = [](const ElementLabel& label) {
      return static_cast<std::uint64_t>(static_cast<std::uint16_t>(label.class_index)) << 32 | label.instance;
    };
    std::uint64_t h = word(pair.first) * 0x9E3779B97F4A7C15ull ^ word(pair.second) * 0xC2B2AE3D27D4EB4Full;
    return h ^ (h >> 31);
  }
};

}  // namespace

double SegmentOverlap::Iou(const ElementLabel& truth_segment, const ElementLabel& predicted_segment) const {
  const auto both = shared.find({truth_segment, predicted_segment});
  if (both == shared.end()) return 0;
  const std::int64_t num_either = truth.at(truth_segment) + predicted.at(predicted_segment) - both->second;
  return static_cast<double>(both->second) / static_cast<double>(num_either);
}

SegmentOverlap CountSegments(std::span<const Element> elements) {
  std::unordered_map<std::pair<ElementLabel, ElementLabel>, std::int64_t, PairHash> counts;
  for (const Element& element : elements) {
    if (element.truth.class_index != ClassMap::kNone) ++counts[{element.truth, element.predicted}];
  }
  SegmentOverlap overlap;
  for (const auto& [pair, count] : counts) {
    overlap.truth[pair.first] += count;
    if (pair.second.class_index == ClassMap::kNone) continue;
    overlap.predicted[pair.second] += count;
    overlap.shared[pair] += count;
  }
  return overlap;
}

}  // namespace dhpmap::evaluator

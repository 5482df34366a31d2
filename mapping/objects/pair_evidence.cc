// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/objects/pair_evidence.h"

#include <map>
#include <optional>

namespace dhpmap {
namespace {

/// With fewer points in a frame, a thing gives no evidence about its segment.
constexpr std::int64_t kLeastPoints = 60;
/// The share of a thing's points in a frame that must lie in its segment.
constexpr double kShownShare = 0.6;

/// A thing that a segment shows.
struct Shown {
  const Submap* submap;
  int row;
};

std::optional<int> RowThatShows(std::size_t candidate, const std::vector<SegmentBundles>& segments,
                                const OverlapTable& overlaps) {
  const std::int64_t all = overlaps.candidate_hits[candidate];
  if (all < kLeastPoints) return std::nullopt;
  std::map<int, std::int64_t> hits;  // by row: parts of a segment count together
  for (std::size_t s = 0; s < segments.size(); ++s) {
    if (segments[s].row >= 0) hits[segments[s].row] += overlaps.hits[s][candidate];
  }
  for (const auto& [row, count] : hits) {
    if (static_cast<double>(count) >= kShownShare * static_cast<double>(all)) return row;
  }
  return std::nullopt;
}

bool MayBeOne(const Submap& a, const Submap& b) {
  return a.info().class_id == b.info().class_id && a.BoundingSphereInMap().Intersects(b.BoundingSphereInMap());
}

}  // namespace

void NotePairs(const std::vector<SegmentBundles>& segments, const OverlapTable& overlaps, Map& map) {
  std::vector<Shown> shown;
  for (std::size_t c = 0; c < overlaps.candidates.size(); ++c) {
    const Submap* submap = map.Find(overlaps.candidates[c]);
    if (submap == nullptr || submap->info().is_locked) continue;
    if (const auto row = RowThatShows(c, segments, overlaps)) shown.push_back({submap, *row});
  }
  for (std::size_t a = 0; a < shown.size(); ++a) {
    for (std::size_t b = a + 1; b < shown.size(); ++b) {
      if (!MayBeOne(*shown[a].submap, *shown[b].submap)) continue;
      const bool is_one = shown[a].row == shown[b].row;
      map.mutable_info().pairs.AddEvidence(shown[a].submap->id(), shown[b].submap->id(),
                                           is_one ? kSeenAsOne : kSeenApart, kLeastEvidence, kIsOne);
    }
  }
}

}  // namespace dhpmap

// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/tracking/covered_things.h"

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <map>
#include <set>
#include <utility>

#include "mapping/tracking/things_in_view.h"

namespace dhpmap {
namespace {

/// Whether at least half of the segment's points hit a single thing of another class.
bool IsCovered(const UnmatchedSegment& unmatched, std::int64_t num_points, const OverlapTable& overlaps,
               const Map& map) {
  const std::vector<std::int64_t>& hits = overlaps.hits[unmatched.segment];
  const auto most = std::max_element(hits.begin(), hits.end());
  if (most == hits.end() || 2 * *most < num_points) return false;
  const SubmapId coverer = overlaps.candidates[static_cast<std::size_t>(most - hits.begin())];
  return !map.Find(coverer)->info().IsSeenAs(unmatched.class_id);
}

struct Pair {
  double iou;
  std::size_t thing, segment;
};

/// For one segment: indices of things of its class that are hit by at least half of its points, with the number of
/// hits.
std::vector<std::pair<std::size_t, std::int64_t>> ThingsBelow(const UnmatchedSegment& unmatched,
                                                              const SegmentBundles& bundles, const ThingsInView& things,
                                                              const std::vector<bool>& is_open) {
  std::vector<std::pair<std::size_t, std::int64_t>> below;
  for (std::size_t t = 0; t < things.list().size(); ++t) {
    if (!is_open[t] || !things.list()[t].submap->info().IsSeenAs(unmatched.class_id)) continue;
    const std::int64_t shared = things.NumPointsOn(bundles, t);
    if (2 * shared >= bundles.num_points) below.emplace_back(t, shared);
  }
  return below;
}

}  // namespace

std::vector<CoveredMatch> MatchCovered(const PanopticFrame& frame, const std::vector<SegmentBundles>& segments,
                                       const std::vector<UnmatchedSegment>& unmatched, const OverlapTable& overlaps,
                                       const std::vector<SubmapId>& taken, const Map& map, ThreadPool& pool) {
  std::vector<UnmatchedSegment> covered;
  std::copy_if(unmatched.begin(), unmatched.end(), std::back_inserter(covered),
               [&](const UnmatchedSegment& u) { return IsCovered(u, segments[u.segment].num_points, overlaps, map); });
  if (covered.empty()) return {};

  const ThingsInView things(frame, map);
  const std::set<SubmapId> is_taken(taken.begin(), taken.end());
  std::vector<bool> is_open;
  is_open.reserve(things.list().size());
  for (const ThingInView& thing : things.list()) {
    is_open.push_back(!thing.submap->IsAbsent() && !is_taken.contains(thing.submap->id()));
  }
  std::vector<std::vector<std::pair<std::size_t, std::int64_t>>> below(covered.size());
  pool.ParallelFor(covered.size(), [&](std::size_t i) {
    below[i] = ThingsBelow(covered[i], segments[covered[i].segment], things, is_open);
  });

  std::map<std::size_t, std::int64_t> points_on;  // over the whole frame, by thing
  for (const auto& of_segment : below) {
    for (const auto& [thing, shared] : of_segment) points_on.emplace(thing, 0);
  }
  for (auto& [thing, num_points] : points_on) {
    std::vector<std::int64_t> of_segment(segments.size());
    pool.ParallelFor(segments.size(),
                     [&, t = thing](std::size_t s) { of_segment[s] = things.NumPointsOn(segments[s], t); });
    for (const std::int64_t n : of_segment) num_points += n;
  }

  std::vector<Pair> pairs;
  for (std::size_t i = 0; i < covered.size(); ++i) {
    const std::int64_t num_points = segments[covered[i].segment].num_points;
    for (const auto& [thing, shared] : below[i]) {
      const double iou = static_cast<double>(shared) / static_cast<double>(points_on[thing] + num_points - shared);
      if (iou > map.info().config.tracking.iou_threshold) pairs.push_back({iou, thing, covered[i].segment});
    }
  }
  std::sort(pairs.begin(), pairs.end(), [](const Pair& a, const Pair& b) {
    if (a.iou != b.iou) return a.iou > b.iou;
    return a.thing != b.thing ? a.thing < b.thing : a.segment < b.segment;
  });
  std::vector<CoveredMatch> matches;
  std::set<std::size_t> is_matched;
  for (const Pair& pair : pairs) {
    if (!is_open[pair.thing] || !is_matched.insert(pair.segment).second) continue;
    is_open[pair.thing] = false;
    matches.push_back({pair.segment, things.list()[pair.thing].submap->id(), pair.iou});
  }
  return matches;
}

}  // namespace dhpmap

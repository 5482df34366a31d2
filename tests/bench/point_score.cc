// SPDX-License-Identifier: BSD-3-Clause
#include "tests/bench/point_score.h"

#include <algorithm>
#include <set>
#include <tuple>

namespace dhpmap {
namespace {

using Counts = std::map<std::pair<std::uint32_t, std::uint32_t>, std::int64_t>;  // (thing, submap) -> samples

/// The submap of each thing, one to one.
std::map<std::uint32_t, std::uint32_t> Assign(const Counts& counts) {
  std::vector<std::tuple<std::int64_t, std::uint32_t, std::uint32_t>> pairs;
  for (const auto& [pair, count] : counts) pairs.emplace_back(-count, pair.first, pair.second);
  std::sort(pairs.begin(), pairs.end());
  std::map<std::uint32_t, std::uint32_t> submap_of;
  std::set<std::uint32_t> taken;
  for (const auto& [count, thing, submap] : pairs) {
    if (submap_of.contains(thing) || taken.contains(submap)) continue;
    submap_of[thing] = submap;
    taken.insert(submap);
  }
  return submap_of;
}

/// The thing that most samples of each submap are of.
std::map<std::uint32_t, std::uint32_t> Owners(const Counts& counts) {
  std::map<std::uint32_t, std::pair<std::int64_t, std::uint32_t>> best;
  for (const auto& [pair, count] : counts) {
    auto& entry = best[pair.second];
    if (count > entry.first) entry = {count, pair.first};
  }
  std::map<std::uint32_t, std::uint32_t> owner_of;
  for (const auto& [submap, entry] : best) owner_of[submap] = entry.second;
  return owner_of;
}

}  // namespace

void PointScore::Wrong::Count(const PointSample& sample, const PointAnswer& answer, double max_range_m) {
  if (!answer.observed && sample.range_m >= max_range_m) ++out_of_range;
  else if (!answer.observed) ++unobserved;
  else if (answer.instance == 0) ++unknown_object;
  else if (sample.at_edge) ++at_edge;
  else ++other;
}

PointScore Score(const std::vector<PointSample>& samples, const std::vector<PointAnswer>& answers,
                 const std::unordered_map<std::uint32_t, TruthObject>& objects, const ClassMatch& match,
                 double max_range_m) {
  PointScore score;
  std::map<std::uint32_t, PointScore::Thing> things;
  Counts counts;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const TruthObject& object = objects.at(samples[i].segment);
    if (object.kind != Panoptic::kThing) continue;
    PointScore::Thing& thing = things[samples[i].segment];
    thing.segment = samples[i].segment;
    thing.class_id = object.class_id;
    ++thing.num_samples;
    if (answers[i].kind == Panoptic::kThing) ++counts[{samples[i].segment, answers[i].instance}];
  }
  const std::map<std::uint32_t, std::uint32_t> submap_of = Assign(counts);
  for (const auto& [submap, thing] : Owners(counts)) things[thing].submaps.push_back(submap);

  score.num_samples = static_cast<std::int64_t>(samples.size());
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const PointSample& sample = samples[i];
    const PointAnswer& answer = answers[i];
    const TruthObject& object = objects.at(sample.segment);
    const bool is_known = answer.observed && answer.instance != 0;
    const bool is_right_class = is_known && match.at(object.class_id).contains(answer.class_id);
    bool is_right_instance = is_right_class && answer.kind == Panoptic::kStuff;
    if (object.kind == Panoptic::kThing) {
      const auto it = submap_of.find(sample.segment);
      is_right_instance = is_known && it != submap_of.end() && it->second == answer.instance;
      if (is_right_instance) ++things[sample.segment].num_right;
    }
    score.num_observed += answer.observed ? 1 : 0;
    score.num_right_class += is_right_class ? 1 : 0;
    score.num_right_instance += is_right_instance ? 1 : 0;
    if (!is_right_class) score.wrong_class.Count(sample, answer, max_range_m);
    if (!is_right_instance) score.wrong_instance.Count(sample, answer, max_range_m);
    if (!is_right_class && is_known && !sample.at_edge) ++score.confusions[{object.class_id, answer.class_id}];
  }
  for (auto& [segment, thing] : things) score.things.push_back(std::move(thing));
  return score;
}

}  // namespace dhpmap

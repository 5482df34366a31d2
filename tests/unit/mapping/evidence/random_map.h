// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <map>
#include <random>
#include <vector>

#include "mapping/map/map.h"
#include "tests/support/map_infos.h"

namespace dhpmap::testing {

inline constexpr int kNumClasses = 4;
inline constexpr int kSpan_vox = 12;  // voxels per axis in which random submaps overlap, across block borders

inline MapInfo RandomMapInfo() { return NamedMap("m", 2, 2); }

inline Submap& AddSubmap(Map& map, Panoptic panoptic = Panoptic::kThing) {
  return map.Create(InfoOn(map, panoptic, ClassId(1)));
}

inline void Put(Submap& submap, VoxelIndex v, float distance_m, float weight, const LabelHistograms& labels) {
  const int i = LinearIndex(v);
  TsdfBlock& tsdf = submap.MutableTsdf(BlockOf(v));
  tsdf.distance_m[static_cast<std::size_t>(i)] = distance_m;
  tsdf.weight[static_cast<std::size_t>(i)] = weight;
  tsdf.color[static_cast<std::size_t>(i)] = {100, 150, 200};
  if (submap.id() != kUnknownSubmap) submap.MutableLabels(BlockOf(v)).Add(i, labels);
}

/// Several submaps, the unknown one too, that overlap at random, with counts for each other and for ids long gone.
inline Map RandomMap(unsigned seed) {
  std::mt19937 random(seed);
  const auto pick = [&random](int low, int high) { return std::uniform_int_distribution<int>(low, high)(random); };
  Map map(RandomMapInfo());
  const int num_submaps = pick(2, 6);
  for (int s = 0; s < num_submaps; ++s) AddSubmap(map, s % 2 == 0 ? Panoptic::kThing : Panoptic::kStuff);
  std::vector<SubmapId> ids;
  for (const auto& submap : map.submaps()) ids.push_back(submap->id());
  for (const SubmapId id : ids) {
    Submap& submap = *map.FindMutable(id);
    for (int n = 0; n < 400; ++n) {
      const VoxelIndex v{pick(-kSpan_vox, kSpan_vox), pick(-3, 3), pick(-3, 3)};
      const BlockEntry* entry = submap.blocks().Find(BlockOf(v));
      if (entry && entry->tsdf && entry->tsdf->IsObserved(LinearIndex(v))) continue;
      LabelHistograms labels;
      const auto count = static_cast<std::uint32_t>(pick(1, 30));
      labels.classes = {{static_cast<std::uint32_t>(pick(1, kNumClasses)), count}};
      labels.instances = {{kOwnInstance, count}};
      if (pick(0, 3) == 0) {
        const auto other = static_cast<std::uint32_t>(pick(1, num_submaps + 2));  // may be gone, or itself
        if (other != id.value) {
          const auto more = static_cast<std::uint32_t>(pick(1, 60));
          labels.instances.push_back({SeenInstance(SubmapId(other)), more});
          labels.classes = SumCounts(labels.classes, std::vector<LabelCount>{{1, more}});
        }
      }
      // Dyadic weights add up without rounding in any order.
      Put(submap, v, 0.01f * static_cast<float>(pick(-8, 8)), 0.25f * static_cast<float>(pick(1, 40)), labels);
    }
    submap.UpdateBoundingSphere();
  }
  return map;
}

inline std::vector<SubmapId> AllIds(const Map& map) {
  std::vector<SubmapId> ids;
  for (const auto& submap : map.submaps()) ids.push_back(submap->id());
  return ids;
}

/// All counts by class and by instance (own ones by the holder's id), and all weight: what refinement conserves.
struct Totals {
  std::map<std::uint32_t, std::uint64_t> classes, instances;
  double weight = 0;
  bool operator==(const Totals&) const = default;
};

template <typename Visit>
void ForEachVoxel(const Map& map, Visit&& visit) {
  for (const auto& submap : map.submaps()) {
    for (const BlockEntry& entry : submap->blocks().entries()) {
      for (int i = 0; i < kBlockVoxels; ++i) {
        if (entry.tsdf->IsObserved(i)) visit(*submap, entry, i);
      }
    }
  }
}

inline Totals Sum(const Map& map) {
  Totals totals;
  ForEachVoxel(map, [&](const Submap& submap, const BlockEntry& entry, int i) {
    totals.weight += entry.tsdf->weight[static_cast<std::size_t>(i)];
    if (!entry.labels) return;
    const LabelHistograms labels = entry.labels->Get(i);
    for (const LabelCount& c : labels.classes) totals.classes[c.id] += c.count;
    for (const InstanceCount& c : labels.instances) totals.instances[c.id.In(submap.id()).value] += c.count;
  });
  return totals;
}

}  // namespace dhpmap::testing

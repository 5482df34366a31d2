// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/refinement/voxel_merge.h"

#include <algorithm>

namespace dhpmap {
namespace {

constexpr std::uint32_t kOwnInstance = 0;

/// Exchanges "own" and `id`, and keeps the list sorted: from the voxel's own view to that of everybody, or back.
void Rename(std::uint32_t from, std::uint32_t to, std::vector<LabelCount>& instances) {
  const auto it =
      std::find_if(instances.begin(), instances.end(), [from](const LabelCount& entry) { return entry.id == from; });
  if (it == instances.end()) return;
  const LabelCount renamed{to, it->count};
  instances.erase(it);
  instances = SumCounts(instances, std::vector<LabelCount>{renamed});
}

std::uint8_t Rounded(double value) { return static_cast<std::uint8_t>(std::clamp(value + 0.5, 0.0, 255.0)); }

}  // namespace

void ExchangeCounts(std::uint32_t a, std::uint32_t b, std::vector<LabelCount>& counts) {
  const auto count_of = [&counts](std::uint32_t id) {
    const auto it = std::find_if(counts.begin(), counts.end(), [id](const LabelCount& c) { return c.id == id; });
    return it == counts.end() ? 0u : it->count;
  };
  const std::uint32_t count_a = count_of(a), count_b = count_of(b);
  std::erase_if(counts, [a, b](const LabelCount& c) { return c.id == a || c.id == b; });
  std::vector<LabelCount> exchanged;
  if (count_b > 0) exchanged.push_back({a, count_b});
  if (count_a > 0) exchanged.push_back({b, count_a});
  std::sort(exchanged.begin(), exchanged.end(), [](LabelCount x, LabelCount y) { return x.id < y.id; });
  counts = SumCounts(counts, exchanged);
}

void Accumulate(const BlockEntry& block, SubmapId holder, int linear, MergedVoxel& merged) {
  const auto i = static_cast<std::size_t>(linear);
  const double weight = block.tsdf->weight[i];
  const Color color = block.tsdf->color[i];
  if (merged.num_holders++ == 0 || merged.first_holder == kUnknownSubmap) merged.first_holder = holder;
  merged.weight += weight;
  merged.weighted_distance_m += weight * block.tsdf->distance_m[i];
  merged.weighted_r += weight * color.r;
  merged.weighted_g += weight * color.g;
  merged.weighted_b += weight * color.b;
  if (block.labels == nullptr || block.labels->IsEmpty(linear)) return;
  LabelHistograms histograms = block.labels->Get(linear);
  Rename(kOwnInstance, holder.value, histograms.instances);
  merged.histograms.classes = SumCounts(merged.histograms.classes, histograms.classes);
  merged.histograms.instances = SumCounts(merged.histograms.instances, histograms.instances);
}

void Store(const MergedVoxel& merged, SubmapId owner, int linear, TsdfBlock& tsdf, LabelBlock& labels) {
  const auto i = static_cast<std::size_t>(linear);
  tsdf.distance_m[i] = static_cast<float>(merged.weighted_distance_m / merged.weight);
  tsdf.weight[i] = static_cast<float>(merged.weight);
  tsdf.color[i] = {Rounded(merged.weighted_r / merged.weight), Rounded(merged.weighted_g / merged.weight),
                   Rounded(merged.weighted_b / merged.weight)};
  LabelHistograms histograms = merged.histograms;
  Rename(owner.value, kOwnInstance, histograms.instances);
  labels.Set(linear, histograms);
}

void Clear(int linear, TsdfBlock& tsdf, LabelBlock& labels) {
  const auto i = static_cast<std::size_t>(linear);
  tsdf.distance_m[i] = 0;
  tsdf.weight[i] = 0;
  tsdf.color[i] = {};
  labels.Clear(linear);
}

bool HasForeignVoxel(const LabelBlock& labels) {
  if (labels.NumOverflowVoxels() == 0) return false;
  for (int i = 0; i < kBlockVoxels; ++i) {
    if (labels.BestInstance(i).id != kOwnInstance) return true;
  }
  return false;
}

}  // namespace dhpmap

// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/refinement/label_crf.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "mapping/base/index_map.h"
#include "mapping/refinement/crf_tiles.h"
#include "mapping/refinement/dense_crf.h"
#include "mapping/refinement/label_channels.h"
#include "mapping/refinement/label_management.h"
#include "mapping/refinement/voxel_merge.h"

namespace dhpmap {
namespace {

constexpr int kCrfTileSide = 12;  // blocks; with 16 and 24 the same scores, and up to a third more memory
constexpr float kPriorCount = 1;  // observations that an unobserved voxel is given, spread over all channels

/// A voxel that takes part: where it is stored.
struct Member {
  std::uint32_t block;  // of CollectBlocks
  std::uint16_t linear;
};

/// What a voxel becomes; kKeep leaves a label as it is.
struct Change {
  static constexpr std::uint32_t kKeep = 0xFFFFFFFFu;
  Member member;
  std::uint32_t class_id = kKeep;
  std::uint32_t instance = kKeep;
};

/// One tile as a CRF problem.
struct Problem {
  std::vector<Member> members;
  std::size_t num_inner = 0;  // the first members; the others are the rim
  std::vector<CrfPoint> points;
  LabelChannels classes, instances;
  std::vector<float> values;

  // Places: the block indices of the tile.
  IndexMap<BlockIndex> place_numbers;
  std::vector<std::vector<std::uint32_t>> neighbours;  // of each place, within the rim
};

template <typename Visitor>
void VisitInstanceIds(const HeldBlock& block, int linear, Visitor&& visit) {
  block.entry->labels->VisitInstances(linear, [&](LabelCount seen) {
    visit(LabelCount{seen.id == 0 ? block.holder.value : seen.id, seen.count});
  });
}

void AddMembers(std::span<const HeldBlock> blocks, std::span<const std::uint32_t> chosen, const Eigen::Vector3d& origin,
                double voxel_size_m, Problem& problem) {
  for (const std::uint32_t b : chosen) {
    const HeldBlock& block = blocks[b];
    for (int i = 0; i < kBlockVoxels; ++i) {
      if (!block.entry->tsdf->IsObserved(i) || block.entry->labels->IsEmpty(i)) continue;
      problem.members.push_back({b, static_cast<std::uint16_t>(i)});
      const Eigen::Vector3d p = VoxelCentre(VoxelIn(block.index, i), voxel_size_m) - origin;
      problem.points.push_back({p.cast<float>(), block.entry->tsdf->color[static_cast<std::size_t>(i)]});
    }
  }
}

void NumberPlaces(std::span<const HeldBlock> blocks, const CrfTile& tile, int rim, Problem& problem) {
  std::vector<BlockIndex> places;
  for (const auto* list : {&tile.inner, &tile.rim}) {
    for (const std::uint32_t b : *list) {
      if (problem.place_numbers.Find(blocks[b].index) != IndexMap<BlockIndex>::kNone) continue;
      problem.place_numbers.Set(blocks[b].index, static_cast<std::uint32_t>(places.size()));
      places.push_back(blocks[b].index);
    }
  }
  problem.neighbours.resize(places.size());
  for (std::size_t p = 0; p < places.size(); ++p) {
    VisitBlocksAround(places[p], rim, [&](BlockIndex index) {
      const std::uint32_t n = problem.place_numbers.Find(index);
      if (n != IndexMap<BlockIndex>::kNone) problem.neighbours[p].push_back(n);
    });
  }
}

void AssignChannels(std::span<const HeldBlock> blocks, Problem& problem) {
  problem.classes = problem.instances = LabelChannels(problem.neighbours.size());
  std::vector<std::uint32_t> classes, instances;  // of one block
  const auto add = [](std::vector<std::uint32_t>& seen, std::uint32_t place, LabelChannels& channels) {
    std::sort(seen.begin(), seen.end());
    seen.erase(std::unique(seen.begin(), seen.end()), seen.end());
    for (const std::uint32_t label : seen) channels.Add(place, label);
    seen.clear();
  };
  for (std::size_t m = 0; m < problem.members.size(); ++m) {
    const auto& [b, linear] = problem.members[m];
    blocks[b].entry->labels->VisitClasses(linear, [&](LabelCount seen) { classes.push_back(seen.id); });
    VisitInstanceIds(blocks[b], linear, [&](LabelCount seen) { instances.push_back(seen.id); });
    if (m + 1 < problem.members.size() && problem.members[m + 1].block == b) continue;
    const std::uint32_t place = problem.place_numbers.Find(blocks[b].index);
    add(classes, place, problem.classes);
    add(instances, place, problem.instances);
  }
  problem.classes.Assign(problem.neighbours);
  problem.instances.Assign(problem.neighbours);
}

/// The unary terms of paper eq. (3): turns counts into energies, -log of their shares. What was not seen has the prior
/// alone.
void ToEnergies(std::span<float> counts) {
  float total = kPriorCount;
  for (const float count : counts) total += count;
  const float prior = kPriorCount / static_cast<float>(counts.size());
  const float unseen = -std::log(prior / total);  // most labels, at most voxels
  for (float& value : counts) value = value == 0 ? unseen : -std::log((value + prior) / total);
}

void FillUnaries(std::span<const HeldBlock> blocks, Problem& problem) {
  const auto num_classes = static_cast<std::size_t>(problem.classes.num_channels());
  const auto num_instances = static_cast<std::size_t>(problem.instances.num_channels());
  const std::size_t stride = num_classes + num_instances;
  problem.values.assign(problem.members.size() * stride, 0.0f);
  for (std::size_t p = 0; p < problem.members.size(); ++p) {
    const auto& [b, linear] = problem.members[p];
    const std::span<float> row(problem.values.data() + p * stride, stride);
    blocks[b].entry->labels->VisitClasses(
        linear, [&](LabelCount seen) { row[problem.classes.ChannelOf(seen.id)] = static_cast<float>(seen.count); });
    VisitInstanceIds(blocks[b], linear, [&](LabelCount seen) {
      row[num_classes + problem.instances.ChannelOf(seen.id)] = static_cast<float>(seen.count);
    });
    ToEnergies(row.first(num_classes));
    ToEnergies(row.last(num_instances));
  }
}

/// Blocks beyond a tile whose labels reach into it: what lies farther than 1.5 standard deviations of the wider kernel
/// has little to say against what is near. Wider rims changed nothing on a house and cost a third more.
int RimOf(const MapConfig& config) {
  const RefinementConfig& refine = config.refinement;
  const double reach_m = 1.5 * std::max(refine.smoothness.weight > 0 ? refine.smoothness.position_m : 0.0,
                                        refine.appearance.weight > 0 ? refine.appearance.position_m : 0.0);
  return std::max(1, static_cast<int>(std::ceil(reach_m / (kBlockSide * config.voxel_size_m))));
}

/// Paper eq. (2) for one voxel: the most likely label within reach of the place, if it is more likely than `present`;
/// else kKeep.
std::uint32_t BetterLabel(std::span<const float> q, const LabelChannels& channels, std::uint32_t place,
                          std::uint32_t present) {
  std::uint32_t better = Change::kKeep;
  float best = q[channels.ChannelOf(present)];
  for (std::uint32_t c = 0; c < q.size(); ++c) {
    const std::uint32_t label = channels.LabelAt(place, c);
    if (q[c] <= best || label == LabelChannels::kNone) continue;
    best = q[c];
    better = label;
  }
  return better;
}

std::vector<Change> ReadChanges(std::span<const HeldBlock> blocks, const Problem& problem) {
  std::vector<Change> changes;
  const auto num_classes = static_cast<std::size_t>(problem.classes.num_channels());
  const auto num_instances = static_cast<std::size_t>(problem.instances.num_channels());
  const std::size_t stride = num_classes + num_instances;
  for (std::size_t p = 0; p < problem.num_inner; ++p) {
    const Member& m = problem.members[p];
    const HeldBlock& block = blocks[m.block];
    const std::uint32_t place = problem.place_numbers.Find(block.index);
    const std::span<const float> row(problem.values.data() + p * stride, stride);
    const std::uint32_t class_now = block.entry->labels->BestClass(m.linear).id;
    const std::uint32_t instance_seen = block.entry->labels->BestInstance(m.linear).id;
    const std::uint32_t instance_now = instance_seen == 0 ? block.holder.value : instance_seen;
    const Change change{.member = m,
                        .class_id = BetterLabel(row.first(num_classes), problem.classes, place, class_now),
                        .instance = BetterLabel(row.last(num_instances), problem.instances, place, instance_now)};
    if (change.class_id != Change::kKeep || change.instance != Change::kKeep) changes.push_back(change);
  }
  return changes;
}

void Apply(const Change& change, SubmapId holder, LabelBlock& labels) {
  const int linear = change.member.linear;
  LabelHistograms histograms = labels.Get(linear);
  if (change.class_id != Change::kKeep) {
    ExchangeCounts(labels.BestClass(linear).id, change.class_id, histograms.classes);
  }
  if (change.instance != Change::kKeep) {
    const std::uint32_t to = change.instance == holder.value ? 0 : change.instance;
    ExchangeCounts(labels.BestInstance(linear).id, to, histograms.instances);
  }
  labels.Set(linear, histograms);
}

}  // namespace

LabelCrfReport RefineLabels(std::span<const SubmapId> ids, Map& map, ThreadPool& pool,
                            const MapSnapshot* refined_before, const std::function<bool()>& is_cancelled) {
  const MapConfig& config = map.info().config;
  const std::vector<HeldBlock> blocks = CollectBlocks(ids, map);
  const int rim = RimOf(config);
  std::vector<CrfTile> tiles = CutTiles(blocks, kCrfTileSide, rim, pool);
  if (refined_before != nullptr) DropUnchanged(blocks, *refined_before, tiles);
  LabelCrfReport report{.num_tiles = static_cast<int>(tiles.size())};
  std::vector<std::vector<Change>> changes(tiles.size());
  std::vector<std::int64_t> num_voxels(tiles.size(), 0);
  pool.ParallelFor(tiles.size(), [&](std::size_t t) {
    if (is_cancelled && is_cancelled()) return;
    Problem problem;
    const Eigen::Vector3d origin = BlockCorner(blocks[tiles[t].inner.front()].index, config.voxel_size_m);
    AddMembers(blocks, tiles[t].inner, origin, config.voxel_size_m, problem);
    problem.num_inner = problem.members.size();
    AddMembers(blocks, tiles[t].rim, origin, config.voxel_size_m, problem);
    NumberPlaces(blocks, tiles[t], rim, problem);
    AssignChannels(blocks, problem);
    FillUnaries(blocks, problem);
    ThreadPool here(1);
    DenseCrf crf(here);
    crf.SetPoints(problem.points, config.refinement.smoothness, config.refinement.appearance);
    const int num_channels[] = {problem.classes.num_channels(), problem.instances.num_channels()};
    crf.Infer(num_channels, config.refinement.crf_iterations, problem.values);
    changes[t] = ReadChanges(blocks, problem);
    num_voxels[t] = static_cast<std::int64_t>(problem.num_inner);
  });

  // Tiles are disjoint, and so are their changes.
  std::vector<Change> all;
  for (std::size_t t = 0; t < tiles.size(); ++t) {
    all.insert(all.end(), changes[t].begin(), changes[t].end());
    report.num_voxels += num_voxels[t];
  }
  for (const Change& change : all) {
    report.num_changed_classes += change.class_id != Change::kKeep;
    report.num_changed_instances += change.instance != Change::kKeep;
  }
  std::sort(all.begin(), all.end(), [](const Change& a, const Change& b) { return a.member.block < b.member.block; });
  std::vector<std::pair<BlockIndex, SubmapId>> homes;  // the list of blocks dangles once the map is written
  homes.reserve(all.size());
  for (const Change& change : all)
    homes.emplace_back(blocks[change.member.block].index, blocks[change.member.block].holder);
  for (std::size_t i = 0; i < all.size(); ++i) {
    const auto& [index, holder] = homes[i];
    Apply(all[i], holder, map.FindMutable(holder)->MutableLabels(index));
  }
  MoveForeignVoxels(ids, map, pool);
  return report;
}

}  // namespace dhpmap

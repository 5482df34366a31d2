// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/refinement/label_crf.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <utility>
#include <vector>

#include "mapping/base/index_map.h"
#include "mapping/refinement/bounded_loop.h"
#include "mapping/refinement/crf_tiles.h"
#include "mapping/refinement/dense_crf.h"
#include "mapping/refinement/label_channels.h"
#include "mapping/refinement/label_management.h"
#include "mapping/refinement/submap_labels.h"
#include "mapping/refinement/voxel_merge.h"

namespace dhpmap {
namespace {

constexpr int kCrfTileSide = 8;  // blocks; with 12 PQ is the same within 0.004, and twice the memory
/// Of tiles under way. Some 80 voxels a block and 0.5 kB a voxel make 50 MB of it, on machines of many cores more. The
/// sample apartment's largest tile has 1,178 blocks.
constexpr std::size_t kMostBlocksAtOnce = 1400, kMostBlocksAThread = 500;
/// Observations that a label is given which a voxel has not seen. Of .03 to .5 all are within a thousandth on the house
/// and two KITTI excerpts, and this is not below any on two apartments.
constexpr float kPriorCount = 0.2f;

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

// The two kinds of labels of a voxel: its counts, and the label it has now.
struct Classes {
  template <typename Visitor>
  static void Visit(const HeldBlock& block, int linear, Visitor&& visit) {
    block.entry->labels->VisitClasses(linear, visit);
  }
  static std::uint32_t Present(const HeldBlock& block, int linear) { return block.entry->labels->BestClass(linear).id; }
};
struct Instances {
  template <typename Visitor>
  static void Visit(const HeldBlock& block, int linear, Visitor&& visit) {
    block.entry->labels->VisitInstances(linear, [&](LabelCount seen) {
      visit(LabelCount{seen.id == 0 ? block.holder.value : seen.id, seen.count});
    });
  }
  static std::uint32_t Present(const HeldBlock& block, int linear) {
    const std::uint32_t seen = block.entry->labels->BestInstance(linear).id;
    return seen == 0 ? block.holder.value : seen;
  }
};

void AddMembers(std::span<const HeldBlock> blocks, std::span<const std::uint32_t> chosen, const Eigen::Vector3d& origin,
                double voxel_size_m, Problem& problem) {
  for (const std::uint32_t b : chosen) {
    const HeldBlock& block = blocks[b];
    for (int i = 0; i < kBlockVoxels; ++i) {
      if (!block.entry->Shows(i) || block.entry->labels->IsEmpty(i)) continue;
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
    Classes::Visit(blocks[b], linear, [&](LabelCount seen) { classes.push_back(seen.id); });
    Instances::Visit(blocks[b], linear, [&](LabelCount seen) { instances.push_back(seen.id); });
    if (m + 1 < problem.members.size() && problem.members[m + 1].block == b) continue;
    const std::uint32_t place = problem.place_numbers.Find(blocks[b].index);
    add(classes, place, problem.classes);
    add(instances, place, problem.instances);
  }
  problem.classes.Assign(problem.neighbours);
  problem.instances.Assign(problem.neighbours);
}

/// The unary term of paper eq. (3): -log of a label's share of the counts, but for a constant a voxel.
float EnergyOf(std::uint32_t count) { return -std::log1p(static_cast<float>(count) / kPriorCount); }

/// Labels that do not occur within reach of a voxel are impossible there, so that a crowd elsewhere in the tile says
/// nothing about it; one that does, and that it has not seen, has the prior alone.
template <typename Kind>
void FillUnaries(std::span<const HeldBlock> blocks, const LabelChannels& channels, Problem& problem) {
  const auto num_channels = static_cast<std::size_t>(channels.num_channels());
  problem.values.assign(problem.members.size() * num_channels, 0.0f);
  for (std::size_t p = 0; p < problem.members.size(); ++p) {
    const auto& [b, linear] = problem.members[p];
    const std::uint32_t place = problem.place_numbers.Find(blocks[b].index);
    const std::span<float> row(problem.values.data() + p * num_channels, num_channels);
    for (std::uint32_t c = 0; c < num_channels; ++c) {
      if (channels.LabelAt(place, c) == LabelChannels::kNone) row[c] = std::numeric_limits<float>::infinity();
    }
    Kind::Visit(blocks[b], linear, [&](LabelCount seen) { row[channels.ChannelOf(seen.id)] = EnergyOf(seen.count); });
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

/// The label that each inner voxel should have instead of its present one, or kKeep. Kinds do not influence each other;
/// one after the other they take half the memory.
template <typename Kind>
std::vector<std::uint32_t> BetterLabels(std::span<const HeldBlock> blocks, const LabelChannels& channels,
                                        int iterations, DenseCrf& crf, Problem& problem) {
  FillUnaries<Kind>(blocks, channels, problem);
  const int num_channels[] = {channels.num_channels()};
  crf.Infer(num_channels, iterations, problem.values);
  const auto stride = static_cast<std::size_t>(channels.num_channels());
  std::vector<std::uint32_t> better(problem.num_inner);
  for (std::size_t p = 0; p < problem.num_inner; ++p) {
    const auto& [b, linear] = problem.members[p];
    const std::span<const float> q(problem.values.data() + p * stride, stride);
    const std::uint32_t place = problem.place_numbers.Find(blocks[b].index);
    better[p] = BetterLabel(q, channels, place, Kind::Present(blocks[b], linear));
  }
  return better;
}

struct TileOutcome {
  std::vector<Change> changes;
  std::int64_t num_voxels = 0;  // without the rim
};

TileOutcome SolveTile(std::span<const HeldBlock> blocks, const CrfTile& tile, int rim, const MapConfig& config) {
  Problem problem;
  const Eigen::Vector3d origin = BlockCorner(blocks[tile.inner.front()].index, config.voxel_size_m);
  AddMembers(blocks, tile.inner, origin, config.voxel_size_m, problem);
  problem.num_inner = problem.members.size();
  AddMembers(blocks, tile.rim, origin, config.voxel_size_m, problem);
  NumberPlaces(blocks, tile, rim, problem);
  AssignChannels(blocks, problem);
  ThreadPool here(1);
  DenseCrf crf(here);
  crf.SetPoints(std::exchange(problem.points, {}), config.refinement.smoothness, config.refinement.appearance);
  const int iterations = config.refinement.crf_iterations;
  const auto classes = BetterLabels<Classes>(blocks, problem.classes, iterations, crf, problem);
  const auto instances = BetterLabels<Instances>(blocks, problem.instances, iterations, crf, problem);
  TileOutcome outcome{.changes = {}, .num_voxels = static_cast<std::int64_t>(problem.num_inner)};
  for (std::size_t p = 0; p < problem.num_inner; ++p) {
    if (classes[p] == Change::kKeep && instances[p] == Change::kKeep) continue;
    outcome.changes.push_back({.member = problem.members[p], .class_id = classes[p], .instance = instances[p]});
  }
  return outcome;
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

LabelCrfReport RefineLabels(std::span<const SubmapId> ids, Map& map, ThreadPool& pool, const StateMarks* refined_before,
                            const std::function<bool()>& is_cancelled) {
  const MapConfig& config = map.info().config;
  const std::vector<HeldBlock> blocks = CollectBlocks(ids, map);
  const int rim = RimOf(config);
  std::vector<CrfTile> tiles = CutTiles(blocks, kCrfTileSide, rim, pool);
  if (refined_before != nullptr) DropUnchanged(blocks, *refined_before, tiles);
  LabelCrfReport report{.num_tiles = static_cast<int>(tiles.size())};
  std::vector<TileOutcome> outcomes(tiles.size());
  std::vector<std::size_t> num_blocks;
  for (const CrfTile& tile : tiles) num_blocks.push_back(tile.inner.size() + tile.rim.size());
  const std::size_t most_at_once =
      std::max(kMostBlocksAtOnce, kMostBlocksAThread * static_cast<std::size_t>(pool.num_threads()));
  BoundedParallelFor(pool, num_blocks, most_at_once, [&](std::size_t t) {
    if (!is_cancelled || !is_cancelled()) outcomes[t] = SolveTile(blocks, tiles[t], rim, config);
  });

  // Tiles are disjoint, and so are their changes.
  std::vector<Change> all;
  for (const TileOutcome& outcome : outcomes) {
    all.insert(all.end(), outcome.changes.begin(), outcome.changes.end());
    report.num_voxels += outcome.num_voxels;
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
  std::set<SubmapId> changed;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const auto& [index, holder] = homes[i];
    Apply(all[i], holder, map.FindMutable(holder)->MutableLabels(index));
    changed.insert(holder);
  }
  for (const SubmapId id : changed) RecomputeSubmapLabels(*map.FindMutable(id));
  MoveForeignVoxels(ids, map, pool);
  return report;
}

}  // namespace dhpmap

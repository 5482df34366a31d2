// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/refinement/label_crf.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>
#include <vector>

#include "mapping/refinement/crf_tiles.h"
#include "mapping/refinement/dense_crf.h"
#include "mapping/refinement/label_management.h"
#include "mapping/refinement/scratch_loop.h"
#include "mapping/refinement/voxel_merge.h"

namespace dhpmap {
namespace {

constexpr int kCrfTileSide = 12;     // blocks; of 8 the same time, and 0.4 points of PQ less in an apartment
constexpr float kPriorCount = 1;  // observations that an unobserved voxel is given, spread over all labels

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

/// The labels of one kind that occur in a tile, by ascending id.
class LabelList {
 public:
  void Add(std::uint32_t id) { ids_.push_back(id); }
  void Close() {
    std::sort(ids_.begin(), ids_.end());
    ids_.erase(std::unique(ids_.begin(), ids_.end()), ids_.end());
  }
  void Clear() { ids_.clear(); }
  [[nodiscard]] int size() const { return static_cast<int>(ids_.size()); }
  [[nodiscard]] std::uint32_t id(int i) const { return ids_[static_cast<std::size_t>(i)]; }
  [[nodiscard]] std::size_t IndexOf(std::uint32_t id) const {
    return static_cast<std::size_t>(std::lower_bound(ids_.begin(), ids_.end(), id) - ids_.begin());
  }

 private:
  std::vector<std::uint32_t> ids_;
};

/// One tile as a CRF problem.
struct Problem {
  std::vector<Member> members;
  std::size_t num_inner = 0;  // the first members; the others are the rim
  std::vector<CrfPoint> points;
  LabelList classes, instances;
  std::vector<float> values;

  void Clear() {
    members.clear();
    points.clear();
    classes.Clear();
    instances.Clear();
  }
};

/// What one thread works with, tile after tile: taking tens of megabytes anew for each costs as much as the filtering.
struct Workbench {
  std::unique_ptr<ThreadPool> here = std::make_unique<ThreadPool>(1);
  DenseCrf crf{*here};
  Problem problem;
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

void FillUnaries(std::span<const HeldBlock> blocks, Problem& problem) {
  for (const Member& m : problem.members) {
    blocks[m.block].entry->labels->VisitClasses(m.linear, [&](LabelCount seen) { problem.classes.Add(seen.id); });
    VisitInstanceIds(blocks[m.block], m.linear, [&](LabelCount seen) { problem.instances.Add(seen.id); });
    if (problem.classes.size() > 1 << 16) problem.classes.Close();
    if (problem.instances.size() > 1 << 16) problem.instances.Close();
  }
  problem.classes.Close();
  problem.instances.Close();
  const auto num_classes = static_cast<std::size_t>(problem.classes.size());
  const auto num_instances = static_cast<std::size_t>(problem.instances.size());
  const std::size_t stride = num_classes + num_instances;
  problem.values.assign(problem.members.size() * stride, 0.0f);
  for (std::size_t p = 0; p < problem.members.size(); ++p) {
    const Member& m = problem.members[p];
    float* row = problem.values.data() + p * stride;
    blocks[m.block].entry->labels->VisitClasses(
        m.linear, [&](LabelCount seen) { row[problem.classes.IndexOf(seen.id)] = static_cast<float>(seen.count); });
    VisitInstanceIds(blocks[m.block], m.linear, [&](LabelCount seen) {
      row[num_classes + problem.instances.IndexOf(seen.id)] = static_cast<float>(seen.count);
    });
    const auto to_energies = [](float* begin, std::size_t count) {
      float total = kPriorCount;
      for (std::size_t i = 0; i < count; ++i) total += begin[i];
      const float prior = kPriorCount / static_cast<float>(count);
      for (std::size_t i = 0; i < count; ++i) begin[i] = -std::log((begin[i] + prior) / total);
    };
    to_energies(row, num_classes);
    to_energies(row + num_classes, num_instances);
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

std::size_t Best(std::span<const float> q) {
  return static_cast<std::size_t>(std::max_element(q.begin(), q.end()) - q.begin());
}

std::vector<Change> ReadChanges(std::span<const HeldBlock> blocks, const Problem& problem) {
  std::vector<Change> changes;
  const auto num_classes = static_cast<std::size_t>(problem.classes.size());
  const auto num_instances = static_cast<std::size_t>(problem.instances.size());
  for (std::size_t p = 0; p < problem.num_inner; ++p) {
    const Member& m = problem.members[p];
    const HeldBlock& block = blocks[m.block];
    const std::span<const float> row(problem.values.data() + p * (num_classes + num_instances),
                                     num_classes + num_instances);
    const auto class_q = row.first(num_classes);
    const auto instance_q = row.last(num_instances);
    Change change{.member = m};
    const std::uint32_t class_now = block.entry->labels->BestClass(m.linear).id;
    const std::size_t best_class = Best(class_q);
    if (class_q[best_class] > class_q[problem.classes.IndexOf(class_now)]) {
      change.class_id = problem.classes.id(static_cast<int>(best_class));
    }
    const std::uint32_t instance_seen = block.entry->labels->BestInstance(m.linear).id;
    const std::uint32_t instance_now = instance_seen == 0 ? block.holder.value : instance_seen;
    const std::size_t best_instance = Best(instance_q);
    if (instance_q[best_instance] > instance_q[problem.instances.IndexOf(instance_now)]) {
      change.instance = problem.instances.id(static_cast<int>(best_instance));
    }
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
  std::vector<CrfTile> tiles = CutTiles(blocks, kCrfTileSide, RimOf(config), pool);
  if (refined_before != nullptr) DropUnchanged(blocks, *refined_before, tiles);
  LabelCrfReport report{.num_tiles = static_cast<int>(tiles.size())};
  std::vector<std::vector<Change>> changes(tiles.size());
  std::vector<std::int64_t> num_voxels(tiles.size(), 0);
  std::vector<Workbench> benches;
  ParallelForWithScratch(pool, tiles.size(), benches, [&](std::size_t t, Workbench& bench) {
    if (is_cancelled && is_cancelled()) return;
    Problem& problem = bench.problem;
    problem.Clear();
    const Eigen::Vector3d origin = BlockCorner(blocks[tiles[t].inner.front()].index, config.voxel_size_m);
    AddMembers(blocks, tiles[t].inner, origin, config.voxel_size_m, problem);
    problem.num_inner = problem.members.size();
    AddMembers(blocks, tiles[t].rim, origin, config.voxel_size_m, problem);
    FillUnaries(blocks, problem);
    bench.crf.SetPoints(problem.points, config.refinement.smoothness, config.refinement.appearance);
    const int num_labels[] = {problem.classes.size(), problem.instances.size()};
    bench.crf.Infer(num_labels, config.refinement.crf_iterations, problem.values);
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

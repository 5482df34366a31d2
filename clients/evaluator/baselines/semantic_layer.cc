// SPDX-License-Identifier: BSD-3-Clause
#include "clients/evaluator/baselines/semantic_layer.h"

#include <algorithm>
#include <cmath>

namespace dhpmap::evaluator {
namespace {

/// The position of `class_id` in a list sorted by class, or where to insert it.
template <typename List>
auto LowerBound(List& list, ClassId class_id) {
  return std::lower_bound(list.begin(), list.end(), class_id,
                          [](const auto& element, ClassId wanted) { return element.class_id < wanted; });
}

template <typename Blocks>
auto& MutableCell(Blocks& blocks, VoxelIndex voxel) {
  auto& block = blocks[BlockOf(voxel)];
  if (block.empty()) block.resize(kBlockVoxels);
  return block[static_cast<std::size_t>(LinearIndex(voxel))];
}

template <typename Blocks>
auto FindCell(const Blocks& blocks, VoxelIndex voxel) -> const typename Blocks::mapped_type::value_type* {
  const auto it = blocks.find(BlockOf(voxel));
  return it == blocks.end() ? nullptr : &it->second[static_cast<std::size_t>(LinearIndex(voxel))];
}

}  // namespace

BayesianLayer::BayesianLayer(double measurement_probability)
    : log_hit_(std::log(measurement_probability)), log_miss_(std::log(1.0 - measurement_probability)) {}

void BayesianLayer::Observe(VoxelIndex voxel, std::span<const LabelFrequency> labels) {
  if (labels.empty()) return;
  Cell& cell = MutableCell(blocks_, voxel);
  double num_points = 0;
  for (const LabelFrequency& label : labels) {
    num_points += label.num_points;
    const auto it = LowerBound(cell.seen, label.class_id);
    if (it == cell.seen.end() || it->class_id != label.class_id) {
      cell.seen.insert(it, {label.class_id, cell.unseen_log_probability});
    }
  }
  cell.unseen_log_probability += num_points * log_miss_;
  for (SeenClass& seen : cell.seen) {
    const auto it = std::find_if(labels.begin(), labels.end(),
                                 [&seen](const LabelFrequency& label) { return label.class_id == seen.class_id; });
    const double num_hits = it == labels.end() ? 0.0 : it->num_points;
    seen.log_probability += num_hits * log_hit_ + (num_points - num_hits) * log_miss_;
  }
}

std::optional<ClassId> BayesianLayer::LabelAt(VoxelIndex voxel) const {
  const Cell* cell = FindCell(blocks_, voxel);
  if (cell == nullptr || cell->seen.empty()) return std::nullopt;
  const auto best = std::max_element(cell->seen.begin(), cell->seen.end(), [](const SeenClass& a, const SeenClass& b) {
    return a.log_probability < b.log_probability;
  });
  return best->class_id;
}

double BayesianLayer::LogProbability(VoxelIndex voxel, ClassId class_id) const {
  const Cell* cell = FindCell(blocks_, voxel);
  if (cell == nullptr) return 0.0;
  const auto it = LowerBound(cell->seen, class_id);
  return it == cell->seen.end() || it->class_id != class_id ? cell->unseen_log_probability : it->log_probability;
}

void VoteLayer::Observe(VoxelIndex voxel, std::span<const LabelFrequency> labels) {
  if (labels.empty()) return;
  const ClassId choice =
      std::max_element(labels.begin(), labels.end(), [](const LabelFrequency& a, const LabelFrequency& b) {
        return a.num_points < b.num_points;
      })->class_id;
  Cell& cell = MutableCell(blocks_, voxel);
  auto it = LowerBound(cell, choice);
  if (it == cell.end() || it->class_id != choice) it = cell.insert(it, {choice, 0});
  ++it->num_rays;
}

std::optional<ClassId> VoteLayer::LabelAt(VoxelIndex voxel) const {
  const Cell* cell = FindCell(blocks_, voxel);
  if (cell == nullptr || cell->empty()) return std::nullopt;
  return std::max_element(cell->begin(), cell->end(),
                          [](const Votes& a, const Votes& b) { return a.num_rays < b.num_rays; })
      ->class_id;
}

}  // namespace dhpmap::evaluator

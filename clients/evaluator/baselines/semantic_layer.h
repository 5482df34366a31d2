// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <unordered_map>
#include <vector>

#include "mapping/base/grid.h"
#include "mapping/base/ids.h"

namespace dhpmap::evaluator {

/// How many points of a ray's bundle were predicted to be of a class.
struct LabelFrequency {
  ClassId class_id;
  std::uint32_t num_points = 0;
  constexpr bool operator==(const LabelFrequency&) const = default;
};

/// Which class each voxel of a map is, learnt from what rays through it were predicted to hit. Thread-compatible.
class SemanticLayer {
 public:
  virtual ~SemanticLayer() = default;
  /// One ray passed the voxel near the surface. `labels`: of the ray's points, each class at most once; points of
  /// unknown class are not in it, so an empty span changes nothing.
  virtual void Observe(VoxelIndex voxel, std::span<const LabelFrequency> labels) = 0;
  /// Empty: no label was ever observed there.
  [[nodiscard]] virtual std::optional<ClassId> LabelAt(VoxelIndex voxel) const = 0;
};

/// Label update of Kimera-Semantics (its section III-B): log p(class) += sum over the points' labels of the log of the
/// confusion matrix's row, ln(m) on the diagonal and ln(1 - m) off it. Never normalised; the label is the argmax, ties
/// going to the smaller class. All classes that a voxel has not seen have the same log-probability, which is kept once:
/// the number of classes costs nothing and need not be known.
class BayesianLayer final : public SemanticLayer {
 public:
  /// `measurement_probability`: m, that a prediction is right; within 0.5 and 1.
  explicit BayesianLayer(double measurement_probability);
  void Observe(VoxelIndex voxel, std::span<const LabelFrequency> labels) override;
  [[nodiscard]] std::optional<ClassId> LabelAt(VoxelIndex voxel) const override;

  /// Log-probability of a class at a voxel, not normalised; 0 for every class before the first observation.
  [[nodiscard]] double LogProbability(VoxelIndex voxel, ClassId class_id) const;

 private:
  struct SeenClass {
    ClassId class_id;
    double log_probability;
  };
  struct Cell {
    double unseen_log_probability = 0;
    std::vector<SeenClass> seen;  ///< by ascending class
  };
  using Block = std::vector<Cell>;  // kBlockVoxels of them

  double log_hit_;
  double log_miss_;
  std::unordered_map<BlockIndex, Block, BlockIndexHash> blocks_;
};

/// Majority of rays: each has one vote, for the class of most of its points. Ties go to the smaller class. (Were each
/// point to vote, the outcome would be that of BayesianLayer: with m > 0.5 the most seen class is the most probable.)
class VoteLayer final : public SemanticLayer {
 public:
  void Observe(VoxelIndex voxel, std::span<const LabelFrequency> labels) override;
  [[nodiscard]] std::optional<ClassId> LabelAt(VoxelIndex voxel) const override;

 private:
  struct Votes {
    ClassId class_id;
    std::uint32_t num_rays;
  };
  using Cell = std::vector<Votes>;  // by ascending class
  using Block = std::vector<Cell>;  // kBlockVoxels of them
  std::unordered_map<BlockIndex, Block, BlockIndexHash> blocks_;
};

}  // namespace dhpmap::evaluator

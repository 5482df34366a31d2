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

/// Number of points of a ray's bundle that were predicted to be of a class.
struct LabelFrequency {
  ClassId class_id;
  std::uint32_t num_points = 0;
  constexpr bool operator==(const LabelFrequency&) const = default;
};

/// The class of each voxel of a map, learnt from the predicted labels of rays through it. Thread-compatible.
class SemanticLayer {
 public:
  virtual ~SemanticLayer() = default;
  /// Observes one ray that passes the voxel near the surface. `labels`: of the ray's points, each class at most once;
  /// without points of unknown class, so an empty span changes nothing.
  virtual void Observe(VoxelIndex voxel, std::span<const LabelFrequency> labels) = 0;
  /// Empty if no label was observed there.
  [[nodiscard]] virtual std::optional<ClassId> LabelAt(VoxelIndex voxel) const = 0;
};

/// Label update of Kimera-Semantics (section III-B): log p(class) += the sum over the points' labels of the log of the
/// confusion matrix's row, ln(m) on the diagonal and ln(1 - m) off it. Not normalised; the label is the argmax, on ties
/// the smaller class. All classes that a voxel has not seen share one log-probability, so the number of classes need
/// not be known.
class BayesianLayer final : public SemanticLayer {
 public:
  /// `measurement_probability`: m, the probability that a prediction is right, between 0.5 and 1.
  explicit BayesianLayer(double measurement_probability);
  void Observe(VoxelIndex voxel, std::span<const LabelFrequency> labels) override;
  [[nodiscard]] std::optional<ClassId> LabelAt(VoxelIndex voxel) const override;

  /// Unnormalised log-probability of a class at a voxel; 0 for every class before the first observation.
  [[nodiscard]] double LogProbability(VoxelIndex voxel, ClassId class_id) const;

 private:
  struct SeenClass {
    ClassId class_id;
    double log_probability;
  };
  struct Cell {
    double unseen_log_probability = 0;
    std::vector<SeenClass> seen;  ///< sorted by class
  };
  using Block = std::vector<Cell>;  // kBlockVoxels cells

  double log_hit_;
  double log_miss_;
  std::unordered_map<BlockIndex, Block, BlockIndexHash> blocks_;
};

/// Majority vote of rays: each votes for the most frequent class of its points; on ties the smaller class wins. (If
/// each point had a vote, the result would equal BayesianLayer: for m > 0.5 the class seen most is the most probable.)
class VoteLayer final : public SemanticLayer {
 public:
  void Observe(VoxelIndex voxel, std::span<const LabelFrequency> labels) override;
  [[nodiscard]] std::optional<ClassId> LabelAt(VoxelIndex voxel) const override;

 private:
  struct Votes {
    ClassId class_id;
    std::uint32_t num_rays;
  };
  using Cell = std::vector<Votes>;  // sorted by class
  using Block = std::vector<Cell>;  // kBlockVoxels cells
  std::unordered_map<BlockIndex, Block, BlockIndexHash> blocks_;
};

}  // namespace dhpmap::evaluator

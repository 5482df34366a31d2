// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <unordered_map>

#include "clients/evaluator/surface_samples.h"
#include "mapping/base/grid.h"
#include "mapping/map/map_config.h"
#include "mapping/sensor/frame.h"

namespace dhpmap::evaluator {

/// The measured points with the data set's own labels: a ground truth without fusion. Reduced to one element for each
/// grid cell, so that frequently observed places have no more weight. Thread-compatible.
class TruthPoints {
 public:
  static constexpr double kCameraCell_m = 0.02, kScanCell_m = 0.1;
  /// Stride of the pixels used of a depth image, in each direction.
  static constexpr int kStep_px = 2;

  /// Ignores points outside the range that is fused.
  explicit TruthPoints(const IntegrationConfig& config)
      : min_range_m_(config.min_range_m), max_range_m_(config.max_range_m) {}

  /// Adds a frame with ground-truth labels, whose ids mean the same object in every frame. All frames must be of one
  /// kind of sensor.
  void Add(const PanopticFrame& frame);

  /// The cell size for the added kind of sensor.
  [[nodiscard]] double cell_m() const { return cell_m_; }

  /// One element for each cell, sorted: the most frequent label of its points (on ties the smaller class and instance),
  /// at their mean. Instance and class 0: unlabelled. `triangles` is empty.
  [[nodiscard]] SurfaceSamples Elements() const;

 private:
  /// Identifies the points of one cell with one label.
  struct Key {
    VoxelIndex cell;
    std::uint32_t instance;
    std::uint16_t class_id;
    bool operator==(const Key&) const = default;
  };
  struct Hash {
    std::size_t operator()(const Key& key) const;
  };
  struct Sum {
    std::uint32_t count = 0;
    Eigen::Vector3f from_corner_m = Eigen::Vector3f::Zero();
  };

  void AddPoint(const Eigen::Vector3d& p_sensor, const Transform& T_map_sensor, std::uint16_t class_id,
                std::uint32_t instance);

  double min_range_m_, max_range_m_, cell_m_ = kCameraCell_m;
  std::unordered_map<Key, Sum, Hash> sums_;
};

}  // namespace dhpmap::evaluator

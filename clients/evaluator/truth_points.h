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

/// What the sensor measured, with the data set's own labels, as a truth that no fusion has touched. It is reduced to
/// one element a cell of space, so that what was seen often counts no more than what was seen once. Thread-compatible.
class TruthPoints {
 public:
  static constexpr double kCameraCell_m = 0.02, kScanCell_m = 0.1;
  /// Of a depth image's pixels, every so many in each direction are taken.
  static constexpr int kStep_px = 2;

  /// Points outside the range that is fused are left out.
  explicit TruthPoints(const IntegrationConfig& config)
      : min_range_m_(config.min_range_m), max_range_m_(config.max_range_m) {}

  /// A frame with the ground truth's labels, whose ids mean the same object in every frame; of one kind of sensor.
  void Add(const PanopticFrame& frame);

  /// Of the kind of sensor that was added.
  [[nodiscard]] double cell_m() const { return cell_m_; }

  /// By cell, in ascending order: the label that most of its points have, the smaller class and instance of equals, at
  /// their mean. Instance and class 0: not labelled. `triangles` is empty.
  [[nodiscard]] SurfaceSamples Elements() const;

 private:
  /// What points of one cell with one label have in common.
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

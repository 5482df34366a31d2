// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <span>
#include <vector>

#include "mapping/plausibility/frame_fault.h"
#include "mapping/sensor/frame.h"

namespace dhpmap {

/// Agreement of points of a later frame with an earlier frame.
struct ViewFit {
  std::size_t num_points = 0;
  std::size_t num_agreeing = 0;  ///< the earlier frame has a surface there
  std::size_t num_before = 0;    ///< the earlier frame looks through the point
  std::size_t num_behind = 0;    ///< the earlier frame has a nearer surface, which may hide the point

  [[nodiscard]] std::size_t num_seen() const { return num_agreeing + num_before + num_behind; }
  ViewFit& operator+=(const ViewFit& other);
};

/// A coarse depth image of an earlier frame of a depth camera. Two frames of one client reveal its conventions even
/// before there is a map, or if the map was made from frames with the same mistake.
class EarlierView {
 public:
  /// Of a depth camera.
  explicit EarlierView(const PanopticFrame& frame);

  [[nodiscard]] const SensorClaim& claim() const { return claim_; }
  /// Compares points in the frame of a sensor at `T_map_sensor` with this view, as if this view had made `claim`.
  [[nodiscard]] ViewFit FitOf(std::span<const Eigen::Vector3f> points_m, const Transform& T_map_sensor,
                              const SensorClaim& claim) const;

 private:
  /// The smallest and the largest depth in and around a cell; nothing: no return.
  struct DepthRange {
    float least_m, greatest_m;
    [[nodiscard]] bool empty() const { return least_m > greatest_m; }
  };
  [[nodiscard]] DepthRange DepthAround(int column, int row) const;

  SensorClaim claim_;
  int step_px_;  ///< of the image, from cell to cell
  int num_columns_, num_rows_;
  std::vector<float> depth_m_;  ///< at the middle of each cell; 0: no return
};

}  // namespace dhpmap

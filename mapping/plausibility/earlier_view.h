// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <span>
#include <vector>

#include "mapping/plausibility/frame_fault.h"
#include "mapping/sensor/frame.h"

namespace dhpmap {

/// What an earlier frame says of points that a later one has measured.
struct ViewFit {
  std::size_t num_points = 0;
  std::size_t num_agreeing = 0;  ///< it has seen a surface there
  std::size_t num_before = 0;    ///< it has looked through there
  std::size_t num_behind = 0;    ///< it has seen something before that, which may hide it

  [[nodiscard]] std::size_t num_seen() const { return num_agreeing + num_before + num_behind; }
  ViewFit& operator+=(const ViewFit& other);
};

/// A frame of a depth camera that was there before: its depth image, made coarse. With two frames of one client the
/// conventions of both can be told, before there is a map, or where it was made from frames of the same mistake.
class EarlierView {
 public:
  /// Of a depth camera.
  explicit EarlierView(const PanopticFrame& frame);

  [[nodiscard]] const SensorClaim& claim() const { return claim_; }
  /// Of points in the frame of a sensor at `T_map_sensor`, if this view's own claim should have been `claim`.
  [[nodiscard]] ViewFit FitOf(std::span<const Eigen::Vector3f> points_m, const Transform& T_map_sensor,
                              const SensorClaim& claim) const;

 private:
  /// The least and the greatest depth in and around a cell; nothing: there is no return.
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

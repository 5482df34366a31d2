// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "clients/simulator/renderer.h"
#include "clients/simulator/seen_part.h"

namespace dhpmap::simulator {

/// Observations of an instance in one or several frames.
struct InstanceView {
  int num_pixels = 0;  ///< of the frame with most of them
  int num_frames = 0;  ///< with at least kSeen_px pixels of it
  /// Centre of the largest smooth patch of its surface in any frame (map frame), and its distance to the patch's
  /// border.
  Eigen::Vector3d point_m = Eigen::Vector3d::Zero();
  int margin_px = 0;
  SeenPart seen;  ///< over all frames

  void Join(const InstanceView& other);
};

/// Number of pixels from which an instance counts as seen in a frame, at a width of 640 px.
inline constexpr int kSeen_px = 400;

/// Indexed by instance id, with `num_instances` elements.
std::vector<InstanceView> ViewsOfInstances(const RenderedFrame& frame, std::size_t num_instances);

}  // namespace dhpmap::simulator

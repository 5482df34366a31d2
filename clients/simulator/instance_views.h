// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "clients/simulator/renderer.h"
#include "clients/simulator/seen_part.h"

namespace dhpmap::simulator {

/// What one or several frames see of an instance.
struct InstanceView {
  int num_pixels = 0;  ///< of the frame that sees most
  int num_frames = 0;  ///< that see it with at least kSeen_px
  /// Middle of the widest smooth patch of its surface in any frame, map frame; how far it is to the patch's border.
  Eigen::Vector3d point_m = Eigen::Vector3d::Zero();
  int margin_px = 0;
  SeenPart seen;  ///< of all frames

  void Join(const InstanceView& other);
};

/// An instance counts as seen in a frame from so many pixels on, at a width of 640 px.
inline constexpr int kSeen_px = 400;

/// By instance id, `num_instances` long.
std::vector<InstanceView> ViewsOfInstances(const RenderedFrame& frame, std::size_t num_instances);

}  // namespace dhpmap::simulator

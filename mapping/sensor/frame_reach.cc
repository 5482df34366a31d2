// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/sensor/frame_reach.h"

#include <string>

#include "mapping/base/grid_reach.h"

namespace dhpmap {

Status CheckFrameIsOnGrid(const PanopticFrame& frame, double voxel_size_m) {
  const std::string problem = WhyBeyondGrid(frame.T_map_sensor.translation(), voxel_size_m);
  if (problem.empty()) return Status::Ok();
  return InvalidArgument("the frame is beyond the map's grid")
      .WithReason("BAD_FRAME")
      .WithViolation("map_from_sensor", problem);
}

}  // namespace dhpmap

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "dhpmap/v1/types.pb.h"
#include "mapping/base/status.h"

namespace CLI {
class App;
}

namespace dhpmap {

/// What `edit move` and `edit clone` do to an object's pose (map_from_submap). All in the map frame, whose z is up.
struct PoseChange {
  std::vector<double> to_m, by_m;  ///< X Y Z, or empty
  std::vector<double> rotation;    ///< X Y Z W, or empty
  std::optional<double> yaw_deg;   ///< counter-clockwise as seen from above
  [[nodiscard]] bool is_given() const { return !to_m.empty() || !by_m.empty() || !rotation.empty() || yaw_deg; }
};

/// --to, --by, --rotation and --yaw, which write to `change`; it must outlive the command.
void AddPoseFlags(CLI::App& command, PoseChange& change);

/// Changes the pose of `submap`. `rotation` takes the place of the pose's, which turns the object about the origin of
/// its frame, mostly the map's, wherever the object is; `yaw_deg` turns it on the spot, about the vertical through the
/// centre of its bounding sphere. Then it is shifted. FAILED_PRECONDITION for a turn of what has no sphere, as nothing
/// of it was observed.
Status ChangePose(const PoseChange& change, v1::Submap& submap);

}  // namespace dhpmap

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

/// Changes of an object's pose (map_from_submap) by `edit move` and `edit clone`, in the map frame (z up).
struct PoseChange {
  std::vector<double> to_m, by_m;  ///< X Y Z, or empty
  std::vector<double> rotation;    ///< X Y Z W, or empty
  std::optional<double> yaw_deg;   ///< counter-clockwise seen from above
  [[nodiscard]] bool is_given() const { return !to_m.empty() || !by_m.empty() || !rotation.empty() || yaw_deg; }
};

/// Adds --to, --by, --rotation and --yaw, which write to `change`; it must outlive the command.
void AddPoseFlags(CLI::App& command, PoseChange& change);

/// Changes the pose of `submap`. `rotation` replaces the pose's rotation, so the object turns about the origin of its
/// frame, which is often the map's origin, far from the object. `yaw_deg` turns it in place, about the vertical through
/// the centre of its bounding sphere. The translation follows. FAILED_PRECONDITION for a turn without a sphere, that
/// is, without observed voxels.
Status ChangePose(const PoseChange& change, v1::Submap& submap);

}  // namespace dhpmap

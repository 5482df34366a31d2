// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "clients/simulator/apartment.h"
#include "mapping/base/result.h"

namespace dhpmap::simulator {

/// The change of one thing between two walks.
struct Change {
  std::uint8_t instance = 0;
  std::optional<Eigen::Vector3d> shift_m;  ///< moved by this vector; removed if empty
};

/// Chooses `count` things to move and as many to remove, sorted by id: free-standing things of 0.2 to 1.6 m. A moved
/// thing stands on the floor and gets another free place in its room, at least 0.7 m away and off the camera's path.
/// Deterministic for a seed. INVALID_ARGUMENT if there are too few.
Result<std::vector<Change>> ChooseChanges(const ApartmentScene& scene, int count, std::uint64_t seed);

/// The scene after the changes; instances keep their ids.
ApartmentScene Changed(const ApartmentScene& scene, const std::vector<Change>& changes);

/// changes.json: {"first_frame_after": first frame of the second walk, "changes": [{id, class, name, change ("gone" or
/// "moved"), box_m {min, max} before the change, moved_by_m if moved}]}.
std::string ChangesJson(const ApartmentScene& scene, const std::vector<Change>& changes, int first_frame_after);

}  // namespace dhpmap::simulator

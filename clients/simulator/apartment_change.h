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

/// What becomes of one thing between two walks.
struct Change {
  std::uint8_t instance = 0;
  std::optional<Eigen::Vector3d> shift_m;  ///< moved by this; taken away without
};

/// Chooses `count` things to be moved and as many to be taken away, by ascending id: what stands by itself, of 0.2 to
/// 1.6 m. What is moved stands on the floor and goes to another free place of its room, at least 0.7 m away, beside the
/// camera's path. The same for the same seed. INVALID_ARGUMENT if there are not so many.
Result<std::vector<Change>> ChooseChanges(const ApartmentScene& scene, int count, std::uint64_t seed);

/// The scene afterwards; instances keep their ids.
ApartmentScene Changed(const ApartmentScene& scene, const std::vector<Change>& changes);

/// changes.json: {"first_frame_after": the first frame of the second walk, "changes": [{id, class, name, change ("gone"
/// or "moved"), box_m {min, max} before, moved_by_m of what was moved}]}.
std::string ChangesJson(const ApartmentScene& scene, const std::vector<Change>& changes, int first_frame_after);

}  // namespace dhpmap::simulator

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "dhpmap/v1/map_service.pb.h"
#include "dhpmap/v1/mapping_service.pb.h"

namespace dhpmap::rig {

/// Frames of a corridor in which things stand, rendered once. What stands where, of which class, is different in every
/// life of the server: an object that is made again after a crash, from the same frames, is another object.
class Corridor {
 public:
  explicit Corridor(int num_places);

  [[nodiscard]] v1::Frame Frame(int life, std::int64_t sequence) const;

 private:
  int num_places_;
  std::vector<v1::Frame> frames_;  // by place, variant and view
};

/// A map for it, of small voxels, in which things settle quickly and refinement runs every few frames.
v1::CreateMapRequest CorridorMap(const std::string& map_id, const std::string& display_name);

/// Its classes of things are 1 to this.
inline constexpr int kNumThingClasses = 4;

}  // namespace dhpmap::rig

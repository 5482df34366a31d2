// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "dhpmap/options.h"

namespace dhpmap::client {

/// Occupied and free space in a height band, from above.
struct SliceOptions {
  double min_z_m = 0.1, max_z_m = 1.5;      ///< in the frame of the query
  std::optional<Box> area;                  ///< its x and y; default: all known space
  std::optional<double> resolution_m;       ///< 0.001 to 100; default: that of the voxels
  std::optional<double> min_free_fraction;  ///< for a free cell: above 0, up to 1; default 0.3
  QueryOptions query;
};

/// Cells as in nav_msgs/OccupancyGrid. A value.
struct Slice {
  static constexpr std::int8_t kFree = 0, kOccupied = 100, kUnknown = -1;

  std::int64_t revision = 0;
  int width = 0, height = 0;  ///< cells along x and y
  double resolution_m = 0;
  Vector3 origin_m;                ///< outer corner of the first cell, at the bottom of the band
  std::vector<std::int8_t> cells;  ///< x is the fastest index, from the minimum y

  /// Requires 0 <= column < width and 0 <= row < height.
  [[nodiscard]] std::int8_t at(int column, int row) const {
    return cells[static_cast<std::size_t>(row) * static_cast<std::size_t>(width) + static_cast<std::size_t>(column)];
  }
};

/// Distances at the nodes of a grid: node (i, j, k) is at origin_m + (i, j, k) * resolution_m. A value.
struct DistanceGrid {
  std::int64_t revision = 0;
  int num_x = 0, num_y = 0, num_z = 0;
  double resolution_m = 0;
  Vector3 origin_m;
  std::vector<float> distance_m;  ///< as in Distance; i is the fastest index, then j
  std::vector<bool> is_known;     ///< whether the node was observed

  /// The index of a node in the lists.
  [[nodiscard]] std::size_t node(int i, int j, int k) const {
    return static_cast<std::size_t>(i) +
           static_cast<std::size_t>(num_x) *
               (static_cast<std::size_t>(j) + static_cast<std::size_t>(num_y) * static_cast<std::size_t>(k));
  }
};

/// A spatial relation between two objects, by their observed surfaces.
struct Relation {
  enum class Kind { kOn, kIn, kNextTo };

  Kind kind = Kind::kOn;
  std::int64_t subject = 0, object = 0;  ///< ids; for kNextTo the subject is the lower one
  std::string subject_name, object_name;
  double support = 0;    ///< for kOn: the share of the subject's footprint that the object supports
  double enclosure = 0;  ///< for kIn: 0 to 1
  double gap_m = 0;      ///< between the surfaces
};

struct RelationOptions {
  std::optional<std::int64_t> of;       ///< only relations of this object
  std::vector<Relation::Kind> kinds;    ///< only these kinds; empty: all
  std::optional<double> max_gap_m;      ///< for kNextTo: above 0, up to 10; default 0.5
  std::optional<double> min_support;    ///< for kOn: above 0, up to 1; default 0.3
  std::optional<double> min_enclosure;  ///< for kIn: above 0, up to 1; default 0.65
  QueryOptions query;
};

}  // namespace dhpmap::client

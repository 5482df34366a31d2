// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <string>

#include "mapping/base/result.h"

namespace dhpmap {

// Occupancy grids in the format of nav2_map_server (mode trinary): black is occupied, white free, grey unknown. Cells
// are 0 free, 100 occupied, anything else unknown; row by row from the smallest y, x fastest. Images have the row of
// the largest y on top.

/// `cells`: width x height, both positive. PGM, binary.
std::string PgmOf(std::span<const std::int8_t> cells, int width, int height);
/// INTERNAL if the encoder fails.
Result<std::string> PngOf(std::span<const std::int8_t> cells, int width, int height);

/// The YAML file that goes with such an image. `image`: its path, absolute or from the YAML's folder, without control
/// characters; `min_m`: the outer corner of the lower left cell.
std::string MapYaml(const std::string& image, double resolution_m, const Eigen::Vector2d& min_m);

}  // namespace dhpmap

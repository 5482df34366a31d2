// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <nlohmann/json.hpp>

namespace dhpmap::simulator {

/// The coordinates as a list, rounded to 0.1 mm, so that files are short and equal on all machines.
inline nlohmann::ordered_json RoundedPoint(const Eigen::Vector3d& p_m) {
  nlohmann::ordered_json json = nlohmann::ordered_json::array();
  for (int i = 0; i < 3; ++i) json.push_back(std::round(p_m[i] * 1e4) / 1e4);
  return json;
}

}  // namespace dhpmap::simulator

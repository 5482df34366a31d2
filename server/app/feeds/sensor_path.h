// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "mapping/base/transform.h"

namespace dhpmap {

/// Where a sensor has been, coarser the longer the way: takes no memory beyond itself, and never throws.
/// Thread-compatible.
class SensorPath {
 public:
  static constexpr std::size_t kMostPlaces = 128;

  void Add(const Transform& T_map_sensor) noexcept;

  /// In the map frame, metres, oldest first; the last place is the newest one, however near to the one before.
  [[nodiscard]] std::span<const Eigen::Vector3f> places_m() const { return {places_m_.data(), num_places_}; }
  /// Meaningless before the first.
  [[nodiscard]] const Transform& T_map_sensor() const { return T_map_sensor_; }

 private:
  void Thin() noexcept;

  Transform T_map_sensor_ = Transform::Identity();
  std::array<Eigen::Vector3f, kMostPlaces> places_m_{};
  std::size_t num_places_ = 0;
  bool is_last_kept_ = true;  ///< the last place is far enough from the one before to stay
  float spacing_m_ = 0.05f;
};

}  // namespace dhpmap

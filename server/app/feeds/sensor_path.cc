// SPDX-License-Identifier: BSD-3-Clause
#include "server/app/feeds/sensor_path.h"

namespace dhpmap {

void SensorPath::Add(const Transform& T_map_sensor) noexcept {
  T_map_sensor_ = T_map_sensor;
  const Eigen::Vector3f place_m = T_map_sensor.translation().cast<float>();
  if (num_places_ > 0 && !is_last_kept_) --num_places_;
  if (num_places_ == kMostPlaces) Thin();
  is_last_kept_ = num_places_ == 0 || (place_m - places_m_[num_places_ - 1]).norm() >= spacing_m_;
  places_m_[num_places_++] = place_m;
}

/// Keeps every second place, including the first.
void SensorPath::Thin() noexcept {
  std::size_t num_left = 0;
  for (std::size_t i = 0; i < num_places_; i += 2) places_m_[num_left++] = places_m_[i];
  num_places_ = num_left;
  spacing_m_ *= 2;
}

}  // namespace dhpmap

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

#include "clients/simulator/apartment.h"
#include "clients/simulator/distance_grid.h"
#include "clients/simulator/material.h"

namespace dhpmap::simulator {

struct Rgb {
  std::uint8_t r = 0, g = 0, b = 0;
  bool operator==(const Rgb&) const = default;
};

/// Camera response: bright light saturates softly.
Rgb Develop(const Light& light);

/// Colours what rays hit: every room is lit by its ceiling lamp and its windows, with soft shadows, and gets darker in
/// corners. What a point looks like depends on the view only by faint highlights. Immutable, so thread-safe.
class Shader {
 public:
  explicit Shader(const ApartmentScene& scene);
  /// `ray` met the scene at `hit`; `footprint_m` is the size of a pixel there.
  [[nodiscard]] Light Shade(const Ray& ray, const ApartmentScene::Hit& hit, double footprint_m) const;

 private:
  struct Source {
    Eigen::Vector3f position_m;
    Eigen::Vector3f facing;  ///< zero: shines all around
    Light light;
    float softness;  ///< larger = harder shadows
  };

  struct Point {
    Eigen::Vector3f p, n, to_eye;
  };

  [[nodiscard]] float Openness(const Point& at) const;
  [[nodiscard]] float Visibility(const Point& at, const Source& source) const;
  [[nodiscard]] Light FromSource(const Point& at, const Source& source) const;
  [[nodiscard]] Light FromRooms(const Point& at) const;

  const ApartmentScene& scene_;
  DistanceGrid grid_;
  std::vector<std::vector<Source>> sources_;  ///< by room
};

}  // namespace dhpmap::simulator

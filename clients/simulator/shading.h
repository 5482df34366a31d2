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

/// Camera response: bright light saturates smoothly.
Rgb Develop(const Light& light);

/// A surface point and the direction to the viewer; map frame, unit vectors.
struct LitPoint {
  Eigen::Vector3f p_m, normal, to_eye;
};

/// Illuminates the apartment: each room by its ceiling lamp and windows, with soft shadows and darker corners. Only
/// faint highlights depend on the view. Immutable, so thread-safe.
class Shader {
 public:
  explicit Shader(const ApartmentScene& scene);
  /// Incoming light at a point: smooth except at edges, and by far the most expensive part of a picture.
  [[nodiscard]] Light Illumination(const LitPoint& at) const;
  /// Outgoing light of a point with this illumination; `footprint_m` is the size of a pixel there.
  [[nodiscard]] Light Reflection(const SurfacePoint& at, const Light& illumination) const;

 private:
  struct Source {
    Eigen::Vector3f position_m;
    Eigen::Vector3f facing;  ///< zero: emits in all directions
    Light light;
    float softness;  ///< larger values give harder shadows
  };

  [[nodiscard]] float Openness(const LitPoint& at) const;
  [[nodiscard]] float Visibility(const LitPoint& at, const Source& source) const;
  [[nodiscard]] Light FromSource(const LitPoint& at, const Source& source) const;
  [[nodiscard]] Light FromRooms(const LitPoint& at) const;

  const ApartmentScene& scene_;
  DistanceGrid grid_;
  std::vector<std::vector<Source>> sources_;  ///< by room
};

}  // namespace dhpmap::simulator

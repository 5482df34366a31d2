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

/// A point of a surface and who looks at it; map frame, unit vectors.
struct LitPoint {
  Eigen::Vector3f p_m, normal, to_eye;
};

/// Lights the apartment: every room by its ceiling lamp and its windows, with soft shadows, darker in corners. What a
/// point looks like depends on the view only by faint highlights. Immutable, so thread-safe.
class Shader {
 public:
  explicit Shader(const ApartmentScene& scene);
  /// Light that falls on a point: smooth but for edges, and by far the dearest part of a picture.
  [[nodiscard]] Light Illumination(const LitPoint& at) const;
  /// Light that comes from a point so lit; `footprint_m` is the size of a pixel there.
  [[nodiscard]] Light Reflection(const SurfacePoint& at, const Light& illumination) const;

 private:
  struct Source {
    Eigen::Vector3f position_m;
    Eigen::Vector3f facing;  ///< zero: shines all around
    Light light;
    float softness;  ///< larger = harder shadows
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

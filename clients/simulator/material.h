// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "clients/simulator/solid.h"

namespace dhpmap::simulator {

/// Linear red, green, blue; 1: white paper.
using Light = Eigen::Vector3f;

/// Linear light of an sRGB colour 0xRRGGBB.
Light FromHex(std::uint32_t rgb);

/// The appearance of a surface, computed from the position on its solid.
struct Material {
  enum class Pattern : std::uint8_t {
    kPlain,
    kWood,       ///< grain along the longest side
    kPlanks,     ///< floor boards, `scale_m` wide
    kTiles,      ///< tiles of `scale_m` with grout in the second colour
    kChecker,    ///< squares of `scale_m`
    kStripes,    ///< `scale_m` each
    kRings,      ///< around the centre
    kWeave,      ///< cloth
    kMarble,     ///< veins in the second colour
    kSpeckles,   ///< spots of the second colour
    kLandscape,  ///< a painting, different for each look_seed
    kSky,        ///< the view through a window
  };
  Pattern pattern = Pattern::kPlain;
  std::uint32_t first = 0xffffff;   ///< 0xRRGGBB
  std::uint32_t second = 0xffffff;  ///< 0xRRGGBB
  double scale_m = 0.1;
  double glow = 0;  ///< emitted light, as a multiple of the colour

  bool operator==(const Material&) const = default;
};

/// The point at which a material is evaluated.
struct SurfacePoint {
  const Solid& solid;
  Eigen::Vector3d p_map;
  Eigen::Vector3d normal;  ///< unit, map frame
  double footprint_m;      ///< size of a pixel there: finer detail fades out, to prevent flicker
};

/// Colour of the surface under white light.
Light Albedo(const Material& material, const SurfacePoint& at);

}  // namespace dhpmap::simulator

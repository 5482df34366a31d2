// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "clients/simulator/apartment.h"
#include "clients/simulator/rendered_frame.h"
#include "clients/simulator/shading.h"
#include "mapping/base/transform.h"
#include "mapping/sensor/pinhole_camera.h"

namespace dhpmap::simulator {

/// The flat layout's camera, 90 degrees wide: 640 x 480, scaled with the width.
PinholeCamera FlatLayoutCamera(int width_px, int height_px);

/// Renders depth and instances with one ray per pixel, and colour with more rays at edges. Immutable, so thread-safe;
/// rendering uses only the calling thread. The scene must outlive it.
class Renderer {
 public:
  enum class Output { kGeometry, kGeometryAndColor };

  explicit Renderer(const ApartmentScene& scene, Output output = Output::kGeometryAndColor);
  /// `camera` must be usable (PinholeCamera::Validate).
  [[nodiscard]] RenderedFrame Render(const PinholeCamera& camera, const Transform& T_map_camera) const;

 private:
  const ApartmentScene& scene_;
  std::optional<Shader> shader_;  ///< empty for kGeometry
};

}  // namespace dhpmap::simulator

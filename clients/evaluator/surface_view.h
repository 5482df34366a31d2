// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <functional>
#include <vector>

#include "clients/evaluator/picture.h"
#include "mapping/mesh/mesh.h"

namespace dhpmap::evaluator {

/// Whether triangles are seen from behind, too. From the front alone, who looks from outside sees into a room: ceilings
/// and the near walls were only seen, and so only have surfaces, from within.
enum class Sides { kFront, kBoth };

/// A mesh from afar, without perspective: which triangle shows at each pixel, and how brightly. Found once, and then
/// painted in as many colours as one likes. Immutable.
class SurfaceView {
 public:
  /// Looks along -z of the view, y up; the longer side of the picture has so many pixels.
  SurfaceView(const Mesh& mesh, const Eigen::Matrix3f& R_view_map, Sides sides, int long_side_px);

  /// With the colour of each triangle, lit, on white; edges are smooth.
  [[nodiscard]] Picture Paint(const std::function<Color(std::uint32_t triangle)>& color_of) const;

 private:
  static constexpr int kFiner = 2;  ///< so many times in each direction, then averaged
  static constexpr std::uint32_t kNothing = 0xffffffff;
  struct Pixel {
    float nearness_m;
    float light;
    std::uint32_t triangle;
  };
  [[nodiscard]] Pixel& at(int x, int y) {
    return pixels_[static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x)];
  }
  [[nodiscard]] const Pixel& at(int x, int y) const {
    return pixels_[static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x)];
  }
  /// `corners` in pixels, z in metres towards the viewer.
  void Draw(std::uint32_t triangle, const Eigen::Matrix3f& corners, const Eigen::Matrix3f& normals);
  /// Darkens what lies behind an edge, so that shapes stand out.
  void ShadeEdges();

  int width_ = 0, height_ = 0;
  std::vector<Pixel> pixels_;
};

}  // namespace dhpmap::evaluator

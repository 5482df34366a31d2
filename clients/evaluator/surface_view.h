// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <functional>
#include <vector>

#include "clients/evaluator/picture.h"
#include "mapping/mesh/mesh.h"

namespace dhpmap::evaluator {

/// Whether triangles are visible from behind. With kFront a view from outside looks into rooms: ceilings and near walls
/// have surfaces only towards the inside, where they were observed.
enum class Sides { kFront, kBoth };

/// An orthographic view of a mesh: the visible triangle and its brightness at each pixel. Computed once, and painted
/// with any colours. Immutable.
class SurfaceView {
 public:
  /// Looks along -z of the view, y up; `long_side_px`: longer side of the picture.
  SurfaceView(const Mesh& mesh, const Eigen::Matrix3f& R_view_map, Sides sides, int long_side_px);

  /// Paints each triangle in its colour, shaded, on white, with antialiasing.
  [[nodiscard]] Picture Paint(const std::function<Color(std::uint32_t triangle)>& color_of) const;

 private:
  static constexpr int kFiner = 2;  ///< supersampling in each direction
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
  /// `corners`: x and y in pixels, z in metres towards the viewer.
  void Draw(std::uint32_t triangle, const Eigen::Matrix3f& corners, const Eigen::Matrix3f& normals);
  /// Darkens pixels behind edges, to emphasise shapes.
  void ShadeEdges();

  int width_ = 0, height_ = 0;
  std::vector<Pixel> pixels_;
};

}  // namespace dhpmap::evaluator

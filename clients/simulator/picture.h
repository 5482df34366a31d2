// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "clients/simulator/beam_grid.h"
#include "clients/simulator/rendered_frame.h"

namespace dhpmap::simulator {

/// The ray through a pixel.
Ray PixelRay(const RenderedFrame& frame, double u_px, double v_px);

/// Colours one frame. Illumination is computed at every fourth pixel and interpolated within smooth faces; pixels at
/// edges average four samples. For one use in one thread.
class Picture {
 public:
  /// `hits`: what each pixel of the frame sees. All arguments must outlive the picture.
  Picture(const Shader& shader, const RenderedFrame& frame, const BeamGrid& beams,
          const std::vector<BoundingTree::Hit>& hits);
  std::vector<Rgb> Colors();

 private:
  struct Pixel {
    const Solid* solid = nullptr;  ///< null: nothing is seen
    Eigen::Vector3f normal = Eigen::Vector3f::Zero();
    Light illumination = Light::Zero();
    Light light = Light::Zero();  ///< light that reaches the camera
    /// Whether both are on one smooth face, so that illumination can be shared.
    [[nodiscard]] bool IsAlike(const Pixel& other) const {
      return solid == other.solid && normal.dot(other.normal) > 0.93f;
    }
  };

  [[nodiscard]] Pixel& At(int u, int v) {
    return pixels_[static_cast<std::size_t>(v) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(u)];
  }
  [[nodiscard]] Light Illuminate(const Ray& ray, double distance_m, const Pixel& pixel) const;
  [[nodiscard]] Light Reflect(const Ray& ray, double distance_m, const Pixel& pixel) const;
  void IlluminateAll();
  void IlluminateCell(int u0, int v0);
  enum class Edge { kNone, kOfPattern, kOfFaces };
  [[nodiscard]] Edge EdgeAt(int u, int v);
  [[nodiscard]] Light Smoothed(int u, int v, Edge edge);
  /// The light along a ray near that of the pixel, which hits the same face.
  [[nodiscard]] Light LookOnFace(const Pixel& pixel, int u, int v, const Ray& ray) const;
  /// The light along a ray through the pixel, which may hit any face.
  [[nodiscard]] Light LookAgain(int u, int v, const Ray& ray);
  [[nodiscard]] Light IlluminationLike(const Pixel& sample, int u, int v, const Ray& ray, double distance_m);

  const Shader& shader_;
  const RenderedFrame& frame_;
  const BeamGrid& beams_;
  const std::vector<BoundingTree::Hit>& hits_;
  const int width_, height_;
  std::vector<Pixel> pixels_;
};

}  // namespace dhpmap::simulator

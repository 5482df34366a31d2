// SPDX-License-Identifier: BSD-3-Clause
#include "clients/simulator/picture.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace dhpmap::simulator {
namespace {

constexpr int kCell_px = 4;
constexpr float kContrast = 0.12f;  ///< larger differences between neighbours are smoothed
constexpr std::array<std::array<int, 2>, 4> kBeside{{{-1, 0}, {1, 0}, {0, -1}, {0, 1}}};
const Light kNothing(0.9f, 0.9f, 0.9f);

}  // namespace

Ray PixelRay(const RenderedFrame& frame, double u_px, double v_px) {
  return {frame.T_map_camera.translation(), frame.T_map_camera.linear() * PixelDirection(frame.camera, u_px, v_px)};
}

Picture::Picture(const Shader& shader, const RenderedFrame& frame, const BeamGrid& beams,
                 const std::vector<BoundingTree::Hit>& hits)
    : shader_(shader),
      frame_(frame),
      beams_(beams),
      hits_(hits),
      width_(frame.camera.width_px),
      height_(frame.camera.height_px),
      pixels_(hits.size()) {}

std::vector<Rgb> Picture::Colors() {
  std::size_t i = 0;
  for (int v = 0; v < height_; ++v) {
    for (int u = 0; u < width_; ++u, ++i) {
      if (hits_[i].solid == nullptr) continue;
      pixels_[i].solid = hits_[i].solid;
      pixels_[i].normal = hits_[i].solid->Normal(PixelRay(frame_, u, v).At(hits_[i].distance_m)).cast<float>();
    }
  }
  IlluminateAll();
  i = 0;
  for (int v = 0; v < height_; ++v) {
    for (int u = 0; u < width_; ++u, ++i) {
      pixels_[i].light =
          hits_[i].solid != nullptr ? Reflect(PixelRay(frame_, u, v), hits_[i].distance_m, pixels_[i]) : kNothing;
    }
  }
  std::vector<Rgb> colors(pixels_.size());
  i = 0;
  for (int v = 0; v < height_; ++v) {
    for (int u = 0; u < width_; ++u, ++i) {
      const Edge edge = hits_[i].solid != nullptr ? EdgeAt(u, v) : Edge::kNone;
      colors[i] = Develop(edge == Edge::kNone ? pixels_[i].light : Smoothed(u, v, edge));
    }
  }
  return colors;
}

Light Picture::Illuminate(const Ray& ray, double distance_m, const Pixel& pixel) const {
  return shader_.Illumination({ray.At(distance_m).cast<float>(), pixel.normal, (-ray.direction).cast<float>()});
}

Light Picture::Reflect(const Ray& ray, double distance_m, const Pixel& pixel) const {
  const Eigen::Vector3d normal = pixel.normal.cast<double>();
  // Between the short and the long side of a pixel's footprint on a slanted surface.
  const double cosine = std::abs(normal.dot(ray.direction));
  const double footprint_m = distance_m / frame_.camera.fx_px / std::sqrt(std::max(cosine, 0.05));
  return shader_.Reflection({*pixel.solid, ray.At(distance_m), normal, footprint_m}, pixel.illumination);
}

void Picture::IlluminateAll() {
  const auto illuminate = [this](int u, int v) {
    Pixel& pixel = At(u, v);
    const auto& hit = hits_[static_cast<std::size_t>(&pixel - pixels_.data())];
    if (hit.solid != nullptr) pixel.illumination = Illuminate(PixelRay(frame_, u, v), hit.distance_m, pixel);
  };
  // Cell corners first, including the last column and row.
  for (int v = 0; v < height_ + kCell_px - 1; v += kCell_px) {
    for (int u = 0; u < width_ + kCell_px - 1; u += kCell_px) {
      illuminate(std::min(u, width_ - 1), std::min(v, height_ - 1));
    }
  }
  for (int v = 0; v < height_; v += kCell_px) {
    for (int u = 0; u < width_; u += kCell_px) IlluminateCell(u, v);
  }
}

void Picture::IlluminateCell(int u0, int v0) {
  const int u1 = std::min(u0 + kCell_px, width_ - 1), v1 = std::min(v0 + kCell_px, height_ - 1);
  const std::array<const Pixel*, 4> corners{&At(u0, v0), &At(u1, v0), &At(u0, v1), &At(u1, v1)};
  for (int v = v0; v <= std::min(v0 + kCell_px - 1, height_ - 1); ++v) {
    for (int u = u0; u <= std::min(u0 + kCell_px - 1, width_ - 1); ++u) {
      Pixel& pixel = At(u, v);
      const auto& hit = hits_[static_cast<std::size_t>(&pixel - pixels_.data())];
      if (hit.solid == nullptr || ((u == u0 || u == u1) && (v == v0 || v == v1))) continue;
      const float fu = static_cast<float>(u - u0) / static_cast<float>(std::max(1, u1 - u0));
      const float fv = static_cast<float>(v - v0) / static_cast<float>(std::max(1, v1 - v0));
      const std::array<float, 4> weights{(1 - fu) * (1 - fv), fu * (1 - fv), (1 - fu) * fv, fu * fv};
      Light sum = Light::Zero();
      float weight = 0;
      for (std::size_t i = 0; i < corners.size(); ++i) {
        if (!pixel.IsAlike(*corners[i])) continue;
        sum += weights[i] * corners[i]->illumination;
        weight += weights[i];
      }
      constexpr float kLeast = 0.05f;  // a smaller weight means extrapolation from a distant corner
      pixel.illumination =
          weight > kLeast ? Light(sum / weight) : Illuminate(PixelRay(frame_, u, v), hit.distance_m, pixel);
    }
  }
}

Picture::Edge Picture::EdgeAt(int u, int v) {
  const Pixel& here = At(u, v);
  Edge edge = Edge::kNone;
  for (const auto& [du, dv] : kBeside) {
    const int x = u + du, y = v + dv;
    if (x < 0 || x >= width_ || y < 0 || y >= height_) continue;
    const Pixel& there = At(x, y);
    if (!here.IsAlike(there)) return Edge::kOfFaces;
    if ((there.light - here.light).cwiseAbs().maxCoeff() > kContrast) edge = Edge::kOfPattern;
  }
  return edge;
}

Light Picture::Smoothed(int u, int v, Edge edge) {
  constexpr std::array<std::array<double, 2>, 4> kRotatedGrid{
      {{-0.375, -0.125}, {0.125, -0.375}, {0.375, 0.125}, {-0.125, 0.375}}};
  const Pixel& here = At(u, v);
  Light sum = Light::Zero();
  for (const auto& [du, dv] : kRotatedGrid) {
    const Ray ray = PixelRay(frame_, u + du, v + dv);
    // Clipped, so that a bright lamp keeps a smooth edge.
    sum += (edge == Edge::kOfPattern ? LookOnFace(here, u, v, ray) : LookAgain(u, v, ray)).cwiseMin(1.5f);
  }
  return sum / static_cast<float>(kRotatedGrid.size());
}

Light Picture::LookOnFace(const Pixel& pixel, int u, int v, const Ray& ray) const {
  const Ray middle = PixelRay(frame_, u, v);
  const Eigen::Vector3d normal = pixel.normal.cast<double>();
  const auto& hit = hits_[static_cast<std::size_t>(&pixel - pixels_.data())];
  const double cosine = normal.dot(ray.direction);
  const double distance_m =
      std::abs(cosine) < 1e-3 ? hit.distance_m : hit.distance_m * normal.dot(middle.direction) / cosine;
  return Reflect(ray, distance_m, pixel);
}

Light Picture::LookAgain(int u, int v, const Ray& ray) {
  const BoundingTree::Hit hit = beams_.Cast(u, v, ray);
  if (hit.solid == nullptr) return kNothing;
  Pixel sample;
  sample.solid = hit.solid;
  sample.normal = hit.solid->Normal(ray.At(hit.distance_m)).cast<float>();
  sample.illumination = IlluminationLike(sample, u, v, ray, hit.distance_m);
  return Reflect(ray, hit.distance_m, sample);
}

Light Picture::IlluminationLike(const Pixel& sample, int u, int v, const Ray& ray, double distance_m) {
  if (sample.IsAlike(At(u, v))) return At(u, v).illumination;
  for (const auto& [du, dv] : kBeside) {
    if (u + du < 0 || u + du >= width_ || v + dv < 0 || v + dv >= height_) continue;
    const Pixel& pixel = At(u + du, v + dv);
    if (sample.IsAlike(pixel)) return pixel.illumination;
  }
  return Illuminate(ray, distance_m, sample);
}

}  // namespace dhpmap::simulator

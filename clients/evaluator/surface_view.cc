// SPDX-License-Identifier: BSD-3-Clause
#include "clients/evaluator/surface_view.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

namespace dhpmap::evaluator {
namespace {

constexpr float kFarthest = -std::numeric_limits<float>::infinity();
constexpr Color kPaper{255, 255, 255};

/// Lit from the upper left, behind the viewer.
float Light(const Eigen::Vector3f& normal) {
  constexpr float kAmbient = 0.58f;
  const Eigen::Vector3f to_lamp = Eigen::Vector3f(-0.45f, 0.55f, 0.7f).normalized();
  return kAmbient + (1 - kAmbient) * std::max(0.0f, normal.normalized().dot(to_lamp));
}

struct Extent {
  Eigen::Vector3f low = Eigen::Vector3f::Constant(std::numeric_limits<float>::max());
  Eigen::Vector3f high = -low;
};

Extent ExtentOf(const std::vector<Eigen::Vector3f>& points) {
  Extent extent;
  for (const Eigen::Vector3f& p : points) {
    extent.low = extent.low.cwiseMin(p);
    extent.high = extent.high.cwiseMax(p);
  }
  if (points.empty()) extent.low.setZero(), extent.high.setZero();
  return extent;
}

std::uint8_t Lit(int sum, int num) { return static_cast<std::uint8_t>(std::clamp(sum / num, 0, 255)); }

}  // namespace

SurfaceView::SurfaceView(const Mesh& mesh, const Eigen::Matrix3f& R_view_map, Sides sides, int long_side_px) {
  std::vector<Eigen::Vector3f> seen;
  seen.reserve(mesh.vertices_m.size());
  for (const Eigen::Vector3f& p_m : mesh.vertices_m) seen.emplace_back(R_view_map * p_m);
  const Extent extent = ExtentOf(seen);
  const Eigen::Vector3f size_m = (extent.high - extent.low).cwiseMax(0.1f);
  const float px_per_m = static_cast<float>(kFiner * long_side_px) / std::max(size_m.x(), size_m.y());
  width_ = kFiner * (static_cast<int>(size_m.x() * px_per_m) / kFiner + 1);
  height_ = kFiner * (static_cast<int>(size_m.y() * px_per_m) / kFiner + 1);
  pixels_.assign(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_), {kFarthest, 0, kNothing});
  for (Eigen::Vector3f& p : seen) {
    p = {(p.x() - extent.low.x()) * px_per_m, (extent.high.y() - p.y()) * px_per_m, p.z()};
  }
  const bool has_normals = mesh.normals.size() == mesh.vertices_m.size();
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto& triangle = mesh.triangles[t];
    Eigen::Matrix3f corners, normals;
    for (int i = 0; i < 3; ++i) corners.col(i) = seen[triangle[static_cast<std::size_t>(i)]];
    const Eigen::Vector3f across = (corners.col(1) - corners.col(0)).cross(corners.col(2) - corners.col(0));
    const bool is_front = across.z() < 0;  // pixel rows go down
    if (!is_front && sides == Sides::kFront) continue;
    for (int i = 0; i < 3; ++i) {
      const Eigen::Vector3f plain(-across.x() * px_per_m, across.y() * px_per_m, -across.z());
      normals.col(i) = has_normals ? R_view_map * mesh.normals[triangle[static_cast<std::size_t>(i)]] : plain;
    }
    Draw(t, corners, is_front ? normals : -normals);
  }
  ShadeEdges();
}

void SurfaceView::Draw(std::uint32_t triangle, const Eigen::Matrix3f& corners, const Eigen::Matrix3f& normals) {
  const Eigen::Vector2f a = corners.col(0).head<2>(), b = corners.col(1).head<2>(), c = corners.col(2).head<2>();
  const auto twice_area = [](const Eigen::Vector2f& p, const Eigen::Vector2f& q, const Eigen::Vector2f& r) {
    return (q.x() - p.x()) * (r.y() - p.y()) - (q.y() - p.y()) * (r.x() - p.x());
  };
  const float all = twice_area(a, b, c);
  if (all == 0) return;
  const Eigen::Vector2f low = a.cwiseMin(b).cwiseMin(c), high = a.cwiseMax(b).cwiseMax(c);
  const int first_x = std::max(0, static_cast<int>(std::floor(low.x() - 0.5f)));
  const int first_y = std::max(0, static_cast<int>(std::floor(low.y() - 0.5f)));
  const int last_x = std::min(width_ - 1, static_cast<int>(high.x() + 0.5f));
  const int last_y = std::min(height_ - 1, static_cast<int>(high.y() + 0.5f));
  constexpr float kRim = -1e-4f;  // a point on the edge of two triangles belongs to at least one
  for (int y = first_y; y <= last_y; ++y) {
    for (int x = first_x; x <= last_x; ++x) {
      const Eigen::Vector2f p(static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f);
      const Eigen::Vector3f weights(twice_area(p, b, c) / all, twice_area(a, p, c) / all, twice_area(a, b, p) / all);
      if (weights.minCoeff() < kRim) continue;
      const float nearness_m = corners.row(2).dot(weights);
      Pixel& pixel = at(x, y);
      if (nearness_m <= pixel.nearness_m) continue;
      pixel = {nearness_m, Light(normals * weights), triangle};
    }
  }
}

void SurfaceView::ShadeEdges() {
  constexpr int kReach = 2 * kFiner;
  constexpr float kDarkest = 0.45f, kFull_m = 0.6f;
  std::vector<float> shades(pixels_.size(), 1);
  for (int y = kReach; y + kReach < height_; ++y) {
    for (int x = kReach; x + kReach < width_; ++x) {
      const Pixel& here = at(x, y);
      if (here.triangle == kNothing) continue;
      float step_m = 0;
      for (const auto& [dx, dy] : {std::pair{kReach, 0}, {-kReach, 0}, {0, kReach}, {0, -kReach}}) {
        const Pixel& beside = at(x + dx, y + dy);
        if (beside.triangle != kNothing) step_m += std::clamp(beside.nearness_m - here.nearness_m, 0.0f, kFull_m);
      }
      const float share = std::min(1.0f, step_m / (2 * kFull_m));
      shades[static_cast<std::size_t>(&here - pixels_.data())] = 1 - kDarkest * share;
    }
  }
  for (std::size_t i = 0; i < pixels_.size(); ++i) pixels_[i].light *= shades[i];
}

Picture SurfaceView::Paint(const std::function<Color(std::uint32_t triangle)>& color_of) const {
  Picture picture(width_ / kFiner, height_ / kFiner, kPaper);
  for (int y = 0; y < picture.height_px; ++y) {
    for (int x = 0; x < picture.width_px; ++x) {
      float r = 0, g = 0, b = 0;
      for (int i = 0; i < kFiner * kFiner; ++i) {
        const Pixel& pixel = at(kFiner * x + i % kFiner, kFiner * y + i / kFiner);
        const bool is_there = pixel.triangle != kNothing;
        const Color color = is_there ? color_of(pixel.triangle) : kPaper;
        const float light = is_there ? pixel.light : 1;
        r += light * static_cast<float>(color.r);
        g += light * static_cast<float>(color.g);
        b += light * static_cast<float>(color.b);
      }
      constexpr int kParts = kFiner * kFiner;
      picture.at(x, y) = {Lit(static_cast<int>(r), kParts), Lit(static_cast<int>(g), kParts),
                          Lit(static_cast<int>(b), kParts)};
    }
  }
  return picture;
}

}  // namespace dhpmap::evaluator

// SPDX-License-Identifier: BSD-3-Clause
#include "clients/simulator/material.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace dhpmap::simulator {
namespace {

float Lattice(int x, int y, std::uint32_t seed) {
  std::uint32_t h = static_cast<std::uint32_t>(x) * 0x8da6b343u ^ static_cast<std::uint32_t>(y) * 0xd8163841u ^
                    (seed + 1) * 0xcb1ab31fu;
  h = (h ^ (h >> 15)) * 0x2c1b3c6du;
  h = (h ^ (h >> 12)) * 0x297a2d39u;
  return static_cast<float>((h ^ (h >> 15)) >> 8) * 0x1p-24f;
}

float Smooth(float t) { return t * t * (3.0f - 2.0f * t); }

/// Value noise in 0..1 on the unit lattice.
float Noise(float x, float y, std::uint32_t seed) {
  const float fx = std::floor(x), fy = std::floor(y);
  const int ix = static_cast<int>(fx), iy = static_cast<int>(fy);
  const float u = Smooth(x - fx), v = Smooth(y - fy);
  const float low = Lattice(ix, iy, seed) + u * (Lattice(ix + 1, iy, seed) - Lattice(ix, iy, seed));
  const float high = Lattice(ix, iy + 1, seed) + u * (Lattice(ix + 1, iy + 1, seed) - Lattice(ix, iy + 1, seed));
  return low + v * (high - low);
}

/// 1 if the pixel is much smaller than a feature of this size, 0 if it is larger.
float Detail(double footprint_m, double feature_m) {
  return static_cast<float>(std::clamp(1.5 - 2.0 * footprint_m / feature_m, 0.0, 1.0));
}

Light Mix(const Light& a, const Light& b, float t) { return a + t * (b - a); }

/// The share of a pixel at `x`, `footprint` wide, that is in bands of width `band` at the start of each `period`.
float BandCover(double x, double period, double band, double footprint) {
  const auto integral = [&](double at) {
    const double whole = std::floor(at / period);
    return whole * band + std::min(at - whole * period, band);
  };
  const double width = std::max(footprint, 1e-6);
  return static_cast<float>((integral(x + width / 2) - integral(x - width / 2)) / width);
}

/// Coordinates on the face of a solid, along and across the grain, in m.
struct FacePoint {
  float along, across;
};

FacePoint OnFace(const SurfacePoint& at) {
  const Eigen::Vector3d p = at.solid.ToLocal(at.p_map);
  const Eigen::Vector3d n = at.solid.R_map_solid.transpose() * at.normal;
  const Eigen::Vector3d half = at.solid.LocalExtents();
  int face = 0;
  n.cwiseAbs().maxCoeff(&face);
  int grain = (face + 1) % 3, other = (face + 2) % 3;
  if (half[other] > half[grain]) std::swap(grain, other);
  return {static_cast<float>(p[grain]), static_cast<float>(p[other])};
}

/// Upright coordinates in -1..1 on the large face of a flat solid (picture, window).
Eigen::Vector2f OnPanel(const SurfacePoint& at) {
  const Eigen::Vector3d p = at.solid.ToLocal(at.p_map);
  const Eigen::Vector3d half = at.solid.LocalExtents();
  const int wide = half.x() > half.y() ? 0 : 1;
  return {static_cast<float>(p[wide] / half[wide]), static_cast<float>(p.z() / half.z())};
}

Light Wood(const Material& m, const SurfacePoint& at, const FacePoint& f, std::uint32_t seed) {
  const auto scale = static_cast<float>(m.scale_m);
  const float wave = Noise(f.along / scale, 3.0f * f.across / scale, seed);
  const float rings = std::sin(60.0f * (f.across / scale + 0.35f * wave));
  const float fibre = Noise(4.0f * f.along / scale, 90.0f * f.across / scale, seed + 7) - 0.5f;
  const float grain = 0.45f + 0.3f * (wave - 0.5f) + 0.2f * rings * Detail(at.footprint_m, 0.1 * m.scale_m) +
                      0.5f * fibre * Detail(at.footprint_m, 0.02 * m.scale_m);
  return Mix(FromHex(m.first), FromHex(m.second), std::clamp(grain, 0.0f, 1.0f));
}

Light Planks(const Material& m, const SurfacePoint& at) {
  constexpr double kLength_m = 1.4;
  const double row = std::floor(at.p_map.y() / m.scale_m);
  const double shift = kLength_m * Lattice(static_cast<int>(row), 0, 3);
  const double column = std::floor((at.p_map.x() + shift) / kLength_m);
  const float tone = Lattice(static_cast<int>(row), static_cast<int>(column), 5);
  Material board = m;
  board.scale_m = 0.6;
  const FacePoint f{static_cast<float>(at.p_map.x()), static_cast<float>(at.p_map.y() - row * m.scale_m)};
  const Light wood = Wood(board, at, f, static_cast<std::uint32_t>(row * 31 + column)) * (0.86f + 0.28f * tone);
  const float gap = std::max(BandCover(at.p_map.y(), m.scale_m, 0.004, at.footprint_m),
                             BandCover(at.p_map.x() + shift, kLength_m, 0.004, at.footprint_m));
  return wood * (1.0f - 0.55f * gap);
}

Light Tiles(const Material& m, const SurfacePoint& at, const FacePoint& f) {
  const double grout = std::min(0.03 * m.scale_m, 0.006);
  const float gap = std::max(BandCover(f.along, m.scale_m, grout, at.footprint_m),
                             BandCover(f.across, m.scale_m, grout, at.footprint_m));
  const float tone = Lattice(static_cast<int>(std::floor(f.along / m.scale_m)),
                             static_cast<int>(std::floor(f.across / m.scale_m)), at.solid.look_seed);
  return Mix(FromHex(m.first) * (0.93f + 0.1f * tone), FromHex(m.second), gap);
}

float CheckerCover(const Material& m, const SurfacePoint& at, const FacePoint& f) {
  const float a = BandCover(f.along, 2 * m.scale_m, m.scale_m, at.footprint_m);
  const float b = BandCover(f.across, 2 * m.scale_m, m.scale_m, at.footprint_m);
  return a * (1 - b) + b * (1 - a);
}

float WeaveShade(const Material& m, const SurfacePoint& at, const FacePoint& f) {
  const auto k = static_cast<float>(6.2831853 / m.scale_m);
  const float threads = std::sin(k * f.along) * std::sin(k * f.across) * Detail(at.footprint_m, m.scale_m);
  const float wear = Noise(7.0f * f.along, 7.0f * f.across, at.solid.look_seed) - 0.5f;
  return std::clamp(0.5f + 0.35f * threads + 0.5f * wear, 0.0f, 1.0f);
}

float Veins(const SurfacePoint& at, const FacePoint& f, double scale_m) {
  const auto s = static_cast<float>(1.0 / scale_m);
  const float warp = Noise(2 * s * f.along, 2 * s * f.across, 11) + 0.5f * Noise(5 * s * f.along, 5 * s * f.across, 12);
  const float vein = 1.0f - std::abs(std::sin(3.0f * (s * f.along + 0.6f * s * f.across + 1.4f * warp)));
  return vein * vein * vein * vein * Detail(at.footprint_m, 0.2 * scale_m);
}

float Speckles(const Material& m, const SurfacePoint& at, const FacePoint& f) {
  const auto s = static_cast<float>(1.0 / m.scale_m);
  const float spot = std::clamp(6.0f * (Noise(s * f.along, s * f.across, at.solid.look_seed) - 0.62f), 0.0f, 1.0f);
  const float detail = Detail(at.footprint_m, m.scale_m);
  return spot * detail + 0.2f * (1.0f - detail);
}

/// A sun, two ranges of hills and a foreground in the material's two colours.
Light Landscape(const Material& m, const SurfacePoint& at) {
  const Eigen::Vector2f p = OnPanel(at);
  const std::uint32_t seed = at.solid.look_seed;
  const Light high = FromHex(m.first), low = FromHex(m.second);
  const Eigen::Vector2f sun(1.2f * Lattice(1, 0, seed) - 0.6f, 0.25f + 0.4f * Lattice(2, 0, seed));
  if ((p - sun).norm() < 0.2f) return FromHex(0xfff2c0);
  const float far_hill = 0.9f * Noise(1.6f * p.x() + 9, 0, seed) - 0.45f;
  const float near_hill = 0.8f * Noise(2.3f * p.x() + 5, 0, seed + 1) - 0.85f;
  if (p.y() < near_hill) return low * 0.35f;
  if (p.y() < far_hill) return Mix(low, high, 0.35f) * 0.8f;
  return Mix(Light(1.0f, 0.85f, 0.7f), high, std::clamp(0.5f + 0.5f * p.y(), 0.0f, 1.0f));
}

Light Sky(const SurfacePoint& at) {
  const Eigen::Vector2f p = OnPanel(at);
  const auto along = static_cast<float>(at.p_map.x() + at.p_map.y());
  const float hill = -0.45f + 0.25f * Noise(1.5f * along, 0, 2) + 0.05f * Noise(14.0f * along, 0, 4);
  if (p.y() < hill) return FromHex(0x8fb277) * (0.75f + 0.3f * Noise(18 * along, 18 * p.y(), 5));
  const float cloud = std::clamp(2.0f * Noise(2 * along, 4 * p.y(), 6) - 0.9f, 0.0f, 1.0f);
  return Mix(Mix(FromHex(0xdfeefa), FromHex(0x8fbfec), 0.5f + 0.5f * p.y()), FromHex(0xffffff), cloud);
}

}  // namespace

Light FromHex(std::uint32_t rgb) {
  static const std::array<float, 256> kLinear = [] {
    std::array<float, 256> table{};
    for (std::size_t i = 0; i < table.size(); ++i) {
      const double c = static_cast<double>(i) / 255.0;
      table[i] = static_cast<float>(c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4));
    }
    return table;
  }();
  return {kLinear[rgb >> 16 & 255], kLinear[rgb >> 8 & 255], kLinear[rgb & 255]};
}

Light Albedo(const Material& m, const SurfacePoint& at) {
  if (m.pattern == Material::Pattern::kPlain) return FromHex(m.first);
  if (m.pattern == Material::Pattern::kPlanks) return Planks(m, at);
  if (m.pattern == Material::Pattern::kSky) return Sky(at);
  if (m.pattern == Material::Pattern::kLandscape) return Landscape(m, at);
  const FacePoint f = OnFace(at);
  float share = 0;
  switch (m.pattern) {
    case Material::Pattern::kWood: return Wood(m, at, f, at.solid.look_seed);
    case Material::Pattern::kTiles: return Tiles(m, at, f);
    case Material::Pattern::kChecker: share = CheckerCover(m, at, f); break;
    case Material::Pattern::kStripes: share = BandCover(f.across, 2 * m.scale_m, m.scale_m, at.footprint_m); break;
    case Material::Pattern::kRings:
      share = BandCover(std::hypot(f.along, f.across), 2 * m.scale_m, m.scale_m, at.footprint_m);
      break;
    case Material::Pattern::kWeave: share = WeaveShade(m, at, f); break;
    case Material::Pattern::kMarble: share = Veins(at, f, m.scale_m); break;
    case Material::Pattern::kSpeckles: share = Speckles(m, at, f); break;
    default: break;
  }
  return Mix(FromHex(m.first), FromHex(m.second), share);
}

}  // namespace dhpmap::simulator

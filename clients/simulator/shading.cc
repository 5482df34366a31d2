// SPDX-License-Identifier: BSD-3-Clause
#include "clients/simulator/shading.h"

#include <algorithm>
#include <cmath>

namespace dhpmap::simulator {
namespace {

using Eigen::Vector3f;

constexpr float kExposure = 1.25f;
constexpr float kGloss = 0.05f;
constexpr double kReachAcross_m = 0.35;  ///< how far a room's light reaches into the next room

/// Distance from p to the room; 0 inside.
double DistanceToRoom(const Room& room, double x, double y) {
  const double dx = std::max({room.min_x_m - x, 0.0, x - room.max_x_m});
  const double dy = std::max({room.min_y_m - y, 0.0, y - room.max_y_m});
  return std::sqrt(dx * dx + dy * dy);
}

std::size_t RoomOf(double x, double y) {
  const std::span<const Room> rooms = ApartmentScene::Rooms();
  const auto nearest = std::min_element(rooms.begin(), rooms.end(), [&](const Room& a, const Room& b) {
    return DistanceToRoom(a, x, y) < DistanceToRoom(b, x, y);
  });
  return static_cast<std::size_t>(nearest - rooms.begin());
}

}  // namespace

Rgb Develop(const Light& light) {
  static const std::array<std::uint8_t, 4096> kEncoded = [] {
    std::array<std::uint8_t, 4096> table{};
    for (std::size_t i = 0; i < table.size(); ++i) {
      const double c = static_cast<double>(i) / static_cast<double>(table.size() - 1);
      const double s = c <= 0.0031308 ? 12.92 * c : 1.055 * std::pow(c, 1 / 2.4) - 0.055;
      table[i] = static_cast<std::uint8_t>(std::lround(255 * s));
    }
    return table;
  }();
  const auto channel = [](float x) {
    // Linear for dark tones, approaching 1.
    const float y = kExposure * std::max(x, 0.0f);
    const float kept = y < 0.5f ? y : 1.0f - 0.25f / y;
    return kEncoded[static_cast<std::size_t>(kept * 4095.0f)];
  };
  return {channel(light.x()), channel(light.y()), channel(light.z())};
}

Shader::Shader(const ApartmentScene& scene)
    : scene_(scene), grid_(scene.solids()), sources_(ApartmentScene::Rooms().size()) {
  for (std::size_t i = 0; i < sources_.size(); ++i) {
    sources_[i].push_back(
        {ApartmentScene::Rooms()[i].lamp_m.cast<float>(), Vector3f::Zero(), Light(1.0f, 0.92f, 0.8f) * 0.85f, 7.0f});
  }
  for (const Solid& solid : scene.solids()) {
    if (scene.MaterialOf(solid).pattern != Material::Pattern::kSky) continue;
    const std::size_t room = RoomOf(solid.center_m.x(), solid.center_m.y());
    const Room& inside = ApartmentScene::Rooms()[room];
    const bool faces_x = solid.size_m.x() < solid.size_m.y();
    const Eigen::Vector3d middle((inside.min_x_m + inside.max_x_m) / 2, (inside.min_y_m + inside.max_y_m) / 2, 0);
    const Eigen::Vector3d inward = faces_x ? Eigen::Vector3d((middle - solid.center_m).x() < 0 ? -1 : 1, 0, 0)
                                           : Eigen::Vector3d(0, (middle - solid.center_m).y() < 0 ? -1 : 1, 0);
    const double area = 4 * std::max(solid.size_m.x(), solid.size_m.y()) * solid.size_m.z();
    sources_[room].push_back({(solid.center_m + 0.15 * inward).cast<float>(), inward.cast<float>(),
                              Light(0.82f, 0.92f, 1.0f) * static_cast<float>(0.75 * area), 3.0f});
  }
}

// Ambient occlusion: the distance field along the normal, compared with that of an open plane.
float Shader::Openness(const LitPoint& at) const {
  constexpr std::array<float, 4> kHeights_m{0.05f, 0.12f, 0.26f, 0.45f};
  constexpr std::array<float, 4> kShares{0.2f, 0.22f, 0.26f, 0.32f};
  float blocked = 0;
  for (std::size_t i = 0; i < kHeights_m.size(); ++i) {
    const float open_m = std::min(kHeights_m[i], DistanceGrid::kReach_m);
    blocked += kShares[i] * std::max(0.0f, open_m - grid_.At(at.p_m + kHeights_m[i] * at.normal)) / open_m;
  }
  return std::clamp(1.0f - 0.85f * blocked, 0.12f, 1.0f);
}

// Soft shadow by the closest pass of the ray to the light (Quilez, "soft shadows in raymarched SDFs"), but at fixed
// fractions of the ray: steps that depend on distances would draw contour lines on walls.
float Shader::Visibility(const LitPoint& at, const Source& source) const {
  constexpr std::array<float, 12> kShares{0.035f, 0.06f, 0.09f, 0.13f, 0.18f, 0.24f,
                                          0.31f,  0.39f, 0.48f, 0.58f, 0.69f, 0.81f};
  constexpr float kNearLight_m = 0.3f;
  const Vector3f start = at.p_m + 0.05f * at.normal;
  const Vector3f way = source.position_m - start;
  const float distance_m = way.norm();
  const Vector3f direction = way / distance_m;
  const float length_m = std::max(distance_m - kNearLight_m, 0.0f);
  float visible = 1;
  for (float share : kShares) {
    const float t = std::max(share * length_m, 0.08f);
    visible = std::min(visible, source.softness * grid_.At(start + t * direction) / t);
    if (visible < 0.02f) return 0;
  }
  return visible * visible * (3 - 2 * visible);
}

Light Shader::FromSource(const LitPoint& at, const Source& source) const {
  const Vector3f to_light = source.position_m - at.p_m;
  const float squared = to_light.squaredNorm();
  const Vector3f direction = to_light / std::sqrt(squared);
  const float incidence = at.normal.dot(direction);
  if (incidence <= 0) return Light::Zero();
  float strength = incidence / (0.45f + 0.28f * squared);
  if (!source.facing.isZero()) strength *= std::max(0.0f, -source.facing.dot(direction));
  if (strength < 0.004f) return Light::Zero();
  const float visible = Visibility(at, source);
  const Vector3f half = (direction + at.to_eye).normalized();
  const float highlight = kGloss * std::pow(std::max(0.0f, at.normal.dot(half)), 60.0f) / (0.15f + 0.1f * squared);
  return source.light * visible * (strength + highlight);
}

Light Shader::FromRooms(const LitPoint& at) const {
  const std::span<const Room> rooms = ApartmentScene::Rooms();
  const std::size_t own = RoomOf(at.p_m.x(), at.p_m.y());
  Light sum = Light::Zero();
  for (std::size_t i = 0; i < rooms.size(); ++i) {
    float share = 1;
    if (i != own) {
      const double outside_m = DistanceToRoom(rooms[i], at.p_m.x(), at.p_m.y());
      if (outside_m >= kReachAcross_m) continue;
      share = static_cast<float>(1 - outside_m / kReachAcross_m);
    }
    for (const Source& source : sources_[i]) sum += share * FromSource(at, source);
  }
  return sum;
}

Light Shader::Illumination(const LitPoint& at) const {
  // Ambient light: warm from the floor, slightly brighter and colder from above.
  const float up = 0.5f + 0.5f * at.normal.z();
  const Light around = Light(0.34f, 0.31f, 0.28f) * (1 - up) + Light(0.40f, 0.41f, 0.43f) * up;
  return around * Openness(at) + FromRooms(at);
}

Light Shader::Reflection(const SurfacePoint& at, const Light& illumination) const {
  const Material& material = scene_.MaterialOf(at.solid);
  const Light albedo = Albedo(material, at);
  const auto glow = static_cast<float>(material.glow);
  return albedo.cwiseProduct(illumination) * (glow > 0.5f ? 0.4f : 1.0f) + glow * albedo;
}

}  // namespace dhpmap::simulator

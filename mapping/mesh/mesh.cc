// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/mesh/mesh.h"

#include <algorithm>
#include <cmath>

namespace dhpmap {
namespace {

template <typename T>
void Append(const std::vector<T>& part, std::vector<T>& whole) {
  whole.insert(whole.end(), part.begin(), part.end());
}

}  // namespace

void AppendMesh(const Mesh& part, Mesh& whole) {
  const auto offset = static_cast<std::uint32_t>(whole.vertices_m.size());
  whole.triangles.reserve(whole.triangles.size() + part.triangles.size());
  for (const auto& [a, b, c] : part.triangles) whole.triangles.push_back({a + offset, b + offset, c + offset});
  Append(part.vertices_m, whole.vertices_m);
  Append(part.normals, whole.normals);
  Append(part.colors, whole.colors);
  Append(part.classes, whole.classes);
  Append(part.instances, whole.instances);
}

Color ColorOfId(std::uint32_t id) {
  if (id == 0) return {128, 128, 128};
  // Multiples of the golden ratio stay away from recent hues; saturation and value separate ids after hues repeat.
  constexpr double kGoldenRatio = 0.6180339887498949;
  const double hue = std::fmod(id * kGoldenRatio, 1.0) * 6;
  const double saturation = 0.55 + 0.15 * (id % 4);
  const double value = 1.0 - 0.15 * (id / 4 % 3);
  const auto channel = [&](double shift) {
    const double k = std::fmod(shift + hue, 6.0);  // HSV to RGB
    const double level = value * (1 - saturation * std::clamp(std::min(k, 4 - k), 0.0, 1.0));
    return static_cast<std::uint8_t>(std::lround(255 * level));
  };
  return {channel(5), channel(3), channel(1)};
}

}  // namespace dhpmap

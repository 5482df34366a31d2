// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/geometry/field_normals.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <bit>
#include <cmath>

namespace dhpmap {

FieldNormals::FieldNormals(std::size_t num_triangles) : entries_(std::bit_ceil(12 * num_triangles + 8), Entry{0, 0}) {}

namespace {

/// A hash; sums of a few hashes are 0 by chance once in 2^64.
std::uint64_t Mix(std::uint64_t value) {
  value = (value ^ value >> 30) * 0xBF58476D1CE4E5B9ull;
  value = (value ^ value >> 27) * 0x94D049BB133111EBull;
  return value ^ value >> 31;
}

}  // namespace

std::uint64_t FieldNormals::KeyOf(const Eigen::Vector3f& corner) {
  constexpr double kSteps_per_m = 1e4, kHalf = 1 << 20;
  std::uint64_t key = 1;
  for (int axis = 0; axis < 3; ++axis) {
    const auto step = static_cast<std::uint64_t>(double{corner[axis]} * kSteps_per_m + kHalf + 0.5);
    key = key << 21 | (step & 0x1FFFFFu);
  }
  return key;  // with bit 63 set for the front side
}

std::uint64_t FieldNormals::KeyOf(std::uint32_t a, std::uint32_t b) {
  return std::uint64_t{1} << 62 | std::uint64_t{std::min(a, b)} << 31 | std::max(a, b);
}

FieldNormals::Entry& FieldNormals::Find(std::uint64_t key) {
  const std::size_t mask = entries_.size() - 1;
  const std::uint64_t hash = key * 0x9E3779B97F4A7C15ull;
  for (std::size_t at = (hash ^ hash >> 32) & mask;; at = (at + 1) & mask) {
    if (entries_[at].key == key || entries_[at].key == 0) return entries_[at];
  }
}

std::uint32_t FieldNormals::PlaceOf(std::uint64_t key) {
  Entry& entry = Find(key);
  if (entry.key == 0) {
    entry = {key, static_cast<std::uint32_t>(sums_.size())};
    sums_.emplace_back(Eigen::Vector3f::Zero());
    ends_.push_back(0);
  }
  return entry.place;
}

FieldNormals::Places FieldNormals::Want(const TriangleCorners& triangle) {
  std::array<std::uint32_t, 3> corners;
  for (std::size_t i = 0; i < 3; ++i) corners[i] = PlaceOf(KeyOf(triangle[i]));
  Places places;
  for (std::size_t i = 0; i < 3; ++i) {
    places.corners[i] = corners[i];
    places.edges[i] = PlaceOf(KeyOf(corners[i], corners[(i + 1) % 3]));
  }
  return places;
}

void FieldNormals::Add(const TriangleCorners& triangle, std::uint32_t surface) {
  constexpr std::uint32_t kNone = 0xFFFFFFFF;
  std::array<std::uint32_t, 3> places;
  std::array<std::uint64_t, 3> keys;
  bool is_any = false;
  for (std::size_t i = 0; i < 3; ++i) {
    keys[i] = KeyOf(triangle[i]);
    const Entry& entry = Find(keys[i]);
    places[i] = entry.key == 0 ? kNone : entry.place;
    is_any |= entry.key != 0;
  }
  if (!is_any) return;
  const Eigen::Vector3f normal = (triangle[1] - triangle[0]).cross(triangle[2] - triangle[0]).stableNormalized();
  const std::uint64_t own = 0x9E3779B97F4A7C15ull * (std::uint64_t{surface} + 1);
  for (std::size_t i = 0; i < 3; ++i) {
    if (places[i] == kNone) continue;
    const std::size_t next = (i + 1) % 3, last = (i + 2) % 3;
    const Eigen::Vector3f u = triangle[next] - triangle[i], v = triangle[last] - triangle[i];
    sums_[places[i]] += std::atan2(u.cross(v).norm(), u.dot(v)) * normal;
    ends_[places[i]] += Mix(keys[next] + own) - Mix(keys[last] + own);
    if (places[next] == kNone || places[next] == places[i]) continue;
    const Entry& edge = Find(KeyOf(places[i], places[next]));
    if (edge.key == 0) continue;
    sums_[edge.place] += normal;
    ends_[edge.place] += places[i] < places[next] ? Mix(own) : 0 - Mix(own);
  }
}

}  // namespace dhpmap

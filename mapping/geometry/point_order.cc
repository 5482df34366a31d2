// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/geometry/point_order.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>

namespace dhpmap {
namespace {

constexpr int kBitsAnAxis = 10;

/// Spreads the lowest ten bits, with two zeros between them.
constexpr std::uint32_t Spread(std::uint32_t bits) {
  bits = (bits | bits << 16) & 0x030000FFu;
  bits = (bits | bits << 8) & 0x0300F00Fu;
  bits = (bits | bits << 4) & 0x030C30C3u;
  return (bits | bits << 2) & 0x09249249u;
}

struct Keyed {
  std::uint32_t key, number;
};

/// A stable sort by ten bits of the key.
void SortBy(int shift, const std::vector<Keyed>& from, std::vector<Keyed>& to) {
  constexpr std::uint32_t kMask = (1u << kBitsAnAxis) - 1;
  std::array<std::uint32_t, (std::size_t{1} << kBitsAnAxis) + 1> first{};
  for (const Keyed& point : from) ++first[(point.key >> shift & kMask) + 1];
  for (std::size_t i = 1; i < first.size(); ++i) first[i] += first[i - 1];
  for (const Keyed& point : from) to[first[point.key >> shift & kMask]++] = point;
}

}  // namespace

std::vector<std::uint32_t> OrderAlongCurve(std::span<const Eigen::Vector3d> points) {
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3d& p : points) box.extend(p);
  constexpr double kCells = 1 << kBitsAnAxis;
  const double side = points.empty() ? 0 : box.sizes().maxCoeff();
  const double scale = side > 0 ? (kCells - 1) / side : 0;
  const auto cell_of = [&](const Eigen::Vector3d& p, int axis) {
    const double cell = (p[axis] - box.min()[axis]) * scale;
    return cell > 0 ? static_cast<std::uint32_t>(std::min(cell, kCells - 1)) : 0;  // NaN if the box is infinite
  };
  std::vector<Keyed> points_of_key(points.size()), other(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Eigen::Vector3d& p = points[i];
    points_of_key[i] = {Spread(cell_of(p, 0)) | Spread(cell_of(p, 1)) << 1 | Spread(cell_of(p, 2)) << 2,
                        static_cast<std::uint32_t>(i)};
  }
  SortBy(0, points_of_key, other);
  SortBy(kBitsAnAxis, other, points_of_key);
  SortBy(2 * kBitsAnAxis, points_of_key, other);
  std::vector<std::uint32_t> order(points.size());
  std::transform(other.begin(), other.end(), order.begin(), [](const Keyed& point) { return point.number; });
  return order;
}

}  // namespace dhpmap

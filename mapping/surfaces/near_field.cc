// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/surfaces/near_field.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "mapping/base/vector_clones.h"
#include "mapping/geometry/triangle_tree.h"

namespace dhpmap {

NearField::~NearField() { ledger_->cell_bytes -= counted_bytes_; }

std::size_t NearField::MemoryBytes() const {
  return sizeof(*this) + grid_.capacity() * sizeof(grid_[0]) + nodes_.capacity() * sizeof(nodes_[0]) +
         lists_.capacity() * sizeof(lists_[0]) + triangles_.capacity() * sizeof(triangles_[0]) +
         submaps_.capacity() * sizeof(submaps_[0]) + needed_.capacity() * sizeof(needed_[0]);
}

std::uint32_t NearField::PackNormal(const Eigen::Vector3f& normal) {
  const Eigen::Vector3f unit = normal.stableNormalized();
  std::uint32_t packed = 0;
  for (int axis = 0; axis < 3; ++axis) {
    packed |= static_cast<std::uint32_t>(std::lround(unit[axis] * 511) + 512) << 10 * axis;
  }
  return packed;
}

Eigen::Vector3f NearField::UnpackNormal(std::uint32_t packed) {
  const auto at = [packed](int axis) {
    return static_cast<float>(static_cast<int>(packed >> 10 * axis & 1023u) - 512);
  };
  return {at(0), at(1), at(2)};
}

TriangleCorners NearField::CornersOf(const Triangle& triangle) {
  TriangleCorners corners;
  for (std::size_t i = 0; i < 3; ++i) corners[i] = Eigen::Map<const Eigen::Vector3f>(triangle.corners[i]);
  return corners;
}

/// Eight triangles at a time; a partly filled group repeats its last triangle.
DHPMAP_VECTOR_CLONES
std::uint32_t NearField::NearestOf(const Eigen::Vector3f& p, const List& list) const {
  constexpr auto kLanes = static_cast<std::uint32_t>(TrianglePacket::kLanes);
  float best2 = std::numeric_limits<float>::infinity();
  std::uint32_t best = 0;
  TrianglePacket packet;
  for (std::uint32_t first = 0; first < list.count; first += kLanes) {
    for (std::uint32_t lane = 0; lane < kLanes; ++lane) {
      const Triangle& triangle = triangles_[lists_[list.first + std::min(first + lane, list.count - 1)]];
      for (std::size_t corner = 0; corner < 3; ++corner) {
        for (std::size_t axis = 0; axis < 3; ++axis)
          packet.corners[corner][axis][lane] = triangle.corners[corner][axis];
      }
    }
    alignas(32) float distance2[kLanes];
    (void)packet.Within(p, std::numeric_limits<float>::max(), distance2);
    for (std::uint32_t lane = 0; lane < kLanes; ++lane) {
      if (!(distance2[lane] < best2)) continue;
      best2 = distance2[lane];
      best = first + lane;
    }
  }
  return lists_[list.first + std::min(best, list.count - 1)];
}

/// Combining two triangles in a vector would take longer than testing both.
std::uint32_t NearField::NearestOfTwo(const Eigen::Vector3f& p, std::uint32_t first) const {
  const std::uint32_t a = lists_[first], b = lists_[first + 1];
  const auto distance2 = [&](std::uint32_t i) {
    return (p - NearestPointOf(CornersOf(triangles_[i]), p)).squaredNorm();
  };
  return distance2(b) < distance2(a) ? b : a;
}

NearField::Nearest NearField::Find(const Eigen::Vector3f& p, const List& list) const {
  const Triangle& triangle = triangles_[list.count == 1   ? lists_[list.first]
                                        : list.count == 2 ? NearestOfTwo(p, list.first)
                                                          : NearestOf(p, list)];
  const TriangleCorners corners = CornersOf(triangle);
  Nearest nearest;
  const Eigen::Vector3f point = NearestPointOf(corners, p);
  nearest.away = p - point;
  nearest.normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]);
  nearest.submap = triangle.submap;
  // The side: by the face, or by all faces at the nearest edge or corner (Baerentzen and Aanaes, Signed distance
  // computation using the angle weighted pseudonormal, 2005).
  float side = nearest.normal.dot(nearest.away);
  const float across2 = side * side, face2 = nearest.normal.squaredNorm() * nearest.away.squaredNorm();
  constexpr float kFace = 1 - 1e-4f;  // squared cosine; above it the other faces do not matter
  nearest.is_across = across2 >= kFace * face2;
  if (!nearest.is_across) {
    std::size_t corner = 0;
    while (corner < 3 && point != corners[corner]) ++corner;
    if (corner < 3) {
      side = UnpackNormal(triangle.corner_normals[corner]).dot(nearest.away);
    } else {
      float least = std::numeric_limits<float>::infinity();
      std::size_t edge = 0;
      for (std::size_t i = 0; i < 3; ++i) {
        const Eigen::Vector3f along = corners[(i + 1) % 3] - corners[i];
        const float off2 = along.cross(point - corners[i]).squaredNorm() / along.squaredNorm();
        if (off2 < least) least = off2, edge = i;
      }
      side = UnpackNormal(triangle.edge_normals[edge]).dot(nearest.away);
    }
  }
  nearest.is_behind = side < 0;
  return nearest;
}

}  // namespace dhpmap

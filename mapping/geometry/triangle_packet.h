// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "mapping/base/vector_clones.h"

namespace dhpmap {

using TriangleCorners = std::array<Eigen::Vector3f, 3>;

/// Eight triangles side by side, measured in one pass. Unused lanes are NaN and near nothing.
struct alignas(32) TrianglePacket {
  static constexpr std::size_t kLanes = 8;

  float corners[3][3][kLanes];  ///< by corner and axis

  TrianglePacket() {
    for (auto& corner : corners) {
      for (auto& axis : corner) {
        for (float& value : axis) value = std::numeric_limits<float>::quiet_NaN();
      }
    }
  }
  void Set(std::size_t lane, const TriangleCorners& triangle) {
    for (std::size_t corner = 0; corner < 3; ++corner) {
      for (int axis = 0; axis < 3; ++axis) corners[corner][axis][lane] = triangle[corner][axis];
    }
  }
  [[nodiscard]] TriangleCorners Get(std::size_t lane) const {
    TriangleCorners triangle;
    for (std::size_t corner = 0; corner < 3; ++corner) {
      for (int axis = 0; axis < 3; ++axis) triangle[corner][axis] = corners[corner][axis][lane];
    }
    return triangle;
  }

  typedef float Float8 __attribute__((vector_size(32), may_alias));
  typedef std::int32_t Int8 __attribute__((vector_size(32), may_alias));
  /// Vectors from the triangles' nearest points, by lane.
  struct Away {
    Float8 x, y, z, squared;  ///< NaN for a triangle without an area; its neighbours have its edges
  };

  /// Each triangle against the point of the same lane. By the Voronoi regions of corners, edges and face, as
  /// NearestPointOf, but branch-free: selects numerators and denominator of a region, then divides.
  DHPMAP_ALWAYS_INLINE Away AwayFrom(const Float8 (&p)[3]) const {
    const auto at = [this](int corner, int axis) -> const Float8& {
      return *reinterpret_cast<const Float8*>(corners[corner][axis]);
    };
    const Float8 zero = {}, one = zero + 1;
    const Float8 ap_x = p[0] - at(0, 0), ap_y = p[1] - at(0, 1), ap_z = p[2] - at(0, 2);
    const Float8 ab_x = at(1, 0) - at(0, 0), ab_y = at(1, 1) - at(0, 1), ab_z = at(1, 2) - at(0, 2);
    const Float8 ac_x = at(2, 0) - at(0, 0), ac_y = at(2, 1) - at(0, 1), ac_z = at(2, 2) - at(0, 2);
    const Float8 ab_ap = ab_x * ap_x + ab_y * ap_y + ab_z * ap_z;
    const Float8 ac_ap = ac_x * ap_x + ac_y * ap_y + ac_z * ap_z;
    const Float8 ab_ac = ab_x * ac_x + ab_y * ac_y + ab_z * ac_z;
    const Float8 ab_bp = ab_ap - (ab_x * ab_x + ab_y * ab_y + ab_z * ab_z), ac_bp = ac_ap - ab_ac;
    const Float8 ab_cp = ab_ap - ab_ac, ac_cp = ac_ap - (ac_x * ac_x + ac_y * ac_y + ac_z * ac_z);
    const Float8 in_a = ab_bp * ac_cp - ab_cp * ac_bp;
    const Float8 in_b = ab_cp * ac_ap - ab_ap * ac_cp;
    const Float8 in_c = ab_ap * ac_bp - ab_bp * ac_ap;
    // From the face to the first corner: the last condition that holds wins.
    Float8 to_b = in_b, to_c = in_c, whole = in_a + in_b + in_c;
    const Float8 bc_c = ac_bp - ab_bp, bc_b = ab_cp - ac_cp;
    const Int8 on_bc = (in_a <= zero) & (bc_c >= zero) & (bc_b >= zero);
    to_b = on_bc ? bc_b : to_b;
    to_c = on_bc ? bc_c : to_c;
    whole = on_bc ? bc_b + bc_c : whole;
    const Int8 on_ac = (in_b <= zero) & (ac_ap >= zero) & (ac_cp <= zero);
    to_b = on_ac ? zero : to_b;
    to_c = on_ac ? ac_ap : to_c;
    whole = on_ac ? ac_ap - ac_cp : whole;
    const Int8 at_c = (ac_cp >= zero) & (ab_cp <= ac_cp);
    to_b = at_c ? zero : to_b;
    to_c = at_c ? one : to_c;
    whole = at_c ? one : whole;
    const Int8 on_ab = (in_c <= zero) & (ab_ap >= zero) & (ab_bp <= zero);
    to_b = on_ab ? ab_ap : to_b;
    to_c = on_ab ? zero : to_c;
    whole = on_ab ? ab_ap - ab_bp : whole;
    const Int8 at_b = (ab_bp >= zero) & (ac_bp <= ab_bp);
    to_b = at_b ? one : to_b;
    to_c = at_b ? zero : to_c;
    whole = at_b ? one : whole;
    const Int8 at_a = (ab_ap <= zero) & (ac_ap <= zero);
    to_b = at_a ? zero : to_b;
    to_c = at_a ? zero : to_c;
    whole = at_a ? one : whole;
    const Float8 share = 1 / whole, v = to_b * share, w = to_c * share;
    const Float8 x = ap_x - v * ab_x - w * ac_x;
    const Float8 y = ap_y - v * ab_y - w * ac_y;
    const Float8 z = ap_z - v * ab_z - w * ac_z;
    return {x, y, z, x * x + y * y + z * z};
  }

  /// Squared distances of the triangles from a point. Returns a bit for each within a finite limit; never for one
  /// without an area.
  DHPMAP_ALWAYS_INLINE unsigned Within(const Eigen::Vector3f& p, float limit2, float (&distance2)[kLanes]) const {
    typedef std::uint64_t Words __attribute__((vector_size(32), may_alias));
    const float px = p[0], py = p[1], pz = p[2];
    const Float8 p8[3] = {
        {px, px, px, px, px, px, px, px}, {py, py, py, py, py, py, py, py}, {pz, pz, pz, pz, pz, pz, pz, pz}};
    const Float8 squared = AwayFrom(p8).squared;
    *reinterpret_cast<Float8*>(distance2) = squared;
    const Int8 bits = {1, 2, 4, 8, 16, 32, 64, 128};
    const Int8 within = (squared <= Float8{} + limit2) & bits;
    const Words words = reinterpret_cast<const Words&>(within);
    const std::uint64_t folded = words[0] | words[1] | words[2] | words[3];
    return static_cast<unsigned>(folded | folded >> 32);
  }

  /// A bit for each triangle whose box, grown by a margin, the ray meets within a limit; may include unused lanes.
  /// `inverse`: reciprocals of the direction's coordinates, finite.
  DHPMAP_ALWAYS_INLINE unsigned Along(const Eigen::Vector3f& origin, const Eigen::Vector3f& inverse, float margin,
                                      float limit) const {
    typedef std::uint64_t Words __attribute__((vector_size(32), may_alias));
    Float8 enter = {}, leave = enter + limit;
    for (int axis = 0; axis < 3; ++axis) {
      const auto& a = *reinterpret_cast<const Float8*>(corners[0][axis]);
      const auto& b = *reinterpret_cast<const Float8*>(corners[1][axis]);
      const auto& c = *reinterpret_cast<const Float8*>(corners[2][axis]);
      Float8 low = a < b ? a : b, high = a < b ? b : a;
      low = c < low ? c : low;
      high = c > high ? c : high;
      const Float8 at_low = (low - margin - origin[axis]) * inverse[axis];
      const Float8 at_high = (high + margin - origin[axis]) * inverse[axis];
      const Float8 first = at_low < at_high ? at_low : at_high, last = at_low < at_high ? at_high : at_low;
      enter = first > enter ? first : enter;
      leave = last < leave ? last : leave;
    }
    const Int8 bits = {1, 2, 4, 8, 16, 32, 64, 128};
    const Int8 met = (enter <= leave) & bits;
    const Words words = reinterpret_cast<const Words&>(met);
    const std::uint64_t folded = words[0] | words[1] | words[2] | words[3];
    return static_cast<unsigned>(folded | folded >> 32);
  }
};

}  // namespace dhpmap

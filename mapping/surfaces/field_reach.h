// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <cstddef>
#include <limits>

namespace dhpmap {

/// Which boxes may hold a surface that is nearest to a point of a cell (a cube), as far as one point of a surface near
/// it tells. As the distance to a box is convex, it is nowhere less than its tangent in the cell's centre, and that
/// less the distance to the point is concave, so its least is at a corner of the cell.
class FieldReach {
 public:
  /// `half_m`: half a side of the cell. `horizon_m`: from its centre; what is farther is nearest to no point.
  /// `nearest`: the point of a surface, from the centre, along the map's axes.
  FieldReach(double half_m, double horizon_m, const Eigen::Vector3f& nearest) : FieldReach(horizon_m) {
    for (std::size_t k = 0; k < known_.size(); ++k) {
      const auto sign = [k](unsigned axis) { return (k >> axis & 1u) != 0 ? 1.0f : -1.0f; };
      offsets_[k] = static_cast<float>(half_m) * Eigen::Vector3f(sign(0), sign(1), sign(2));
      known_[k] = (offsets_[k] - nearest).norm();
    }
  }
  /// Nothing is known but that.
  explicit FieldReach(double horizon_m) : horizon_(static_cast<float>(horizon_m) + 1e-5f) {
    offsets_.fill(Eigen::Vector3f::Zero());
    known_.fill(std::numeric_limits<float>::infinity());
  }

  /// The same in a frame to whose axes `R_frame_map` turns those of the map; the centre is at `middle` there.
  [[nodiscard]] FieldReach In(const Eigen::Matrix3f& R_frame_map, const Eigen::Vector3f& middle) const {
    FieldReach turned = *this;
    for (Eigen::Vector3f& offset : turned.offsets_) offset = R_frame_map * offset;
    turned.middle_ = middle;
    return turned;
  }
  /// The same in a frame of the same axes.
  [[nodiscard]] FieldReach At(const Eigen::Vector3f& middle) const {
    FieldReach moved = *this;
    moved.middle_ = middle;
    return moved;
  }

  bool operator()(const Eigen::AlignedBox3f& box) const {
    const Eigen::Vector3f away = middle_ - middle_.cwiseMax(box.min()).cwiseMin(box.max());
    const float distance = away.norm();
    if (distance > horizon_) return false;
    const float rounding = 1e-5f + 1e-6f * middle_.cwiseAbs().maxCoeff();
    if (distance < rounding) return true;
    for (std::size_t k = 0; k < known_.size(); ++k) {
      if (distance + away.dot(offsets_[k]) / distance < known_[k] + rounding) return true;
    }
    return false;
  }

 private:
  Eigen::Vector3f middle_ = Eigen::Vector3f::Zero();
  std::array<Eigen::Vector3f, 8> offsets_;  ///< of the corners
  std::array<float, 8> known_;              ///< that far from them there is a surface, all in one point
  float horizon_;
};

}  // namespace dhpmap

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <cstddef>
#include <limits>

namespace dhpmap {

/// Tests which boxes may contain the nearest surface to a point of a cell (a cube), given one known surface point. The
/// distance to a box is convex, so it is never below its tangent at the cell's centre. The tangent minus the distance
/// to the known point is concave, so its minimum is at a corner of the cell.
class FieldReach {
 public:
  /// `half_m`: half a side of the cell. `horizon_m`: surfaces farther than this from its centre are the nearest to no
  /// point of the cell. `nearest`: the known surface point, relative to the centre, along the map's axes.
  FieldReach(double half_m, double horizon_m, const Eigen::Vector3f& nearest) : FieldReach(horizon_m) {
    for (std::size_t k = 0; k < known_.size(); ++k) {
      const auto sign = [k](unsigned axis) { return (k >> axis & 1u) != 0 ? 1.0f : -1.0f; };
      offsets_[k] = static_cast<float>(half_m) * Eigen::Vector3f(sign(0), sign(1), sign(2));
      known_[k] = (offsets_[k] - nearest).norm();
    }
  }
  /// Without a known surface point.
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
  std::array<float, 8> known_;              ///< distances of the known surface point from the corners
  float horizon_;
};

}  // namespace dhpmap

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "mapping/geometry/triangle_packet.h"
#include "mapping/submap/submap.h"
#include "mapping/surfaces/field_reach.h"
#include "mapping/surfaces/surface_ledger.h"

namespace dhpmap {

/// The few triangles that matter to each place of one cell (a block of a map's grid), so that nobody need search for
/// them: cubes down to half a voxel, each with a list of which, for every point of the cube, one is no farther than the
/// nearest of the map and the tolerance; near surfaces, where side and direction turn on it, the nearest itself. Holds
/// copies in the map's axes, and no part of a state, so that it serves all states in which nothing near has changed.
/// Immutable, thread-safe.
class NearField {
 public:
  /// Distances are too long by no more than this, and no longer than kShare of themselves.
  static constexpr double kTolerance_vox = 0.4, kShare = 0.08;
  /// Of a cell farther from all surfaces nothing is known but that.
  static constexpr double kReach_m = 3.3;

  /// Of what is nearest to a point.
  struct Nearest {
    Eigen::Vector3f away;    ///< from the surface to the point, the map's axes
    Eigen::Vector3f normal;  ///< of the surface at its nearest point, to the front; of any length but 0
    bool is_behind = false;
    bool is_across = false;    ///< from the face, rather than from an edge or a corner of it
    std::uint32_t submap = 0;  ///< position in submaps()
  };
  /// The triangles for a place.
  struct List {
    std::uint32_t first = 0, count = 0;  ///< none: not known
    bool is_side_known = true;           ///< else is_behind may be wrong
    bool may_end = false;                ///< some surface may end where one of its points has its nearest
  };

  [[nodiscard]] const Eigen::Vector3d& centre_m() const { return centre_m_; }
  /// Whether all surfaces are farther than kReach_m from each point.
  [[nodiscard]] bool is_far() const { return is_far_; }
  /// What lies farther than this from the centre is nearest to no point.
  [[nodiscard]] double horizon_m() const { return horizon_m_; }
  /// Where else a surface would have to be to be nearest to one of its points; of the frame at the centre.
  [[nodiscard]] FieldReach Reach() const {
    return is_far_ ? FieldReach(horizon_m_) : FieldReach(double{half_}, horizon_m_, nearest_);
  }
  /// Those of what it holds, and of what else is nearest to any of its points.
  [[nodiscard]] const std::vector<SubmapId>& submaps() const { return submaps_; }
  /// Which others must be there for what it holds of one of them to be (TriangleTree::NeededBy).
  [[nodiscard]] std::span<const SubmapId> needed(std::uint32_t position) const { return needed_[position]; }
  [[nodiscard]] std::size_t MemoryBytes() const;
  [[nodiscard]] std::size_t num_triangles() const { return triangles_.size(); }

  // Of a point of the cell, from its centre, in steps: what the next one will look at may be fetched before. None if
  // is_far().

  /// Which of the smallest cubes that is.
  [[nodiscard]] std::uint32_t CubeAt(const Eigen::Vector3f& p) const {
    return CodeOf(p[0]) | CodeOf(p[1]) << 1 | CodeOf(p[2]) << 2;
  }
  void PrefetchCube(std::uint32_t cube) const { __builtin_prefetch(&grid_[cube >> grid_shift_]); }
  [[nodiscard]] List ListOf(std::uint32_t cube) const {
    std::uint32_t at = grid_[cube >> grid_shift_];
    for (int shift = grid_shift_ - 3; (at & kLeaf) == 0; shift -= 3) at = nodes_[at][cube >> shift & 7u];
    return {at & (kMostListed - 1), at >> kCountShift & kMostInList, (at & kUnsure) == 0, (at & kMayEnd) != 0};
  }
  void Prefetch(const List& list) const { __builtin_prefetch(&lists_[list.first]); }
  void PrefetchTriangles(const List& list) const {
    const std::uint32_t some = list.count < 8 ? list.count : 8;
    for (std::uint32_t i = 0; i < some; ++i) __builtin_prefetch(&triangles_[lists_[list.first + i]]);
  }
  /// `list`: of the point; not empty.
  [[nodiscard]] Nearest Find(const Eigen::Vector3f& p, const List& list) const;

  NearField(const NearField&) = delete;
  NearField& operator=(const NearField&) = delete;
  ~NearField();

 private:
  friend class NearFieldMaker;
  // A leaf: bit 31, whether the side is unsure, the length of its list in 7 bits, whether surfaces may end there, where
  // the list begins in 22. Else a node.
  static constexpr std::uint32_t kLeaf = 1u << 31, kUnsure = 1u << 30, kCountShift = 23, kMayEnd = 1u << 22,
                                 kMostListed = 1u << 22, kMostInList = 127;
  static constexpr int kLevels = 4;  ///< of eight children each: cubes down to a sixteenth of the cell
  struct alignas(64) Triangle {
    float corners[3][3];
    std::uint32_t corner_normals[3];  ///< see PackNormal
    std::uint32_t edge_normals[3];    ///< from each corner to the next
    std::uint16_t submap;
  };
  /// A direction in ten bits a coordinate.
  [[nodiscard]] static std::uint32_t PackNormal(const Eigen::Vector3f& normal);
  [[nodiscard]] static Eigen::Vector3f UnpackNormal(std::uint32_t packed);

  explicit NearField(std::shared_ptr<SurfaceLedger> ledger) : ledger_(std::move(ledger)) {}
  /// Of the sixteenth at a coordinate, two places between each two bits.
  [[nodiscard]] std::uint32_t CodeOf(float at) const {
    constexpr std::array<std::uint16_t, 16> kSpread = {0,     1,     010,   011,   0100,  0101,  0110,  0111,
                                                       01000, 01001, 01010, 01011, 01100, 01101, 01110, 01111};
    const int cell = static_cast<int>((at + half_) * scale_);
    return kSpread[static_cast<std::size_t>(cell < 0 ? 0 : cell > 15 ? 15 : cell)];
  }
  [[nodiscard]] static TriangleCorners CornersOf(const Triangle& triangle);
  [[nodiscard]] std::uint32_t NearestOfTwo(const Eigen::Vector3f& p, std::uint32_t first) const;
  [[nodiscard]] std::uint32_t NearestOf(const Eigen::Vector3f& p, const List& list) const;

  Eigen::Vector3d centre_m_ = Eigen::Vector3d::Zero();
  bool is_far_ = false;
  double horizon_m_ = 0;
  Eigen::Vector3f nearest_ = Eigen::Vector3f::Zero();  ///< point of a surface to the centre, from there; not if far
  float half_ = 0, scale_ = 0;                         ///< half a side; sixteenths a metre
  int grid_shift_ = 0;
  std::vector<std::uint32_t> grid_;  ///< leaves or nodes of all cubes of one size, along the curve of CubeAt
  std::vector<std::array<std::uint32_t, 8>> nodes_;
  std::vector<std::uint16_t> lists_;  ///< of triangles
  std::vector<Triangle> triangles_;
  std::vector<SubmapId> submaps_;              ///< one may come several times,
  std::vector<std::vector<SubmapId>> needed_;  ///< with what its triangles need
  std::size_t counted_bytes_ = 0;              ///< in the ledger
  const std::shared_ptr<SurfaceLedger> ledger_;
};

}  // namespace dhpmap

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

/// The nearest triangles for each place of one cell (a block of a map's grid), so that queries need no search. The cell
/// is divided into cubes down to half a voxel, each with a short list of triangles. For every point of the cube, the
/// list has a triangle that is at most the tolerance farther than the map's nearest one; near surfaces, where side and
/// direction depend on it, the nearest triangle itself. Holds copies in the map's axes and no part of a state, so it is
/// valid for all states in which nothing near has changed. Immutable, thread-safe.
class NearField {
 public:
  /// Distances are overestimated by at most this, and by at most the fraction kShare.
  static constexpr double kTolerance_vox = 0.4, kShare = 0.08;
  /// For a cell farther than this from all surfaces, only this fact is known.
  static constexpr double kReach_m = 3.3;

  /// The nearest surface to a point.
  struct Nearest {
    Eigen::Vector3f away;    ///< from the surface to the point, the map's axes
    Eigen::Vector3f normal;  ///< of the surface at its nearest point, to the front; of any length except 0
    bool is_behind = false;
    bool is_across = false;    ///< the nearest point is on a face, not on an edge or a corner
    std::uint32_t submap = 0;  ///< position in submaps()
  };
  /// The triangles for a place.
  struct List {
    std::uint32_t first = 0, count = 0;  ///< empty: unknown
    bool is_side_known = true;           ///< else is_behind may be wrong
    bool may_end = false;                ///< the nearest point of some place may be on the border of a surface
  };

  [[nodiscard]] const Eigen::Vector3d& centre_m() const { return centre_m_; }
  /// Whether all surfaces are farther than kReach_m from each point.
  [[nodiscard]] bool is_far() const { return is_far_; }
  /// A surface farther than this from the centre is the nearest to no point of the cell.
  [[nodiscard]] double horizon_m() const { return horizon_m_; }
  /// The region in which another surface could be the nearest to a point of the cell; relative to the centre.
  [[nodiscard]] FieldReach Reach() const {
    return is_far_ ? FieldReach(horizon_m_) : FieldReach(double{half_}, horizon_m_, nearest_);
  }
  /// The submaps of its triangles, and of other surfaces that are the nearest to one of its points.
  [[nodiscard]] const std::vector<SubmapId>& submaps() const { return submaps_; }
  /// The other submaps that the triangles of the submap at this position need (TriangleTree::NeededBy).
  [[nodiscard]] std::span<const SubmapId> needed(std::uint32_t position) const { return needed_[position]; }
  [[nodiscard]] std::size_t MemoryBytes() const;
  [[nodiscard]] std::size_t num_triangles() const { return triangles_.size(); }

  // Lookup of a point, relative to the cell's centre, in steps, so that the data of the next step can be prefetched.
  // Not if is_far().

  /// The smallest cube that contains the point.
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
  // A leaf: bit 31 set, one bit for an unsure side, the length of its list in 7 bits, one bit for may_end, the start of
  // the list in 22. Without bit 31: a node.
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
  std::vector<SubmapId> submaps_;              ///< may repeat an id,
  std::vector<std::vector<SubmapId>> needed_;  ///< with different needs of its triangles
  std::size_t counted_bytes_ = 0;              ///< in the ledger
  const std::shared_ptr<SurfaceLedger> ledger_;
};

}  // namespace dhpmap

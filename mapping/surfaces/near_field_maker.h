// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "mapping/base/grid.h"
#include "mapping/geometry/triangle_packet.h"
#include "mapping/surfaces/field_reach.h"
#include "mapping/surfaces/near_field.h"
#include "mapping/surfaces/surface_cache.h"

namespace dhpmap {

/// Computes near fields. Reuses its scratch memory: one owner, not thread-safe. A triangle is left out of a cube if
/// another one is nearer, or not much farther, at all points of the cube. The distance to a triangle is convex, so it
/// is never below its tangent at the cube's centre. The tangent minus the distance to the other triangle is concave, so
/// its minimum is at one of the eight corners.
class NearFieldMaker {
 public:
  explicit NearFieldMaker(const MapSurfaces& surfaces) : surfaces_(surfaces) {}

  /// Null: too many triangles are near.
  [[nodiscard]] std::shared_ptr<const NearField> Make(BlockIndex block, std::shared_ptr<SurfaceLedger> ledger);

 private:
  static constexpr std::size_t kLanes = TrianglePacket::kLanes;
  using Float8 = TrianglePacket::Float8;
  /// Candidates of a cube.
  struct Pool {
    std::vector<TrianglePacket> packets;
    std::vector<std::uint32_t> ids;  ///< by lane
    void Clear();
    void Add(const TriangleCorners& triangle, std::uint32_t id);
  };
  /// Distances of eight candidates from the cube's centre, and their gradients.
  struct Tangents {
    alignas(32) float distance[kLanes];  ///< infinite: there is none
    alignas(32) float slope[3][kLanes];
  };
  using AtCorners = std::array<float, 8>;

  void Gather(const Eigen::Vector3d& centre_m, const FieldReach& reach);
  std::uint32_t Divide(std::size_t level, const Eigen::Vector3f& middle, float half);
  void Measure(const Pool& pool, const Eigen::Vector3f& middle, float half);
  static void MeasureSides(const TrianglePacket& packet, const Float8 (&middle)[3], float half, std::uint8_t& front,
                           std::uint8_t& back);
  [[nodiscard]] bool IsOneSided() const;
  void Thin(const Pool& pool, const Eigen::Vector3f& middle, float half, float slack, int num_rounds);
  [[nodiscard]] static AtCorners DistancesAtCorners(const TriangleCorners& triangle, const Eigen::Vector3f& middle,
                                                    float half);
  void DropFarther(const AtCorners& other, float half, float slack);
  [[nodiscard]] std::size_t NumAlive() const;
  void Compact(const Pool& from, Pool& to) const;
  /// A leaf during construction: its list, and the triangles that are nearest to one of its points.
  struct Leaf {
    std::uint32_t first = 0, count = 0;  ///< in the field's lists
    bool is_unsure = false;
    std::uint32_t first_exact = 0, num_exact = 0;  ///< in exact_
  };
  std::uint32_t MakeLeaf(const Pool& pool, bool is_unsure);
  void List(const Pool& pool, Leaf& leaf);
  [[nodiscard]] std::uint32_t CodeOf(const Leaf& leaf) const;
  void Lay(std::uint32_t root);
  std::uint32_t Copy(std::uint32_t at);
  /// Of a submap in MapSurfaces: its position in the field's.
  std::uint16_t NumberInField(std::uint32_t id);
  std::uint16_t Keep(std::uint32_t id, const TriangleCorners& triangle);
  void AddNormals();

  const MapSurfaces& surfaces_;
  std::array<Pool, NearField::kLevels + 1> pools_;   ///< by level
  std::vector<std::array<std::uint32_t, 8>> nodes_;  ///< other nodes, or the number of a leaf with NearField::kLeaf
  std::vector<Leaf> leaves_;
  std::vector<std::uint32_t> exact_;    ///< candidates, leaf by leaf
  std::vector<bool> may_end_;           ///< by candidate in exact_: a surface ends, or may end, on its border
  std::vector<std::uint32_t> numbers_;  ///< of the submaps, by candidate
  std::vector<std::span<const SubmapId>> needed_;  ///< the other submaps that each candidate needs
  std::vector<Tangents> tangents_;
  std::vector<std::uint8_t> alive_, saved_, picked_, front_, back_;  ///< a bit a lane
  std::vector<std::uint16_t> kept_;                                  ///< by candidate
  std::vector<std::uint32_t> alone_;  ///< by triangle, position of the list that has only this triangle
  std::vector<std::pair<float, std::uint32_t>> listed_;
  float most_tolerance_ = 0;
  bool has_failed_ = false;
  NearField* field_ = nullptr;
};

}  // namespace dhpmap

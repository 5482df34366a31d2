// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <stop_token>
#include <vector>

#include "mapping/geometry/triangle_packet.h"
#include "mapping/query/query_world.h"
#include "mapping/query/slice_options.h"

namespace dhpmap {

/// The cells of a slice that contain surface within its band, each with the owner of most of it, by area. Uses the same
/// triangles as checks of bodies, clipped to the band and the cell. Works on a few rows at a time; rows may be
/// requested in any order. One owner, not thread-safe.
class SliceSurface {
 public:
  /// Both outlive this.
  SliceSurface(const QueryWorld& world, const SliceOptions& options);

  static constexpr std::uint32_t kNobody = 0xFFFFFFFFu;
  /// For each cell of a row the number of the submap in MapSurfaces; kNobody: no surface. Valid until the next call;
  /// invalid after a `stop` request.
  [[nodiscard]] const std::uint32_t* Row(int y, const std::stop_token& stop);

 private:
  struct Part {
    std::uint32_t cell;  ///< of the strip
    std::uint32_t number;
    double area_m2;
  };
  void FillStrip(int first_row, const std::stop_token& stop);
  void Visit(int first_column, int end_column, const std::stop_token& stop);
  /// A triangle of the slice's frame, for cells of some columns.
  void Add(const std::array<Eigen::Vector3d, 3>& triangle, std::uint32_t number, int first_column, int end_column);
  void Conclude();

  const QueryWorld& world_;
  const SliceOptions& options_;
  const Transform T_query_map_;
  int strip_ = -1;                     ///< that is filled; -1: none
  std::vector<Part> parts_;            ///< of the strip
  std::vector<std::uint32_t> owners_;  ///< by cell of the strip
};

}  // namespace dhpmap

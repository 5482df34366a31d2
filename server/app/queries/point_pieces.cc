// SPDX-License-Identifier: BSD-3-Clause
#include "server/app/queries/point_pieces.h"

#include <algorithm>

#include "mapping/geometry/point_order.h"

namespace dhpmap {

std::vector<std::span<const Eigen::Vector3d>> BatchesOf(std::span<const Eigen::Vector3d> points_m) {
  constexpr std::size_t kMost = 8192;
  const std::size_t num_batches = (points_m.size() + kMost - 1) / kMost;
  std::vector<std::span<const Eigen::Vector3d>> batches;
  for (std::size_t i = 0; i < num_batches; ++i) {
    const std::size_t begin = i * points_m.size() / num_batches, end = (i + 1) * points_m.size() / num_batches;
    batches.push_back(points_m.subspan(begin, end - begin));
  }
  return batches;
}

void SpreadAlongCurve(std::span<const Eigen::Vector3d> batch, const Spread& spread,
                      const std::function<void(std::span<const std::uint32_t>)>& body) {
  constexpr std::size_t kPiece = 1024;  // about 0.3 ms
  const std::vector<std::uint32_t> order = OrderAlongCurve(batch);
  spread((order.size() + kPiece - 1) / kPiece, [&](std::size_t i) {
    const std::size_t begin = i * kPiece;
    body(std::span(order).subspan(begin, std::min(kPiece, order.size() - begin)));
  });
}

}  // namespace dhpmap

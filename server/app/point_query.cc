// SPDX-License-Identifier: BSD-3-Clause
#include "server/app/point_query.h"

#include <algorithm>
#include <cstddef>
#include <vector>

#include "mapping/query/point_order.h"

namespace dhpmap {

Status LookUpPoints(const MapView& view, std::span<const Eigen::Vector3d> points_m, const std::stop_token& stop,
                    const std::function<void(const PointInfo&)>& take) {
  constexpr std::size_t kBatch = 8'192;  // between two, whoever has given up is seen
  std::vector<PointInfo> answers;
  for (std::size_t first = 0; first < points_m.size(); first += kBatch) {
    if (stop.stop_requested()) return Cancelled("the client went away");
    const auto batch = points_m.subspan(first, std::min(kBatch, points_m.size() - first));
    answers.resize(batch.size());
    for (const std::uint32_t i : OrderAlongCurve(batch)) answers[i] = view.lookup().At(batch[i]);
    for (const PointInfo& answer : answers) take(answer);
  }
  return Status::Ok();
}

}  // namespace dhpmap

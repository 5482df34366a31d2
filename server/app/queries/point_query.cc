// SPDX-License-Identifier: BSD-3-Clause
#include "server/app/queries/point_query.h"

#include <vector>

#include "server/app/queries/point_pieces.h"

namespace dhpmap {

Status LookUpPoints(const MapView& view, std::span<const Eigen::Vector3d> points_m, const std::stop_token& stop,
                    const Spread& spread, const std::function<void(const PointInfo&)>& take) {
  std::vector<PointInfo> answers;
  for (const auto batch : BatchesOf(points_m)) {
    answers.resize(batch.size());
    const PointLookup& lookup = view.lookup();
    SpreadAlongCurve(batch, spread, [&](std::span<const std::uint32_t> piece) {
      if (stop.stop_requested()) return;
      for (const std::uint32_t i : piece) answers[i] = lookup.At(batch[i]);
    });
    if (stop.stop_requested()) return Cancelled("the client went away");
    for (const PointInfo& answer : answers) take(answer);
  }
  return Status::Ok();
}

}  // namespace dhpmap

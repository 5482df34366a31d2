// SPDX-License-Identifier: BSD-3-Clause
#include "server/app/point_query.h"

#include <cstddef>

namespace dhpmap {
namespace {

constexpr std::size_t kPointsBetweenStops = 4096;

}  // namespace

Status LookUpPoints(const MapView& view, std::span<const Eigen::Vector3d> points_m, const std::stop_token& stop,
                    const std::function<void(const PointInfo&)>& take) {
  for (std::size_t i = 0; i < points_m.size(); ++i) {
    if (i % kPointsBetweenStops == 0 && stop.stop_requested()) return Cancelled("the client went away");
    take(view.lookup().At(points_m[i]));
  }
  return Status::Ok();
}

}  // namespace dhpmap

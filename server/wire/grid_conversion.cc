// SPDX-License-Identifier: BSD-3-Clause
#include "server/wire/grid_conversion.h"

#include <cmath>
#include <string>

#include "proto/types/pose_conversion.h"
#include "proto/types/resource_names.h"
#include "server/wire/distance_conversion.h"
#include "server/wire/query_options.h"

namespace dhpmap {
namespace {

constexpr double kMostNodes = 16e6;
constexpr std::size_t kBytesPerNode = 4 + 12 + 10 + 1;  // an id of -1 takes ten bytes
static_assert(DistanceGrid::kMostInBatch * kBytesPerNode + 1024 <= 256 * 1024);

Status BadGrid(const std::string& field, const std::string& what) {
  return InvalidArgument("the grid cannot be made").WithReason("BAD_POINTS").WithViolation(field, what);
}

}  // namespace

Result<GridQuestion> GridQuestionFromProto(const v1::QueryDistanceGridRequest& request, const MapSnapshot& map) {
  const Eigen::Vector3d low = VectorFromProto(request.box().min_m()), high = VectorFromProto(request.box().max_m());
  if (!(low.array().abs() <= kReach_m).all()) return BadGrid("box.min_m", "is not within 1,000,000 m");
  if (!(high.array().abs() <= kReach_m).all()) return BadGrid("box.max_m", "is not within 1,000,000 m");
  if (!(low.array() <= high.array()).all()) return BadGrid("box.max_m", "is below min_m");
  const double resolution_m = request.resolution_m();
  if (!(resolution_m >= kLeastResolution_m && resolution_m <= kMostResolution_m)) {
    return BadGrid("resolution_m", "is not from 0.001 to 100");
  }
  const Eigen::Array3d size = ((high - low).array() / resolution_m + 1e-6).floor() + 1;
  if (size.prod() > kMostNodes) {
    return BadGrid("box", "has more than 16,000,000 nodes: ask for a part, or a coarser grid");
  }
  GridQuestion question{.corner_m = low, .resolution_m = resolution_m};
  question.size = size.cast<std::int64_t>().matrix();
  if (request.options().min_revision() != 0) return BadGrid("options.min_revision", "has no meaning for this query");
  DHPMAP_ASSIGN_OR_RETURN(question.distances, QueryOptionsFromProto(request.options(), map, kDistanceOptions));
  return question;
}

Result<bool> GridChunks::Next(v1::QueryDistanceGridResponse& message, const std::stop_token& stop) {
  if (grid_.is_done()) return false;
  message.set_revision(grid_.view().snapshot().revision());
  message.set_first_node(grid_.next());
  if (grid_.next() == 0) {
    message.set_num_x(static_cast<int>(grid_.question().size.x()));
    message.set_num_y(static_cast<int>(grid_.question().size.y()));
    message.set_num_z(static_cast<int>(grid_.question().size.z()));
  }
  DHPMAP_ASSIGN_OR_RETURN(const auto answers, grid_.NextBatch(stop));
  message.mutable_distance_m()->Reserve(static_cast<int>(answers.size()));
  for (const SurfaceDistance& answer : answers) {
    message.add_distance_m(static_cast<float>(answer.distance_m));
    message.add_status(StatusToProto(answer.status));
    for (int axis = 0; with_gradients_ && axis < 3; ++axis) {
      message.add_gradient(static_cast<float>(answer.gradient[axis]));
    }
    if (with_objects_)
      message.add_instance_id(answer.submap == nullptr ? kNobodysId : std::int64_t{answer.submap->id.value});
  }
  return true;
}

}  // namespace dhpmap

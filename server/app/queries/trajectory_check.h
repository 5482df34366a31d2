// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <stop_token>

#include "mapping/base/result.h"
#include "mapping/query/trajectory_query.h"
#include "server/app/queries/body_check.h"
#include "server/app/states/map_view.h"

namespace dhpmap {

/// Checks motions in the query's frame (`motion_of` returns them by number), in pieces as BodyCheck; a single motion is
/// never divided. Thread-compatible.
class TrajectoryCheck {
 public:
  using MotionOf = std::function<RobotMotion(std::size_t)>;
  /// The cache outlives this.
  TrajectoryCheck(std::shared_ptr<const MapSnapshot> state, SurfaceCache& cache, CheckQuestion question,
                  std::size_t num_motions, MotionOf motion_of, std::int64_t most_work = kMostCheckWork);

  /// As BodyCheck::Next; RESOURCE_EXHAUSTED also for an attached object that is too large.
  Result<bool> Next(const CheckPiece& piece, const std::stop_token& stop,
                    const std::function<void(const TrajectoryAnswer&)>& take);

 private:
  /// Makes a query for some motions: between two queries the cache may evict surfaces.
  Status MakeQuery(const std::stop_token& stop);

  const std::shared_ptr<const MapSnapshot> state_;
  SurfaceCache& cache_;
  const CheckQuestion question_;
  const std::size_t num_motions_;
  const MotionOf motion_of_;
  std::optional<TrajectoryQuery> query_;
  std::size_t query_ends_ = 0;  ///< before this motion
  std::size_t next_ = 0;
  std::int64_t work_left_;
};

/// Runs all pieces.
Status CheckTrajectories(const MapView& view, SurfaceCache& cache, const CheckQuestion& question,
                         std::size_t num_motions, const std::function<RobotMotion(std::size_t)>& motion_of,
                         const std::stop_token& stop, const std::function<void(const TrajectoryAnswer&)>& take);

}  // namespace dhpmap

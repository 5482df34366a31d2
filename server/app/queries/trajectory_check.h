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

/// Can robots go along these motions (in the asker's frame; `motion_of` gives them by number)? Answered piece by piece,
/// as BodyCheck; one motion is always answered in one. Thread-compatible.
class TrajectoryCheck {
 public:
  using MotionOf = std::function<RobotMotion(std::size_t)>;
  /// The cache outlives this.
  TrajectoryCheck(std::shared_ptr<const MapSnapshot> state, SurfaceCache& cache, CheckQuestion question,
                  std::size_t num_motions, MotionOf motion_of, std::int64_t most_work = kMostCheckWork);

  /// As BodyCheck::Next; RESOURCE_EXHAUSTED also for something attached that no robot carries.
  Result<bool> Next(const CheckPiece& piece, const std::stop_token& stop,
                    const std::function<void(const TrajectoryAnswer&)>& take);

 private:
  /// One for some motions: between two the cache may let go of surfaces.
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

/// All of it at once.
Status CheckTrajectories(const MapView& view, SurfaceCache& cache, const CheckQuestion& question,
                         std::size_t num_motions, const std::function<RobotMotion(std::size_t)>& motion_of,
                         const std::stop_token& stop, const std::function<void(const TrajectoryAnswer&)>& take);

}  // namespace dhpmap

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <stop_token>
#include <vector>

#include "mapping/base/result.h"
#include "mapping/query/body_query.h"
#include "mapping/query/touch_lists.h"
#include "server/app/queries/check_piece.h"
#include "server/app/states/map_view.h"

namespace dhpmap {

/// An object attached to the robot.
struct AttachedSubmap {
  SubmapId submap;
  Transform T_robot_submap = Transform::Identity();
  std::vector<SubmapId> may_touch;
};

/// Options of a check, for each body or motion.
struct CheckQuestion {
  BodyOptions options;
  Transform T_map_query = Transform::Identity();  ///< transform of the query's frame
  std::vector<AttachedSubmap> attached;
  TouchLists parts{};            ///< allowed contacts of each body, or sphere of a motion
  std::size_t max_contacts = 1;  ///< of each; 0: only whether there is one
  bool with_clearance = false;   ///< of motions: compute the clearance
};

/// Transforms a contact from the map's frame to that of the query.
void MoveContact(const Transform& T_query_map, BodyContact& contact);

/// Collision check of bodies in the query's frame, in pieces, so that other requests get their turns.
/// Thread-compatible.
class BodyCheck {
 public:
  /// The cache and the bodies outlive this.
  BodyCheck(std::shared_ptr<const MapSnapshot> state, SurfaceCache& cache, CheckQuestion question,
            std::span<const Body> bodies, std::int64_t most_work = kMostCheckWork);

  /// Passes the next answers, in the query's frame and in order, to `take`; references are valid as long as the state.
  /// Computes missing surfaces. True if there are more. CANCELLED soon after a `stop` request; RESOURCE_EXHAUSTED once
  /// the work budget is spent.
  Result<bool> Next(const CheckPiece& piece, const std::stop_token& stop,
                    const std::function<void(const BodyAnswer&)>& take);

 private:
  const std::shared_ptr<const MapSnapshot> state_;
  SurfaceCache& cache_;
  const CheckQuestion question_;
  const std::span<const Body> bodies_;
  std::size_t next_ = 0;
  std::int64_t work_left_;
};

/// Runs all pieces.
Status CheckBodies(const MapView& view, SurfaceCache& cache, const CheckQuestion& question,
                   std::span<const Body> bodies, const std::stop_token& stop,
                   const std::function<void(const BodyAnswer&)>& take);

}  // namespace dhpmap

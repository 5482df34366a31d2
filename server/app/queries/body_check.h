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

/// Something that the robot carries.
struct CarriedSubmap {
  SubmapId submap;
  Transform T_robot_submap = Transform::Identity();
  std::vector<SubmapId> may_touch;
};

/// What is asked of each body, or motion.
struct CheckQuestion {
  BodyOptions options;
  Transform T_map_query = Transform::Identity();  ///< from the asker's frame
  std::vector<CarriedSubmap> attached;
  TouchLists parts{};            ///< what each body, or sphere of a motion, may touch
  std::size_t max_contacts = 1;  ///< of each; 0: whether there is one is all that is asked
  bool with_clearance = false;   ///< of motions: how near each comes to surfaces
};

/// A contact, from the map's frame to that of the asker.
void MoveContact(const Transform& T_query_map, BodyContact& contact);

/// Do these bodies (in the asker's frame) touch anything? Answered piece by piece, so that others have their turns
/// between two. Thread-compatible.
class BodyCheck {
 public:
  /// The cache and the bodies outlive this.
  BodyCheck(std::shared_ptr<const MapSnapshot> state, SurfaceCache& cache, CheckQuestion question,
            std::span<const Body> bodies, std::int64_t most_work = kMostCheckWork);

  /// Hands the next answers, in the asker's frame, to `take` in their order; what they refer to stays as long as the
  /// state. Surfaces that are not in the cache are made meanwhile. True if there are more. CANCELLED soon after `stop`
  /// is requested; RESOURCE_EXHAUSTED once all that it may cost is spent.
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

/// All of it at once.
Status CheckBodies(const MapView& view, SurfaceCache& cache, const CheckQuestion& question,
                   std::span<const Body> bodies, const std::stop_token& stop,
                   const std::function<void(const BodyAnswer&)>& take);

}  // namespace dhpmap

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "dhpmap/v1/collision.pb.h"
#include "mapping/map/map.h"
#include "mapping/query/trajectory_query.h"
#include "server/app/queries/body_check.h"
#include "server/wire/allowed_collisions.h"

namespace dhpmap {

/// The motions of a request, which are sound. The request and what is attached outlive this.
class RequestedMotions {
 public:
  /// INVALID_ARGUMENT for lists that do not go together, more than `max_spheres` spheres at waypoints, or one of them,
  /// or a pose, that is not usable; it names the item.
  static Result<RequestedMotions> Make(const v1::CheckTrajectoryRequest& request,
                                       const std::vector<CarriedSubmap>& attached, std::int64_t max_spheres);

  [[nodiscard]] std::size_t size() const { return size_; }
  /// In the asker's frame.
  [[nodiscard]] RobotMotion operator[](std::size_t number) const;

 private:
  RequestedMotions(const v1::CheckTrajectoryRequest& request, const std::vector<CarriedSubmap>& attached,
                   std::size_t size)
      : request_(request), attached_(attached), size_(size) {}
  [[nodiscard]] RobotMotion Packed(std::size_t number) const;
  [[nodiscard]] RobotMotion Rigid(std::size_t number) const;

  const v1::CheckTrajectoryRequest& request_;
  const std::vector<CarriedSubmap>& attached_;
  std::size_t size_;
};

/// How many spheres at waypoints a request has, if its lists go together: what it costs.
std::size_t NumSpheres(const v1::CheckTrajectoryRequest& request);

/// Which link each sphere of the robot belongs to.
RequestedLinks LinksOf(const v1::CheckTrajectoryRequest& request);

/// See CheckCollisionsRequest; at least one.
Result<std::size_t> MaxContactsFromProto(const v1::CheckTrajectoryRequest& request);

/// What answering takes of memory at most: a motion, the answer, and the answer as bytes.
std::size_t BytesOfAnswers(const v1::CheckTrajectoryRequest& request);

/// Writes answers, trajectory by trajectory, in the form that the request asks for.
class TrajectoryAnswers {
 public:
  /// Of the state `map` of a map. The request and the response outlive this.
  TrajectoryAnswers(const v1::CheckTrajectoryRequest& request, const MapInfo& map,
                    v1::CheckTrajectoryResponse& response);
  void Append(const TrajectoryAnswer& answer);

 private:
  void AppendPacked(const TrajectoryAnswer& answer);
  void WriteClearance(const TrajectoryClearance& clearance, v1::Clearance& proto) const;

  const v1::CheckTrajectoryRequest& request_;
  const MapInfo& map_;
  v1::CheckTrajectoryResponse& response_;
};

}  // namespace dhpmap

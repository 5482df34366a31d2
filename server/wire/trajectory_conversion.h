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

/// The validated motions of a request. The request and its attached objects outlive this.
class RequestedMotions {
 public:
  /// INVALID_ARGUMENT for mismatched lists, more than `max_spheres` spheres at waypoints, or an invalid sphere or pose;
  /// names the item.
  static Result<RequestedMotions> Make(const v1::CheckTrajectoryRequest& request,
                                       const std::vector<AttachedSubmap>& attached, std::int64_t max_spheres);

  [[nodiscard]] std::size_t size() const { return size_; }
  /// In the query's frame.
  [[nodiscard]] RobotMotion operator[](std::size_t number) const;

 private:
  RequestedMotions(const v1::CheckTrajectoryRequest& request, const std::vector<AttachedSubmap>& attached,
                   std::size_t size)
      : request_(request), attached_(attached), size_(size) {}
  [[nodiscard]] RobotMotion Packed(std::size_t number) const;
  [[nodiscard]] RobotMotion Rigid(std::size_t number) const;

  const v1::CheckTrajectoryRequest& request_;
  const std::vector<AttachedSubmap>& attached_;
  std::size_t size_;
};

/// Number of spheres at waypoints, if the lists match: the cost of the request.
std::size_t NumSpheres(const v1::CheckTrajectoryRequest& request);

/// The link of each sphere of the robot.
RequestedLinks LinksOf(const v1::CheckTrajectoryRequest& request);

/// See CheckCollisionsRequest; at least one.
Result<std::size_t> MaxContactsFromProto(const v1::CheckTrajectoryRequest& request);

/// Maximum memory of answering: a motion, the answer, and its bytes.
std::size_t BytesOfAnswers(const v1::CheckTrajectoryRequest& request);

/// Writes answers, trajectory by trajectory, in the requested form.
class TrajectoryAnswers {
 public:
  /// For the state `map`. The request and the response outlive this.
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

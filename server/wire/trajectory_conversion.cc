// SPDX-License-Identifier: BSD-3-Clause
#include "server/wire/trajectory_conversion.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "proto/types/pose_conversion.h"
#include "server/wire/contact_conversion.h"

namespace dhpmap {
namespace {

constexpr double kMostRobot_m = 100;
constexpr int kMostWaypoints = 10'000;

Status BadMotion(const std::string& field, const std::string& what) {
  return InvalidArgument("the trajectories cannot be checked").WithReason("BAD_POINTS").WithViolation(field, what);
}

std::string ItemOf(const std::string& list, int number) { return list + "[" + std::to_string(number) + "]"; }

/// Index, in spheres, of the packed numbers of sphere s at waypoint h of trajectory b.
std::size_t Position(const v1::CheckTrajectoryRequest& request, std::size_t b, std::size_t h, std::size_t s) {
  const auto num_waypoints = static_cast<std::size_t>(request.num_waypoints());
  return (b * num_waypoints + h) * static_cast<std::size_t>(request.num_spheres()) + s;
}

Result<Transform> PackedPose(const float* v, const std::string& name) {
  return TransformFromQuaternion(Eigen::Vector3d(v[0], v[1], v[2]), Eigen::Vector4d(v[3], v[4], v[5], v[6]), name);
}

Status CheckPacked(const v1::CheckTrajectoryRequest& request, std::size_t num_attached) {
  if (request.robot_size() > 0) return BadMotion("robot", "does not go together with packed_spheres_m");
  if (request.trajectories_size() > 0) return BadMotion("trajectories", "do not go together with packed_spheres_m");
  if (request.num_waypoints() < 1 || request.num_waypoints() > kMostWaypoints) {
    return BadMotion("num_waypoints", "is not from 1 to 10,000");
  }
  if (request.num_spheres() < 1) return BadMotion("num_spheres", "is not positive");
  const auto a_trajectory = std::int64_t{4} * request.num_waypoints() * request.num_spheres();
  if (request.packed_spheres_m_size() % a_trajectory != 0) {
    return BadMotion("packed_spheres_m", "has " + std::to_string(request.packed_spheres_m_size()) + " values, not " +
                                             std::to_string(a_trajectory) + " a trajectory");
  }
  for (int i = 0; i < request.packed_spheres_m_size(); i += 4) {
    const float* s = request.packed_spheres_m().data() + i;
    if (!IsUsableSphere({s[0], s[1], s[2]}, s[3])) {
      return BadMotion("packed_spheres_m",
                       "sphere " + std::to_string(i / 4) + " is not finite, or of a radius that is not from 0 to 10");
    }
  }
  const std::int64_t num_poses = request.packed_spheres_m_size() / a_trajectory * request.num_waypoints() *
                                 static_cast<std::int64_t>(num_attached);
  if (request.packed_attached_poses_size() != 7 * num_poses) {
    return BadMotion("packed_attached_poses", "has " + std::to_string(request.packed_attached_poses_size()) +
                                                  " values, not seven for each attached object at each waypoint");
  }
  for (std::int64_t i = 0; i < num_poses; ++i) {
    const auto pose = PackedPose(request.packed_attached_poses().data() + 7 * i, "pose " + std::to_string(i));
    if (!pose.ok() || !IsUsableSphere(pose->translation(), 0)) {
      return BadMotion("packed_attached_poses", "pose " + std::to_string(i) + " is not finite, or has no rotation");
    }
  }
  return Status::Ok();
}

Status CheckRigid(const v1::CheckTrajectoryRequest& request, std::size_t num_attached) {
  if (request.num_waypoints() != 0) return BadMotion("num_waypoints", "has no meaning without packed_spheres_m");
  if (request.num_spheres() != 0) return BadMotion("num_spheres", "has no meaning without packed_spheres_m");
  if (request.packed_attached_poses_size() > 0) {
    return BadMotion("packed_attached_poses", "have no meaning without packed_spheres_m");
  }
  if (request.robot_size() == 0 && num_attached == 0) return BadMotion("robot", "has no spheres");
  for (int i = 0; i < request.robot_size(); ++i) {
    const Eigen::Vector3d center_m = VectorFromProto(request.robot(i).center_m());
    if (!IsUsableSphere(center_m, request.robot(i).radius_m()) || center_m.norm() > kMostRobot_m) {
      return BadMotion(ItemOf("robot", i), "is not finite, not within 100 m, or of a radius that is not from 0 to 10");
    }
  }
  for (int b = 0; b < request.trajectories_size(); ++b) {
    const std::string list = ItemOf("trajectories", b) + ".waypoints";
    const v1::Trajectory& trajectory = request.trajectories(b);
    if (trajectory.waypoints_size() < 1 || trajectory.waypoints_size() > kMostWaypoints) {
      return BadMotion(list, "are not from 1 to 10,000");
    }
    for (int h = 0; h < trajectory.waypoints_size(); ++h) {
      const std::string item = ItemOf(list, h);
      DHPMAP_ASSIGN_OR_RETURN(const Transform pose, TransformFromProto(trajectory.waypoints(h), item));
      if (!IsUsableSphere(pose.translation(), 0)) return BadMotion(item, "is beyond 1,000 km");
    }
  }
  return Status::Ok();
}

}  // namespace

std::size_t NumSpheres(const v1::CheckTrajectoryRequest& request) {
  std::size_t num_waypoints = 0;
  for (const v1::Trajectory& trajectory : request.trajectories()) {
    num_waypoints += static_cast<std::size_t>(trajectory.waypoints_size());
  }
  return static_cast<std::size_t>(request.packed_spheres_m_size() / 4) +
         num_waypoints * static_cast<std::size_t>(std::max(request.robot_size(), 1));
}

RequestedLinks LinksOf(const v1::CheckTrajectoryRequest& request) {
  const int num_spheres =
      request.packed_spheres_m_size() > 0 ? std::max(request.num_spheres(), 0) : request.robot_size();
  return {request.sphere_links(), "sphere_links", static_cast<std::size_t>(num_spheres)};
}

Result<RequestedMotions> RequestedMotions::Make(const v1::CheckTrajectoryRequest& request,
                                                const std::vector<AttachedSubmap>& attached, std::int64_t max_spheres) {
  if (const auto num_spheres = static_cast<std::int64_t>(NumSpheres(request)); num_spheres > max_spheres) {
    return BadMotion(
        request.packed_spheres_m_size() > 0 ? "packed_spheres_m" : "trajectories",
        std::to_string(num_spheres) + " spheres at waypoints are more than " + std::to_string(max_spheres));
  }
  if (request.packed_spheres_m_size() == 0) {
    DHPMAP_RETURN_IF_ERROR(CheckRigid(request, attached.size()));
    return RequestedMotions(request, attached, static_cast<std::size_t>(request.trajectories_size()));
  }
  DHPMAP_RETURN_IF_ERROR(CheckPacked(request, attached.size()));
  return RequestedMotions(request, attached,
                          static_cast<std::size_t>(request.packed_spheres_m_size()) / 4 / Position(request, 1, 0, 0));
}

RobotMotion RequestedMotions::operator[](std::size_t number) const {
  return request_.packed_spheres_m_size() > 0 ? Packed(number) : Rigid(number);
}

RobotMotion RequestedMotions::Packed(std::size_t number) const {
  const auto num_waypoints = static_cast<std::size_t>(request_.num_waypoints());
  RobotMotion motion;
  motion.spheres.resize(static_cast<std::size_t>(request_.num_spheres()));
  for (std::size_t s = 0; s < motion.spheres.size(); ++s) {
    motion.spheres[s].reserve(num_waypoints);
    for (std::size_t h = 0; h < num_waypoints; ++h) {
      const float* v = request_.packed_spheres_m().data() + 4 * Position(request_, number, h, s);
      motion.spheres[s].push_back({static_cast<double>(h), {v[0], v[1], v[2]}, v[3]});
    }
  }
  for (std::size_t a = 0; a < attached_.size(); ++a) {
    auto& poses = motion.attached.emplace_back();
    for (std::size_t h = 0; h < num_waypoints; ++h) {
      const float* v =
          request_.packed_attached_poses().data() + 7 * ((number * num_waypoints + h) * attached_.size() + a);
      poses.push_back(*PackedPose(v, "pose") * attached_[a].T_robot_submap);
    }
  }
  return motion;
}

RobotMotion RequestedMotions::Rigid(std::size_t number) const {
  RobotMotion motion;
  for (const v1::Sphere& sphere : request_.robot()) {
    motion.robot.push_back({VectorFromProto(sphere.center_m()), sphere.radius_m()});
  }
  for (const v1::Pose& waypoint : request_.trajectories(static_cast<int>(number)).waypoints()) {
    motion.waypoints.push_back(*TransformFromProto(waypoint, "waypoint"));
  }
  for (const AttachedSubmap& carried : attached_) {
    auto& poses = motion.attached.emplace_back();
    for (const Transform& T : motion.waypoints) poses.push_back(T * carried.T_robot_submap);
  }
  return motion;
}

Result<std::size_t> MaxContactsFromProto(const v1::CheckTrajectoryRequest& request) {
  return MaxContactsFromProto(request.all_contacts(), request.max_contacts(), request.packed());
}

std::size_t BytesOfAnswers(const v1::CheckTrajectoryRequest& request) {
  std::size_t most_waypoints = static_cast<std::size_t>(std::clamp(request.num_waypoints(), 0, kMostWaypoints));
  for (const v1::Trajectory& trajectory : request.trajectories()) {
    most_waypoints = std::max(most_waypoints, static_cast<std::size_t>(trajectory.waypoints_size()));
  }
  const auto num_attached = static_cast<std::size_t>(request.options().attached_size());
  const auto num_trajectories = static_cast<std::size_t>(
      request.packed_spheres_m_size() / 4 / std::max(1, request.num_waypoints()) + request.trajectories_size());
  const int asked = request.max_contacts() > 0 ? std::min(request.max_contacts(), kMostContacts) : kDefaultContacts;
  // One motion at a time with its cuts and knots; then answers as messages and encoded, with contacts of two vectors
  // and names.
  constexpr std::size_t kCuts = 32 * (136 + 40), kPose = 128, kKnot = 40, kMessage = 150, kContact = 700;
  const std::size_t motion = most_waypoints * (kCuts + kPose * (1 + num_attached)) +
                             kKnot * static_cast<std::size_t>(request.packed_spheres_m_size() / 4);
  constexpr std::size_t kClearance = 500;
  return motion + (request.include_clearance() ? num_trajectories * kClearance : 0) +
         num_trajectories * (kMessage + kContact * static_cast<std::size_t>(request.all_contacts() ? asked : 1));
}

TrajectoryAnswers::TrajectoryAnswers(const v1::CheckTrajectoryRequest& request, const MapInfo& map,
                                     v1::CheckTrajectoryResponse& response)
    : request_(request), map_(map), response_(response) {
  response_.set_revision(map.revision);
  if (request.packed()) (void)response_.mutable_packed();
}

void TrajectoryAnswers::Append(const TrajectoryAnswer& answer) {
  if (request_.packed()) return AppendPacked(answer);
  v1::TrajectoryResult& result = *response_.add_results();
  result.set_status(answer.is_unknown ? v1::QueryStatus::UNKNOWN : v1::QueryStatus::OK);
  result.set_valid(answer.is_valid);
  for (const TrajectoryContact& contact : answer.contacts) {
    v1::TrajectoryContact& proto = *result.add_contacts();
    const double waypoint = std::floor(contact.at);
    proto.set_waypoint(static_cast<std::int32_t>(waypoint));
    proto.set_fraction(static_cast<float>(contact.at - waypoint));
    proto.set_sphere(contact.sphere ? static_cast<std::int32_t>(*contact.sphere) : -1);
    if (contact.attached) proto.set_attached(request_.options().attached(static_cast<int>(*contact.attached)).submap());
    *proto.mutable_contact() = ToProto(contact.contact, map_);
  }
  if (answer.clearance) WriteClearance(*answer.clearance, *result.mutable_clearance());
}

void TrajectoryAnswers::WriteClearance(const TrajectoryClearance& clearance, v1::Clearance& proto) const {
  const LeastClearance& least = clearance.least;
  const double waypoint = std::floor(least.at);
  proto.set_distance_m(least.distance_m);
  proto.set_waypoint(static_cast<std::int32_t>(waypoint));
  proto.set_fraction(static_cast<float>(least.at - waypoint));
  proto.set_sphere(clearance.sphere ? static_cast<std::int32_t>(*clearance.sphere) : -1);
  if (clearance.attached) {
    proto.set_attached(request_.options().attached(static_cast<int>(*clearance.attached)).submap());
  }
  v1::Contact whose = ToProto(BodyContact{.submap = least.submap, .point_m = least.point_m}, map_);
  *proto.mutable_point_m() = whose.point_m();
  proto.set_instance_id(whose.instance_id());
  if (whose.has_class_id()) proto.set_class_id(whose.class_id());
  proto.set_submap(std::move(*whose.mutable_submap()));
  proto.set_class_name(std::move(*whose.mutable_class_name()));
}

void TrajectoryAnswers::AppendPacked(const TrajectoryAnswer& answer) {
  v1::PackedTrajectoryResults& packed = *response_.mutable_packed();
  packed.add_status(answer.is_unknown ? v1::QueryStatus::UNKNOWN : v1::QueryStatus::OK);
  packed.add_valid(answer.is_valid);
  TrajectoryContact contact{.at = -1, .sphere = {}, .attached = {}, .contact = {}};
  contact.contact.point_m.setConstant(std::numeric_limits<double>::quiet_NaN());
  if (!answer.contacts.empty()) contact = answer.contacts.front();
  const double waypoint = std::floor(contact.at);
  packed.add_waypoint(static_cast<std::int32_t>(waypoint));
  packed.add_fraction(static_cast<float>(contact.at - waypoint));
  packed.add_sphere(contact.sphere ? static_cast<std::int32_t>(*contact.sphere) : -1);
  packed.add_attached(contact.attached ? static_cast<std::int32_t>(*contact.attached) : -1);
  packed.add_depth_m(static_cast<float>(contact.contact.depth_m));
  for (int axis = 0; axis < 3; ++axis) {
    packed.add_point_m(static_cast<float>(contact.contact.point_m[axis]));
    packed.add_normal(static_cast<float>(contact.contact.normal[axis]));
  }
  packed.add_instance_id(InstanceOf(contact.contact));
  packed.add_class_id(ClassOf(contact.contact));
  if (!request_.include_clearance()) return;
  packed.add_clearance_m(answer.clearance ? static_cast<float>(answer.clearance->least.distance_m)
                                          : std::numeric_limits<float>::quiet_NaN());
}

}  // namespace dhpmap

// SPDX-License-Identifier: BSD-3-Clause
#include "clients/cli/pose_change.h"

#include <CLI/CLI.hpp>
#include <Eigen/Geometry>
#include <cmath>

namespace dhpmap {
namespace {

Eigen::Vector3d FromMessage(const v1::Vector3& v) { return {v.x(), v.y(), v.z()}; }

void SetMessage(const Eigen::Vector3d& value, v1::Vector3& v) {
  v.set_x(value.x());
  v.set_y(value.y());
  v.set_z(value.z());
}

void SetMessage(const Eigen::Quaterniond& value, v1::Quaternion& q) {
  q.set_x(value.x());
  q.set_y(value.y());
  q.set_z(value.z());
  q.set_w(value.w());
}

/// Turns about the vertical through `center_m`.
void TurnOnTheSpot(double yaw_deg, const Eigen::Vector3d& center_m, v1::Pose& pose) {
  const Eigen::Quaterniond turn(Eigen::AngleAxisd(yaw_deg * M_PI / 180, Eigen::Vector3d::UnitZ()));
  const v1::Quaternion& q = pose.rotation();
  const Eigen::Quaterniond before(q.w(), q.x(), q.y(), q.z());
  const Eigen::Vector3d t_m = center_m + turn * (FromMessage(pose.translation_m()) - center_m);
  SetMessage(t_m, *pose.mutable_translation_m());
  SetMessage((turn * before).normalized(), *pose.mutable_rotation());
}

}  // namespace

void AddPoseFlags(CLI::App& command, PoseChange& change) {
  CLI::Option* to =
      command.add_option("--to", change.to_m, "New translation X Y Z of the object's pose (metres)")->expected(3);
  command.add_option("--by", change.by_m, "Shift by X Y Z (metres)")->expected(3)->excludes(to);
  CLI::Option* rotation =
      command
          .add_option("--rotation", change.rotation,
                      "New rotation of the pose as quaternion X Y Z W, about the origin of its frame; see edit turn")
          ->expected(4);
  command
      .add_option("--yaw", change.yaw_deg,
                  "Turn on the spot by so many degrees, counter-clockwise from above; may go with --by")
      ->excludes(to)
      ->excludes(rotation);
}

Status ChangePose(const PoseChange& change, v1::Submap& submap) {
  v1::Pose& pose = *submap.mutable_map_from_submap();
  const std::vector<double>& to = change.to_m;
  const std::vector<double>& by = change.by_m;
  const std::vector<double>& q = change.rotation;
  if (!to.empty()) SetMessage(Eigen::Vector3d(to[0], to[1], to[2]), *pose.mutable_translation_m());
  if (!q.empty()) SetMessage(Eigen::Quaterniond(q[3], q[0], q[1], q[2]), *pose.mutable_rotation());
  if (change.yaw_deg) {
    if (!submap.has_bounding_sphere()) {
      return FailedPrecondition(submap.name() + " has no place to turn at: nothing of it was observed");
    }
    TurnOnTheSpot(*change.yaw_deg, FromMessage(submap.bounding_sphere().center_m()), pose);
  }
  if (!by.empty()) {
    const Eigen::Vector3d shift_m(by[0], by[1], by[2]);
    SetMessage(FromMessage(pose.translation_m()) + shift_m, *pose.mutable_translation_m());
  }
  return Status::Ok();
}

}  // namespace dhpmap

// SPDX-License-Identifier: BSD-3-Clause
// dhpmap query collisions, trajectory: contacts of bodies, and whether a robot can follow a path.
#include <CLI/CLI.hpp>
#include <cmath>
#include <iostream>
#include <memory>
#include <string>
#include <vector>

#include "clients/cli/allow_flags.h"
#include "clients/cli/connection.h"
#include "clients/cli/query_flags.h"
#include "clients/cli/text_table.h"
#include "dhpmap/v1/query_service.grpc.pb.h"
#include "dhpmap/v1/submap_service.grpc.pb.h"
#include "proto/types/pose_conversion.h"

namespace dhpmap {
namespace {

struct CheckFlags {
  std::string map;
  QueryFlags query;
  v1::QueryOptions::UnknownPolicy unknown = v1::QueryOptions::OCCUPIED;
  AllowFlags allow;
  double padding_m = 0;
  bool all_contacts = false;
};

struct CollisionFlags {
  CheckFlags check;
  std::vector<float> spheres;
  std::vector<double> boxes, capsules;
};

struct TrajectoryFlags {
  CheckFlags check;
  std::vector<double> waypoints, robot;
  std::vector<std::int64_t> attached;
  bool with_clearance = false;
};

void AddCheckFlags(CLI::App& command, CheckFlags& flags) {
  AddQueryFlags(command, flags.query);
  AddUnknownFlag(command, flags.unknown);
  AddPaddingFlag(command, flags.padding_m);
  command.add_flag("--all", flags.all_contacts, "Tell all contacts");
}

Result<v1::QueryOptions> OptionsToProto(const CheckFlags& flags) {
  v1::QueryOptions options = ToProto(flags.query, flags.map);
  options.set_unknown_policy(flags.unknown);
  options.mutable_padding()->set_default_padding_m(flags.padding_m);
  DHPMAP_RETURN_IF_ERROR(AddAllowed(flags.allow, flags.map, options));
  return options;
}

v1::Vector3 Vector(const double* xyz) {
  v1::Vector3 v;
  v.set_x(xyz[0]);
  v.set_y(xyz[1]);
  v.set_z(xyz[2]);
  return v;
}

std::string Text(const v1::Vector3& v) { return Fixed(v.x(), 3) + " " + Fixed(v.y(), 3) + " " + Fixed(v.z(), 3); }

/// Depth, point, normal, object and class; dashes where a contact with unseen space has no value.
std::vector<std::string> Columns(const v1::Contact* contact) {
  if (contact == nullptr) return {"-", "-", "-", "-", "-"};
  const bool is_unseen = contact->instance_id() < 0;
  return {is_unseen ? "-" : Fixed(contact->depth_m(), 4), Text(contact->point_m()),
          is_unseen ? "-" : Text(contact->normal()), is_unseen ? "unseen" : std::to_string(contact->instance_id()),
          contact->class_name().empty() ? "-" : contact->class_name()};
}

void Add(std::vector<std::string> row, const v1::Contact* contact, TextTable& table) {
  for (std::string& column : Columns(contact)) row.push_back(std::move(column));
  table.Add(std::move(row));
}

void PrintTable(const v1::CheckCollisionsResponse& response) {
  TextTable table({"BODY", "STATUS", "COLLIDING", "DEPTH_M", "POINT_M", "NORMAL", "INSTANCE", "CLASS"});
  for (int i = 0; i < response.results_size(); ++i) {
    const v1::CollisionResult& result = response.results(i);
    const std::vector<std::string> row = {std::to_string(i), v1::QueryStatus::Code_Name(result.status()),
                                          result.colliding() ? "yes" : "no"};
    if (result.contacts().empty()) Add(row, nullptr, table);
    for (const v1::Contact& contact : result.contacts()) Add(row, &contact, table);
  }
  table.Print(std::cout);
}

ExitCode RunCollisions(const Session& session, const CollisionFlags& flags) {
  if (flags.spheres.size() % 4 != 0 || flags.boxes.size() % 6 != 0 || flags.capsules.size() % 7 != 0 ||
      flags.spheres.size() + flags.boxes.size() + flags.capsules.size() == 0) {
    return ReportLocalError("spheres are X Y Z RADIUS, boxes X Y Z and three sizes, capsules X Y Z X Y Z RADIUS",
                            ExitCode::kUsage);
  }
  v1::CheckCollisionsRequest request;
  request.set_map(MapName(flags.check.map));
  request.mutable_packed_spheres_m()->Assign(flags.spheres.begin(), flags.spheres.end());
  for (std::size_t i = 0; i < flags.boxes.size(); i += 6) {
    v1::OrientedBox& box = *request.add_bodies()->mutable_box();
    *box.mutable_pose()->mutable_translation_m() = Vector(&flags.boxes[i]);
    *box.mutable_size_m() = Vector(&flags.boxes[i + 3]);
  }
  for (std::size_t i = 0; i < flags.capsules.size(); i += 7) {
    v1::Capsule& capsule = *request.add_bodies()->mutable_capsule();
    *capsule.mutable_a_m() = Vector(&flags.capsules[i]);
    *capsule.mutable_b_m() = Vector(&flags.capsules[i + 3]);
    capsule.set_radius_m(flags.capsules[i + 6]);
  }
  request.mutable_body_links()->Assign(flags.check.allow.links.begin(), flags.check.allow.links.end());
  const auto options = OptionsToProto(flags.check);
  if (!options.ok()) return ReportLocalError(options.status().message(), ExitCode::kUsage);
  *request.mutable_options() = *options;
  SetRead(flags.check.query.world.asker.read, request);
  request.set_all_contacts(flags.check.all_contacts);
  return Tell(session, Ask(session, &v1::QueryService::Stub::CheckCollisions, request),
              [&](const v1::CheckCollisionsResponse& response) { PrintTable(response); });
}

std::string PartOf(int sphere, const std::string& attached) {
  return sphere >= 0 ? "sphere " + std::to_string(sphere) : attached;
}

void PrintClearances(const v1::CheckTrajectoryResponse& response) {
  TextTable table({"CLEARANCE_M", "WAYPOINT", "FRACTION", "PART", "POINT_M", "INSTANCE", "CLASS"});
  for (const v1::TrajectoryResult& result : response.results()) {
    if (!result.has_clearance()) {
      table.Add({"-", "-", "-", "-", "-", "-", "-"});
      continue;
    }
    const v1::Clearance& least = result.clearance();
    table.Add({Fixed(least.distance_m(), 4), std::to_string(least.waypoint()), Fixed(least.fraction(), 3),
               PartOf(least.sphere(), least.attached()), Text(least.point_m()), std::to_string(least.instance_id()),
               least.class_name().empty() ? "-" : least.class_name()});
  }
  table.Print(std::cout);
}

void PrintTable(const v1::CheckTrajectoryResponse& response) {
  TextTable table(
      {"STATUS", "VALID", "WAYPOINT", "FRACTION", "PART", "DEPTH_M", "POINT_M", "NORMAL", "INSTANCE", "CLASS"});
  for (const v1::TrajectoryResult& result : response.results()) {
    const std::vector<std::string> row = {v1::QueryStatus::Code_Name(result.status()), result.valid() ? "yes" : "no"};
    if (result.contacts().empty()) {
      std::vector<std::string> none = row;
      none.insert(none.end(), {"-", "-", "-"});
      Add(std::move(none), nullptr, table);
    }
    for (const v1::TrajectoryContact& contact : result.contacts()) {
      std::vector<std::string> all = row;
      all.insert(all.end(), {std::to_string(contact.waypoint()), Fixed(contact.fraction(), 3),
                             PartOf(contact.sphere(), contact.attached())});
      Add(std::move(all), &contact.contact(), table);
    }
  }
  table.Print(std::cout);
}

/// An object that the robot picks up at its first waypoint; computes its pose on the robot. `frame`: the frame of the
/// waypoint.
Result<v1::AttachedSubmap> TakeUp(const v1::Submap& submap, const v1::Pose& frame, const v1::Pose& first_waypoint) {
  v1::AttachedSubmap attached;
  attached.set_submap(submap.name());
  DHPMAP_ASSIGN_OR_RETURN(const Transform T_map_submap,
                          TransformFromProto(submap.map_from_submap(), "map_from_submap"));
  DHPMAP_ASSIGN_OR_RETURN(const Transform T_map_asker, TransformFromProto(frame, "frame"));
  DHPMAP_ASSIGN_OR_RETURN(const Transform T_asker_robot, TransformFromProto(first_waypoint, "waypoint"));
  *attached.mutable_robot_from_submap() = ToProto((T_map_asker * T_asker_robot).inverse() * T_map_submap);
  return attached;
}

ExitCode RunTrajectory(const Session& session, const TrajectoryFlags& flags) {
  if (flags.waypoints.empty() || flags.waypoints.size() % 4 != 0 || flags.robot.size() % 4 != 0) {
    return ReportLocalError("waypoints are X Y Z YAW_DEG [...], a robot is X Y Z RADIUS [...]", ExitCode::kUsage);
  }
  v1::CheckTrajectoryRequest request;
  request.set_map(MapName(flags.check.map));
  for (std::size_t i = 0; i < flags.robot.size(); i += 4) {
    v1::Sphere& sphere = *request.add_robot();
    *sphere.mutable_center_m() = Vector(&flags.robot[i]);
    sphere.set_radius_m(flags.robot[i + 3]);
  }
  v1::Trajectory& trajectory = *request.add_trajectories();
  for (std::size_t i = 0; i < flags.waypoints.size(); i += 4) {
    v1::Pose& pose = *trajectory.add_waypoints();
    const double half_rad = flags.waypoints[i + 3] * M_PI / 360;
    *pose.mutable_translation_m() = Vector(&flags.waypoints[i]);
    pose.mutable_rotation()->set_z(std::sin(half_rad));
    pose.mutable_rotation()->set_w(std::cos(half_rad));
  }
  request.mutable_sphere_links()->Assign(flags.check.allow.links.begin(), flags.check.allow.links.end());
  const auto common = OptionsToProto(flags.check);
  if (!common.ok()) return ReportLocalError(common.status().message(), ExitCode::kUsage);
  v1::QueryOptions& options = *request.mutable_options();
  options = *common;
  for (const std::int64_t id : flags.attached) {
    v1::GetSubmapRequest wanted;
    wanted.set_name(SubmapName(flags.check.map, id));
    SetRead(flags.check.query.world.asker.read, wanted);
    const auto taken = Ask(session, &v1::SubmapService::Stub::GetSubmap, wanted);
    if (!taken.ok()) return ReportError(session, taken.status());
    const auto attached = TakeUp(taken->submap(), options.map_from_query(), trajectory.waypoints(0));
    if (!attached.ok()) return ReportLocalError(attached.status().message(), ExitCode::kUsage);
    *options.add_attached() = *attached;
  }
  SetRead(flags.check.query.world.asker.read, request);
  request.set_all_contacts(flags.check.all_contacts);
  request.set_include_clearance(flags.with_clearance);
  return Tell(session, Ask(session, &v1::QueryService::Stub::CheckTrajectory, request),
              [&](const v1::CheckTrajectoryResponse& response) {
                PrintTable(response);
                if (flags.with_clearance) PrintClearances(response);
              });
}

}  // namespace

void AddCheckCommands(CLI::App& query, Session& session) {
  auto collision = std::make_shared<CollisionFlags>();
  CLI::App* collisions = query.add_subcommand("collisions", "Check spheres, boxes and capsules for collisions");
  collisions->add_option("map", collision->check.map, "Name of the map")->required();
  collisions->add_option("spheres", collision->spheres, "X Y Z RADIUS [X Y Z RADIUS ...], in m");
  collisions->add_option("--box", collision->boxes, "X Y Z of the middle and three sizes [...]: along the map's axes");
  collisions->add_option("--capsule", collision->capsules, "X Y Z X Y Z RADIUS [...]");
  AddAllowFlags(*collisions, "body", collision->check.allow);
  AddCheckFlags(*collisions, collision->check);
  collisions->callback([collision, &session] { session.exit_code = RunCollisions(session, *collision); });

  auto motion = std::make_shared<TrajectoryFlags>();
  CLI::App* trajectory = query.add_subcommand("trajectory", "Check a robot's trajectory for collisions");
  trajectory->add_option("map", motion->check.map, "Name of the map")->required();
  trajectory->add_option("waypoints", motion->waypoints, "X Y Z YAW_DEG [X Y Z YAW_DEG ...]")->required();
  trajectory->add_option("--robot", motion->robot, "X Y Z RADIUS [...]: its spheres, in its own frame");
  trajectory->add_option("--attached", motion->attached, "Ids of objects that it takes up at the first");
  trajectory->add_flag("--clearance", motion->with_clearance,
                       "Report the smallest distance to surfaces, its place and object");
  AddAllowFlags(*trajectory, "sphere of the robot", motion->check.allow);
  AddCheckFlags(*trajectory, motion->check);
  trajectory->callback([motion, &session] { session.exit_code = RunTrajectory(session, *motion); });
}

}  // namespace dhpmap

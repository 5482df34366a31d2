// SPDX-License-Identifier: BSD-3-Clause
// dhpmap submaps: the objects of a map.
#include <CLI/CLI.hpp>
#include <cmath>
#include <iostream>
#include <numbers>

#include "clients/cli/class_names.h"
#include "clients/cli/connection.h"
#include "clients/cli/new_map.h"
#include "clients/cli/query_flags.h"
#include "clients/cli/text_table.h"
#include "dhpmap/v1/submap_service.grpc.pb.h"

namespace dhpmap {
namespace {

struct SubmapsOptions {
  std::string map;
  std::int64_t id = -1;
  std::vector<std::string> classes;
  std::string kind;
  std::vector<double> sphere, box;
  ReadFlags read;
};

std::string StateName(const v1::Submap& submap) {
  std::string name = submap.activity() == v1::Submap::ACTIVE ? "active" : "settled";
  if (submap.presence() == v1::Submap::ABSENT) name = "absent";
  return submap.locked() ? name + ", locked" : name;
}

/// The size of its box; "-" if it has none.
std::string SizeOf(const v1::Submap& submap) {
  if (!submap.has_oriented_box()) return "-";
  const v1::Vector3& size = submap.oriented_box().size_m();
  return Fixed(size.x(), 2) + " x " + Fixed(size.y(), 2) + " x " + Fixed(size.z(), 2);
}

std::string YawOf(const v1::Submap& submap) {
  if (!submap.has_oriented_box()) return "-";
  const v1::Quaternion& rotation = submap.oriented_box().pose().rotation();
  return Fixed(2 * std::atan2(rotation.z(), rotation.w()) * 180 / std::numbers::pi, 0);
}

void PrintTable(const google::protobuf::RepeatedPtrField<v1::Submap>& submaps) {
  TextTable table({"ID", "KIND", "CLASS", "NAME", "CONFIDENCE", "STATE", "FRAMES", "BLOCKS", "X_M", "Y_M", "Z_M",
                   "RADIUS_M", "SIZE_M", "YAW_DEG"});
  for (const v1::Submap& submap : submaps) {
    const v1::Sphere& sphere = submap.bounding_sphere();
    const auto metres = [&](double value) { return submap.has_bounding_sphere() ? Fixed(value, 2) : "-"; };
    table.Add({std::to_string(submap.instance_id()), KindName(submap.kind()), submap.class_name(),
               submap.display_name(), Fixed(submap.class_confidence(), 2), StateName(submap),
               std::to_string(submap.num_frames_observed()), std::to_string(submap.num_blocks()),
               metres(sphere.center_m().x()), metres(sphere.center_m().y()), metres(sphere.center_m().z()),
               metres(sphere.radius_m()), SizeOf(submap), YawOf(submap)});
  }
  table.Print(std::cout);
}

ExitCode RunGet(const Session& session, const SubmapsOptions& options) {
  v1::GetSubmapRequest request;
  request.set_name(SubmapName(options.map, options.id));
  SetRead(options.read, request);
  return Tell(session, Ask(session, &v1::SubmapService::Stub::GetSubmap, request),
              [&](const v1::GetSubmapResponse& response) { std::cout << response.submap().DebugString(); });
}

ExitCode RunList(const Session& session, const SubmapsOptions& options) {
  v1::ListSubmapsRequest request;
  request.set_parent(MapName(options.map));
  SetRead(options.read, request);
  if (!options.classes.empty()) {
    const auto map = GetMap(session, options.map);
    if (!map.ok()) return ReportError(session, map.status());
    for (const std::string& name : options.classes) {
      const auto label_class = FindClass(*map, name);
      if (!label_class.ok()) return ReportLocalError(label_class.status().message(), ExitCode::kNotFound);
      request.add_class_ids(static_cast<std::int32_t>(label_class->id()));
    }
  }
  if (!options.kind.empty()) request.set_kind(options.kind == "thing" ? v1::LabelClass::THING : v1::LabelClass::STUFF);
  if (!options.sphere.empty()) {
    SetVector(options.sphere.data(), *request.mutable_sphere()->mutable_center_m());
    request.mutable_sphere()->set_radius_m(options.sphere[3]);
  }
  if (!options.box.empty()) {
    SetVector(options.box.data(), *request.mutable_region()->mutable_min_m());
    SetVector(options.box.data() + 3, *request.mutable_region()->mutable_max_m());
  }
  return Tell(session, AskForAll(session, &v1::SubmapService::Stub::ListSubmaps, request),
              [](const v1::ListSubmapsResponse& response) { PrintTable(response.submaps()); });
}

}  // namespace

void AddSubmapsCommand(CLI::App& app, Session& session) {
  auto options = std::make_shared<SubmapsOptions>();
  CLI::App* command = app.add_subcommand("submaps", "List the objects of a map, or show one of them");
  command->add_option("map", options->map, "Name of the map")->required();
  command->add_option("id", options->id, "Instance id of one object, to show all of it");
  command->add_option("--class", options->classes, "Of this class only, by name or id; may be repeated")
      ->allow_extra_args(false);
  command->add_option("--kind", options->kind, "Of this kind only")->check(CLI::IsMember({"thing", "stuff"}));
  command->add_option("--sphere", options->sphere, "Bounding sphere touches the sphere X Y Z RADIUS (metres)")
      ->expected(4);
  command->add_option("--box", options->box, "Bounding sphere touches the box X Y Z to X Y Z (metres)")->expected(6);
  AddReadFlags(*command, options->read);
  command->callback([options, &session] {
    session.exit_code = options->id >= 0 ? RunGet(session, *options) : RunList(session, *options);
  });
}

}  // namespace dhpmap

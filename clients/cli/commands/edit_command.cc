// SPDX-License-Identifier: BSD-3-Clause
// dhpmap edit
// move|turn|shift|place|clone|delete|relabel|rename|merge|split|clear|absent|present|lock|unlock|keep-clear|lift|kept-clear|apply.
#include <google/protobuf/util/json_util.h>

#include <CLI/CLI.hpp>
#include <fstream>
#include <iostream>
#include <numbers>
#include <sstream>

#include "clients/cli/class_names.h"
#include "clients/cli/connection.h"
#include "clients/cli/edit_flags.h"
#include "clients/cli/new_map.h"
#include "clients/cli/pose_change.h"
#include "clients/cli/query_flags.h"
#include "clients/cli/text_table.h"
#include "dhpmap/v1/edit_service.grpc.pb.h"
#include "dhpmap/v1/submap_service.grpc.pb.h"

namespace dhpmap {
namespace {

struct EditOptions : EditFlags {
  std::string map, text, class_name;
  std::int64_t id = 0;
  PoseChange pose;
  std::vector<std::int64_t> others;
  std::vector<double> box_m, sphere_m, plane;
  std::vector<std::string> classes;
  std::string region_name;
  int min_voxels = 0;
  ReadFlags read;  ///< of `kept-clear`
  double angle_deg = 0;
  std::vector<double> offset_m, at_m;
  std::int64_t support = 0;
  bool include_supported = false;
  [[nodiscard]] std::string name() const { return SubmapName(map, id); }
};

client::Result<v1::Submap> GetSubmap(const Session& session, const std::string& name) {
  v1::GetSubmapRequest request;
  request.set_name(name);
  auto response = Ask(session, &v1::SubmapService::Stub::GetSubmap, request);
  if (!response.ok()) return response.status();
  return std::move(*response->mutable_submap());
}

/// `text(response)` describes the result.
template <typename Response, typename Text>
ExitCode Done(const Session& session, const EditOptions& options, const client::Result<Response>& answer, Text text) {
  return Tell(session, answer, [&](const Response& response) {
    std::cout << (options.only_try ? "would be: " : "") << text(response) << ", revision " << response.revision()
              << "\n";
  });
}

ExitCode Update(const Session& session, const EditOptions& options, const v1::Submap& submap, const char* field,
                const std::string& text) {
  v1::UpdateSubmapRequest request;
  options.Sign(request);
  *request.mutable_submap() = submap;
  if (!options.etag.empty()) request.mutable_submap()->set_etag(options.etag);
  request.mutable_update_mask()->add_paths(field);
  return Done(session, options, Ask(session, &v1::SubmapService::Stub::UpdateSubmap, request),
              [&](const auto&) { return text; });
}

ExitCode MoveWithSupported(const Session& session, const EditOptions& options, const v1::Submap& submap);

ExitCode RunMove(const Session& session, const EditOptions& options) {
  if (!options.pose.is_given()) {
    return ReportLocalError("say where: --to, --by, --yaw or --rotation", ExitCode::kUsage);
  }
  auto submap = GetSubmap(session, options.name());  // its etag protects against concurrent changes
  if (!submap.ok()) return ReportError(session, submap.status());
  if (const Status changed = ChangePose(options.pose, *submap); !changed.ok()) {
    return ReportLocalError(changed.message(), ExitCode::kBadRequest);
  }
  if (options.include_supported) return MoveWithSupported(session, options, *submap);
  return Update(session, options, *submap, "map_from_submap", "moved " + options.name());
}

ExitCode RunClone(const Session& session, const EditOptions& options) {
  v1::CloneSubmapRequest request;
  options.Sign(request);
  request.set_name(options.name());
  request.set_display_name(options.text);
  request.set_etag(options.etag);
  if (options.pose.is_given()) {
    auto submap = GetSubmap(session, options.name());
    if (!submap.ok()) return ReportError(session, submap.status());
    if (const Status changed = ChangePose(options.pose, *submap); !changed.ok()) {
      return ReportLocalError(changed.message(), ExitCode::kBadRequest);
    }
    *request.mutable_map_from_submap() = submap->map_from_submap();
  }
  return Done(session, options, Ask(session, &v1::SubmapService::Stub::CloneSubmap, request),
              [](const v1::CloneSubmapResponse& response) { return "cloned to " + response.submap().name(); });
}

ExitCode RunDelete(const Session& session, const EditOptions& options) {
  v1::DeleteSubmapRequest request;
  options.Sign(request);
  request.set_name(options.name());
  request.set_etag(options.etag);
  return Done(session, options, Ask(session, &v1::SubmapService::Stub::DeleteSubmap, request),
              [&](const auto&) { return "deleted " + options.name(); });
}

ExitCode RunRelabel(const Session& session, const EditOptions& options) {
  const auto map = GetMap(session, options.map);
  if (!map.ok()) return ReportError(session, map.status());
  const auto label_class = FindClass(*map, options.text);
  if (!label_class.ok()) return ReportLocalError(label_class.status().message(), ExitCode::kNotFound);
  v1::Submap submap;
  submap.set_name(options.name());
  submap.set_class_id(static_cast<std::int32_t>(label_class->id()));
  return Update(session, options, submap, "class_id", "relabelled " + options.name() + " to " + label_class->name());
}

ExitCode RunRename(const Session& session, const EditOptions& options) {
  v1::Submap submap;
  submap.set_name(options.name());
  submap.set_display_name(options.text);
  return Update(session, options, submap, "display_name", "renamed " + options.name());
}

void SetBox(v1::AxisAlignedBox& out, const std::vector<double>& values) {
  SetVector(values.data(), *out.mutable_min_m());
  SetVector(values.data() + 3, *out.mutable_max_m());
}

/// Sets the region of a message that has a box or a sphere.
template <typename Message>
void SetRegion(Message& out, const EditOptions& options) {
  if (!options.box_m.empty()) {
    SetBox(*out.mutable_box(), options.box_m);
    return;
  }
  SetVector(options.sphere_m.data(), *out.mutable_sphere()->mutable_center_m());
  out.mutable_sphere()->set_radius_m(options.sphere_m[3]);
}

void PrintNames(const char* what, const google::protobuf::RepeatedPtrField<std::string>& names) {
  if (names.empty()) return;
  std::cout << " " << what;
  for (const std::string& name : names) std::cout << " " << name.substr(name.rfind('/') + 1);
}

/// Prints a line for each edit: changed, created and removed instance ids.
ExitCode RunEdits(const Session& session, v1::ApplyEditsRequest request, const EditOptions& options) {
  request.set_map(MapName(options.map));
  options.Sign(request);
  if (!options.etag.empty() && options.id == 0) request.set_etag(options.etag);
  return Tell(session, Ask(session, &v1::EditService::Stub::ApplyEdits, request),
              [&](const v1::ApplyEditsResponse& response) {
                for (const v1::EditResult& result : response.results()) {
                  std::cout << (request.validate_only() ? "would be:" : "done:");
                  PrintNames("changed", result.changed_submaps());
                  PrintNames("created", result.created_submaps());
                  PrintNames("removed", result.removed_submaps());
                  if (result.num_voxels() > 0) std::cout << ", " << result.num_voxels() << " voxels";
                  std::cout << "\n";
                }
                std::cout << "revision " << response.revision() << "\n";
              });
}

/// A list of one edit, on the object of the options, if they name one.
v1::ApplyEditsRequest One(const EditOptions& options, v1::Edit*& edit) {
  v1::ApplyEditsRequest request;
  edit = request.add_edits();
  if (options.id == 0) return request;
  edit->set_submap(options.name());
  edit->set_etag(options.etag);
  return request;
}

ExitCode MoveWithSupported(const Session& session, const EditOptions& options, const v1::Submap& submap) {
  v1::Edit* edit = nullptr;
  v1::ApplyEditsRequest request = One(options, edit);
  if (options.etag.empty()) edit->set_etag(submap.etag());
  *edit->mutable_move()->mutable_map_from_submap() = submap.map_from_submap();
  edit->mutable_move()->set_include_supported(true);
  return RunEdits(session, std::move(request), options);
}

ExitCode RunTurn(const Session& session, const EditOptions& options) {
  v1::Edit* edit = nullptr;
  v1::ApplyEditsRequest request = One(options, edit);
  edit->mutable_turn()->set_angle_rad(options.angle_deg * std::numbers::pi / 180);
  edit->mutable_turn()->set_include_supported(options.include_supported);
  return RunEdits(session, std::move(request), options);
}

ExitCode RunShift(const Session& session, const EditOptions& options) {
  v1::Edit* edit = nullptr;
  v1::ApplyEditsRequest request = One(options, edit);
  SetVector(options.offset_m.data(), *edit->mutable_translate()->mutable_offset_m());
  edit->mutable_translate()->set_include_supported(options.include_supported);
  return RunEdits(session, std::move(request), options);
}

ExitCode RunPlace(const Session& session, const EditOptions& options) {
  v1::Edit* edit = nullptr;
  v1::ApplyEditsRequest request = One(options, edit);
  edit->mutable_place()->set_support(SubmapName(options.map, options.support));
  if (!options.at_m.empty()) {
    edit->mutable_place()->mutable_point_m()->set_x(options.at_m[0]);
    edit->mutable_place()->mutable_point_m()->set_y(options.at_m[1]);
  }
  edit->mutable_place()->set_include_supported(options.include_supported);
  return RunEdits(session, std::move(request), options);
}

ExitCode RunMerge(const Session& session, const EditOptions& options) {
  v1::Edit* edit = nullptr;
  v1::ApplyEditsRequest request = One(options, edit);
  for (const std::int64_t other : options.others)
    edit->mutable_merge()->add_merged_submaps(SubmapName(options.map, other));
  return RunEdits(session, std::move(request), options);
}

ExitCode RunSplit(const Session& session, const EditOptions& options) {
  v1::Edit* edit = nullptr;
  v1::ApplyEditsRequest request = One(options, edit);
  v1::SplitEdit& split = *edit->mutable_split();
  split.set_class_name(options.class_name);
  if (!options.box_m.empty()) SetBox(*split.mutable_box(), options.box_m);
  else if (options.plane.empty()) split.mutable_parts()->set_min_voxels(options.min_voxels);
  else {
    SetVector(options.plane.data(), *split.mutable_plane()->mutable_point_m());
    SetVector(options.plane.data() + 3, *split.mutable_plane()->mutable_normal());
  }
  return RunEdits(session, std::move(request), options);
}

ExitCode RunClear(const Session& session, const EditOptions& options) {
  if (options.box_m.empty() == options.sphere_m.empty()) {
    return ReportLocalError("say where: --box or --sphere", ExitCode::kUsage);
  }
  v1::Edit* edit = nullptr;
  v1::ApplyEditsRequest request = One(options, edit);
  v1::ClearEdit& clear = *edit->mutable_clear();
  SetRegion(clear, options);
  clear.set_ignored_region_name(options.region_name);
  for (const std::string& name : options.classes) clear.add_class_names(name);
  return RunEdits(session, std::move(request), options);
}

template <v1::Submap::Presence presence>
ExitCode RunSetPresence(const Session& session, const EditOptions& options) {
  v1::Edit* edit = nullptr;
  v1::ApplyEditsRequest request = One(options, edit);
  edit->mutable_presence()->set_presence(presence);
  return RunEdits(session, std::move(request), options);
}

template <bool is_locked>
ExitCode RunLock(const Session& session, const EditOptions& options) {
  v1::Edit* edit = nullptr;
  v1::ApplyEditsRequest request = One(options, edit);
  if (is_locked) edit->mutable_lock();
  else edit->mutable_unlock();
  return RunEdits(session, std::move(request), options);
}

ExitCode RunIgnoreRegion(const Session& session, const EditOptions& options) {
  if (options.box_m.empty() == options.sphere_m.empty()) {
    return ReportLocalError("say where: --box or --sphere", ExitCode::kUsage);
  }
  v1::Edit* edit = nullptr;
  v1::ApplyEditsRequest request = One(options, edit);
  edit->mutable_ignore_region()->set_name(options.region_name);
  SetRegion(*edit->mutable_ignore_region(), options);
  return RunEdits(session, std::move(request), options);
}

ExitCode RunUnignoreRegion(const Session& session, const EditOptions& options) {
  v1::Edit* edit = nullptr;
  v1::ApplyEditsRequest request = One(options, edit);
  edit->mutable_unignore_region()->set_name(options.region_name);
  return RunEdits(session, std::move(request), options);
}

std::string Numbers(const v1::Vector3& v) { return Fixed(v.x(), 2) + " " + Fixed(v.y(), 2) + " " + Fixed(v.z(), 2); }

ExitCode RunListIgnoredRegions(const Session& session, const EditOptions& options) {
  v1::ListIgnoredRegionsRequest request;
  request.set_parent(MapName(options.map));
  SetRead(options.read, request);
  return Tell(
      session, Ask(session, &v1::EditService::Stub::ListIgnoredRegions, request),
      [&](const v1::ListIgnoredRegionsResponse& response) {
        TextTable table({"NAME", "SHAPE", "METRES"});
        for (const v1::IgnoredRegion& region : response.ignored_regions()) {
          const v1::AxisAlignedBox& box = region.box();
          const v1::Sphere& sphere = region.sphere();
          if (region.has_box()) table.Add({region.name(), "box", Numbers(box.min_m()) + " to " + Numbers(box.max_m())});
          else
            table.Add({region.name(), "sphere", Numbers(sphere.center_m()) + " radius " + Fixed(sphere.radius_m(), 2)});
        }
        table.Print(std::cout);
      });
}

/// Applies a list of edits from a JSON file, an ApplyEditsRequest whose map is optional.
ExitCode RunApply(const Session& session, const EditOptions& options) {
  std::ostringstream text;
  if (options.text == "-") {
    text << std::cin.rdbuf();
  } else {
    std::ifstream file(options.text);
    if (!file) return ReportLocalError("cannot read " + options.text, ExitCode::kLocalFile);
    text << file.rdbuf();
  }
  v1::ApplyEditsRequest request;
  const auto parsed = google::protobuf::util::JsonStringToMessage(text.str(), &request);
  if (!parsed.ok()) return ReportLocalError(options.text + ": " + parsed.ToString(), ExitCode::kLocalFile);
  return RunEdits(session, std::move(request), options);
}

/// Adds a command on one object.
CLI::App* AddEdit(CLI::App& edit, const char* name, const char* what, const std::shared_ptr<EditOptions>& options,
                  Session& session, ExitCode (*run)(const Session&, const EditOptions&)) {
  CLI::App* command = edit.add_subcommand(name, what);
  command->add_option("map", options->map, "Name of the map")->required();
  command->add_option("id", options->id, "Instance id of the object")->required();
  command->callback([options, run, &session] { session.exit_code = run(session, *options); });
  return command;
}

void AddRegionOptions(CLI::App& command, EditOptions& options) {
  command.add_option("--box", options.box_m, "The box X Y Z to X Y Z (metres)")->expected(6);
  command.add_option("--sphere", options.sphere_m, "The sphere X Y Z RADIUS (metres)")->expected(4);
}

/// Adds a command on a map or on a region of it.
CLI::App* AddMapEdit(CLI::App& edit, const char* name, const char* what, const std::shared_ptr<EditOptions>& options,
                     Session& session, ExitCode (*run)(const Session&, const EditOptions&)) {
  CLI::App* command = edit.add_subcommand(name, what);
  command->add_option("map", options->map, "Name of the map")->required();
  command->callback([options, run, &session] { session.exit_code = run(session, *options); });
  return command;
}

void AddIgnoredRegionCommands(CLI::App& edit, const std::shared_ptr<EditOptions>& options, Session& session) {
  CLI::App* ignore =
      AddMapEdit(edit, "ignore-region", "Let mapping put nothing into a region", options, session, RunIgnoreRegion);
  AddRegionOptions(*ignore, *options);
  CLI::App* unignore =
      AddMapEdit(edit, "unignore-region", "Let mapping fill a region again", options, session, RunUnignoreRegion);
  for (CLI::App* command : {ignore, unignore}) {
    command->add_option("name", options->region_name, "Name of the region")->required();
  }
  CLI::App* list = AddMapEdit(edit, "ignored-regions", "List the regions that mapping leaves empty", options, session,
                              RunListIgnoredRegions);
  AddReadFlags(*list, options->read);
}

void AddRegionCommands(CLI::App& edit, const std::shared_ptr<EditOptions>& options, Session& session) {
  CLI::App* merge = AddEdit(edit, "merge", "Make other things parts of it", options, session, RunMerge);
  merge->add_option("others", options->others, "Instance ids of the others")->required();
  CLI::App* split = AddEdit(edit, "split", "Split off its connected parts, or the part in a box or before a plane",
                            options, session, RunSplit);
  CLI::Option* box =
      split->add_option("--box", options->box_m, "The part in the box X Y Z to X Y Z (metres)")->expected(6);
  split->add_option("--plane", options->plane, "The part beyond the point X Y Z along the normal X Y Z")
      ->expected(6)
      ->excludes(box);
  split->add_option("--min-voxels", options->min_voxels, "Smaller connected parts stay [16]");
  split->add_option("--class", options->class_name,
                    "Class of things that the parts become: of a background you have to say it");
  CLI::App* clear = AddMapEdit(edit, "clear", "Clear the observations in a region", options, session, RunClear);
  clear->add_option("--id", options->id, "Of this object only");
  clear->add_option("--class", options->classes, "Of objects of this class only; may be repeated")
      ->allow_extra_args(false);
  AddRegionOptions(*clear, *options);
  clear->add_option("--ignore-region", options->region_name,
                    "Let mapping put nothing there from now on, under this name");
}

/// Commands that move an object, in the map frame.
void AddMotionCommands(CLI::App& edit, const std::shared_ptr<EditOptions>& options, Session& session) {
  CLI::App* move = AddEdit(edit, "move", "Give it another pose", options, session, RunMove);
  AddPoseFlags(*move, options->pose);
  CLI::App* turn = AddEdit(edit, "turn", "Turn it about the vertical through its middle", options, session, RunTurn);
  turn->add_option("degrees", options->angle_deg, "Counterclockwise from above")->required();
  CLI::App* shift = AddEdit(edit, "shift", "Shift it", options, session, RunShift);
  shift->add_option("offset", options->offset_m, "X Y Z (metres)")->required()->expected(3);
  CLI::App* place = AddEdit(edit, "place", "Put it on another object", options, session, RunPlace);
  place->add_option("on", options->support, "Instance id of the other")->required();
  place->add_option("--at", options->at_m, "There, X Y (metres) [the middle of its upper side]")->expected(2);
  for (CLI::App* command : {move, turn, shift, place}) {
    command->add_flag("--include-supported", options->include_supported, "Also move the things that rest on it");
  }
}

}  // namespace

void AddEditCommands(CLI::App& app, Session& session) {
  CLI::App* edit = app.add_subcommand("edit", "Change objects of a map");
  edit->require_subcommand(1);
  auto options = std::make_shared<EditOptions>();
  edit->fallthrough();
  AddEditFlags(*edit, *options, "the object, or of the map where none is named");
  AddMotionCommands(*edit, options, session);
  CLI::App* clone = AddEdit(*edit, "clone", "Copy it under a new instance id", options, session, RunClone);
  AddPoseFlags(*clone, options->pose);
  clone->add_option("--name", options->text, "Display name of the copy");
  AddEdit(*edit, "delete", "Delete it", options, session, RunDelete);
  AddEdit(*edit, "relabel", "Give it another class of its kind", options, session, RunRelabel)
      ->add_option("class", options->text, "Name or id of the class")
      ->required();
  AddEdit(*edit, "rename", "Give it a display name", options, session, RunRename)
      ->add_option("name", options->text, "The new display name")
      ->required();
  AddRegionCommands(*edit, options, session);
  AddEdit(*edit, "absent", "It is no longer there", options, session, RunSetPresence<v1::Submap::ABSENT>);
  AddEdit(*edit, "present", "It is there again", options, session, RunSetPresence<v1::Submap::PRESENT>);
  AddEdit(*edit, "lock", "Mapping and refinement leave it alone from now on", options, session, RunLock<true>);
  AddEdit(*edit, "unlock", "It lives again", options, session, RunLock<false>);
  AddIgnoredRegionCommands(*edit, options, session);
  CLI::App* apply = edit->add_subcommand("apply", "Apply a list of edits as one: all of them or none");
  apply->add_option("map", options->map, "Name of the map")->required();
  apply->add_option("file", options->text, "JSON as of :applyEdits over REST; - reads standard input")->required();
  apply->callback([options, &session] { session.exit_code = RunApply(session, *options); });
}

}  // namespace dhpmap

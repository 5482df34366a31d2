// SPDX-License-Identifier: BSD-3-Clause
// dhpmap watch: prints the changes of a map as they are stored.
#include <CLI/CLI.hpp>
#include <chrono>
#include <iostream>
#include <utility>

#include "clients/cli/connection.h"
#include "clients/cli/printable.h"
#include "clients/cli/text_table.h"
#include "clients/cpp/calls/message_watch.h"
#include "dhpmap/v1/watch_service.pb.h"

namespace dhpmap {
namespace {

constexpr std::chrono::hours kAwhile{1};

struct WatchOptions {
  std::string map;
  std::int64_t from = 0;
  std::int64_t until = -1;
  std::vector<std::int64_t> ids;
  std::vector<std::string> classes;
  std::vector<double> box;
  double reconnect_s = 300;
};

v1::WatchMapRequest RequestOf(const WatchOptions& options) {
  v1::WatchMapRequest request;
  request.set_map(MapName(options.map));
  request.set_start_revision(options.from);
  v1::WatchFilter& filter = *request.mutable_filter();
  for (const std::int64_t id : options.ids) filter.add_instance_ids(id);
  for (const std::string& name : options.classes) filter.add_class_names(name);
  if (!options.box.empty()) {
    for (const int corner : {0, 3}) {
      v1::Vector3& at =
          corner == 0 ? *filter.mutable_region()->mutable_min_m() : *filter.mutable_region()->mutable_max_m();
      at.set_x(options.box[static_cast<std::size_t>(corner)]);
      at.set_y(options.box[static_cast<std::size_t>(corner) + 1]);
      at.set_z(options.box[static_cast<std::size_t>(corner) + 2]);
    }
  }
  return request;
}

/// "changed 7 sofa 'sofa 7': geometry, observation".
void PrintEvent(const v1::SubmapEvent& event) {
  const v1::Submap& submap = event.submap();
  std::cout << "  " << Lower(v1::SubmapEvent::Kind_Name(event.kind())) << " " << submap.instance_id();
  if (!submap.class_name().empty()) std::cout << " " << Printable(submap.class_name());
  if (!submap.display_name().empty()) std::cout << " '" << Printable(submap.display_name()) << "'";
  if (!event.merged_into().empty()) std::cout << " into " << event.merged_into();
  const char* separator = ": ";
  for (const int part : event.parts()) {
    std::cout << separator << Lower(v1::SubmapEvent::Part_Name(static_cast<v1::SubmapEvent::Part>(part)));
    separator = ", ";
  }
  std::cout << "\n";
}

/// "box 0 0 0 to 1 1 1 m", "sphere 0 0 0 of 0.5 m".
std::string RegionText(const v1::RegionEvent& event) {
  const auto point = [](const v1::Vector3& p_m) {
    return Fixed(p_m.x(), 2) + " " + Fixed(p_m.y(), 2) + " " + Fixed(p_m.z(), 2);
  };
  if (event.has_box()) return "box " + point(event.box().min_m()) + " to " + point(event.box().max_m()) + " m";
  return "sphere " + point(event.sphere().center_m()) + " of " + Fixed(event.sphere().radius_m(), 2) + " m";
}

/// "cleared box 0 0 0 to 1 1 1 m of chair: 120 voxels", "kept clear 'door': ...", "lifted 'door': ...".
void PrintRegion(const v1::RegionEvent& event) {
  switch (event.kind()) {
    case v1::RegionEvent::IGNORED: std::cout << "  ignored '" << Printable(event.name()) << "': "; break;
    case v1::RegionEvent::UNIGNORED: std::cout << "  unignored '" << Printable(event.name()) << "': "; break;
    default: std::cout << "  cleared ";
  }
  std::cout << RegionText(event);
  if (event.kind() == v1::RegionEvent::CLEARED) {
    if (!event.submap().empty()) std::cout << " of " << event.submap();
    const char* separator = " of ";
    for (const std::string& name : event.class_names()) {
      std::cout << separator << Printable(name);
      separator = ", ";
    }
    std::cout << ": " << event.num_voxels() << " voxels";
  }
  std::cout << "\n";
}

/// "export 3, map_file: sending, 1.5 MB of 12 MB, after 0.4 s".
void PrintExport(const v1::ExportProgress& told) {
  std::cout << "export " << told.id() << ", " << Lower(v1::ExportProgress::Kind_Name(told.kind())) << ": "
            << Lower(v1::ExportProgress::Stage_Name(told.stage()));
  if (told.total_bytes() > 0) {
    std::cout << ", " << Bytes(static_cast<double>(told.done_bytes())) << " of "
              << Bytes(static_cast<double>(told.total_bytes()));
  }
  std::cout << ", after " << Fixed(told.elapsed_s(), 1) << " s\n";
}

void Print(const v1::WatchMapResponse& message) {
  for (const v1::ExportProgress& told : message.progress().exports()) PrintExport(told);
  if (message.has_progress() && message.progress().has_finishing()) {
    const v1::FinishProgress& finishing = message.progress().finishing();
    std::cout << "mapping is being finished: " << Lower(v1::FinishProgress::Stage_Name(finishing.stage())) << ", after "
              << Fixed(finishing.elapsed_s(), 1) << " s\n";
  } else if (message.has_progress() && message.progress().exports().empty()) {
    std::cout << "all up to revision " << message.progress().revision() << " is told\n";
  }
  if (!message.has_change()) return;
  const v1::MapChange& change = message.change();
  std::cout << "revision " << change.first_revision();
  if (change.last_revision() != change.first_revision()) std::cout << " to " << change.last_revision();
  std::cout << ":";
  if (change.has_display_name()) std::cout << " the map is called '" << Printable(change.display_name()) << "'";
  std::cout << "\n";
  for (const v1::RegionEvent& event : change.regions()) PrintRegion(event);
  for (const v1::SubmapEvent& event : change.submaps()) PrintEvent(event);
}

/// The revision up to which all events were printed.
std::int64_t RevisionOf(const std::string& position) {
  const std::size_t dash = position.find('-');
  return dash == std::string::npos ? -1 : std::atoll(position.c_str() + dash + 1);
}

/// Resumes after the last position whenever the connection is lost, if it returns in time.
ExitCode RunWatch(const Session& session, const WatchOptions& options) {
  bool was_there = false, is_told = false;
  std::string position;
  const auto goes_on = [&](const client::Status& why) {
    if (was_there && !std::exchange(is_told, true)) {
      std::cerr << "dhpmap: the connection is lost, going on after " << position << ": " << why.message << "\n";
    }
    return was_there;
  };
  client::MessageWatch watch(session.caller, RequestOf(options), options.reconnect_s, goes_on);
  while (true) {
    const auto message = watch.Next(client::Clock::now() + kAwhile);
    if (!message.ok()) return ReportError(session, message.status());
    if (!*message) continue;
    was_there = true;
    is_told = false;
    position = watch.position();
    if (session.json) PrintJsonLine(**message);
    else Print(**message);
    std::cout.flush();
    if (options.until >= 0 && RevisionOf(position) >= options.until) return ExitCode::kOk;
  }
}

}  // namespace

void AddWatchCommand(CLI::App& app, Session& session) {
  auto options = std::make_shared<WatchOptions>();
  CLI::App* command = app.add_subcommand("watch", "Print the changes of a map as they are stored, until interrupted");
  command->add_option("map", options->map, "Name of the map")->required();
  command->add_option("--from", options->from, "First revision to report; default: the next one");
  command->add_option("--until", options->until, "End once everything up to this revision is told");
  command->add_option("--id", options->ids, "Of this object only; may be repeated")->allow_extra_args(false);
  command->add_option("--class", options->classes, "Of this class only, by name; may be repeated")
      ->allow_extra_args(false);
  command->add_option("--box", options->box, "Only objects that intersect the box X Y Z to X Y Z (metres)")
      ->expected(6);
  command->add_option("--reconnect-s", options->reconnect_s, "Seconds to try again for when the connection is lost")
      ->capture_default_str();
  command->callback([options, &session] { session.exit_code = RunWatch(session, *options); });
}

}  // namespace dhpmap

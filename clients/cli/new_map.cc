// SPDX-License-Identifier: BSD-3-Clause
#include "clients/cli/new_map.h"

#include <CLI/CLI.hpp>
#include <unordered_map>

#include "clients/cli/map_settings.h"
#include "dhpmap/v1/map_service.grpc.pb.h"
#include "proto/types/label_conversion.h"

namespace dhpmap {
namespace {

/// Frames refer to classes by id, so different classes would silently be mapped wrongly.
Status CheckClasses(const v1::Map& map, const Dataset& dataset) {
  std::unordered_map<std::uint32_t, const v1::LabelClass*> by_id;
  for (const v1::LabelClass& label_class : map.label_classes()) by_id[label_class.id()] = &label_class;
  for (const LabelClass& wanted : dataset.label_classes()) {
    const auto it = by_id.find(wanted.id.value);
    if (it != by_id.end() && it->second->name() == wanted.name) continue;
    return FailedPrecondition(map.name() + " was made with other classes: class " + std::to_string(wanted.id.value) +
                              " is '" + (it == by_id.end() ? "" : it->second->name()) + "' there and '" + wanted.name +
                              "' in the data set; map into a new map, or with the same --labels as before");
  }
  return Status::Ok();
}

}  // namespace

void AddNewMapOptions(CLI::App& command, NewMap& map) {
  command.add_option("--preset", map.preset, "For a new map: indoor or outdoor_lidar; default: by the data set");
  command
      .add_option("--set", map.settings,
                  "For a new map: KEY=VALUE, may be repeated; keys: map_defaults in deploy/dhpmap.yaml")
      ->allow_extra_args(false);
  command.add_option("--display-name", map.display_name, "For a new map: its name for people");
}

Result<v1::CreateMapRequest> ToRequest(const NewMap& map, const Dataset* dataset) {
  v1::CreateMapRequest request;
  request.set_map_id(MapName(map.name).substr(std::string("maps/").size()));
  request.set_display_name(map.display_name);
  request.set_preset(map.preset);
  if (dataset != nullptr && map.preset.empty()) request.set_preset(dataset->preset());
  for (const std::string& setting : map.settings) {
    DHPMAP_RETURN_IF_ERROR(ApplySetting(setting, *request.mutable_config()));
  }
  if (dataset == nullptr) return request;
  for (const LabelClass& label_class : dataset->label_classes()) *request.add_label_classes() = ToProto(label_class);
  return request;
}

client::Result<v1::Map> GetMap(const Session& session, const std::string& name, const ReadFlags& read) {
  v1::GetMapRequest request;
  request.set_name(MapName(name));
  SetRead(read, request);
  auto response = Ask(session, &v1::MapService::Stub::GetMap, request);
  if (!response.ok()) return response.status();
  return std::move(*response->mutable_map());
}

ExitCode EnsureMap(const Session& session, const NewMap& map, const Dataset& dataset) {
  const auto request = ToRequest(map, &dataset);
  if (!request.ok()) return ReportLocalError(request.status().message(), ExitCode::kUsage);
  const auto existing = GetMap(session, map.name);
  if (existing.status().code == client::StatusCode::kNotFound) {
    const auto created = Ask(session, &v1::MapService::Stub::CreateMap, *request);
    return created.ok() ? ExitCode::kOk : ReportError(session, created.status());
  }
  if (!existing.ok()) return ReportError(session, existing.status());
  if (!map.settings.empty() || !map.preset.empty()) {
    return ReportLocalError(MapName(map.name) + " is there already: --preset and --set are for new maps",
                            ExitCode::kUsage);
  }
  const Status classes = CheckClasses(*existing, dataset);
  return classes.ok() ? ExitCode::kOk : ReportLocalError(classes.message(), ExitCode::kBadRequest);
}

}  // namespace dhpmap

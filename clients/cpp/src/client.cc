// SPDX-License-Identifier: BSD-3-Clause
#include "dhpmap/client.h"

#include <utility>

#include "clients/cpp/calls/caller.h"
#include "clients/cpp/calls/error.h"
#include "clients/cpp/calls/pages.h"
#include "clients/cpp/src/convert/objects.h"
#include "clients/cpp/src/convert/server.h"

namespace dhpmap::client {
namespace {

/// "kitchen" and "maps/kitchen" -> "maps/kitchen".
std::string ResourceName(std::string_view name) {
  return name.starts_with("maps/") ? std::string(name) : "maps/" + std::string(name);
}

}  // namespace

Client::Client(std::shared_ptr<Caller> caller) : caller_(std::move(caller)) {}

Result<Client> Client::Connect(const std::string& address, const ConnectOptions& options) {
  auto caller = Caller::Connect(address, options);
  if (!caller.ok()) return caller.status();
  return Client(*std::move(caller));
}

Result<Map> Client::OpenMap(std::string_view name) const {
  Map map(caller_, ResourceName(name));
  const Result<MapInfo> info = map.Info();
  if (info.ok()) return map;
  Status status = info.status();
  if (status.code == StatusCode::kNotFound) {
    if (const Result<std::vector<MapInfo>> all = Maps(); all.ok()) {
      std::string names;
      for (const MapInfo& its : *all) names += (names.empty() ? "" : ", ") + its.name;
      status.message += "; the server's maps: " + (names.empty() ? "none" : names);
    }
  }
  return status;
}

Result<std::vector<MapInfo>> Client::Maps() const {
  const auto all = ReadAllPages(*caller_, &v1::MapService::Stub::ListMaps, v1::ListMapsRequest());
  if (!all.ok()) return all.status();
  std::vector<MapInfo> found;
  for (const v1::Map& map : all->maps()) found.push_back(FromProto(map));
  return found;
}

Result<Map> Client::CreateMap(std::string_view name, const NewMap& map) const {
  const std::string resource = ResourceName(name);
  v1::CreateMapRequest request;
  request.set_map_id(resource.substr(resource.find('/') + 1));
  request.set_display_name(map.title);
  request.set_preset(map.preset);
  if (map.voxel_size_m > 0) request.mutable_config()->set_voxel_size_m(map.voxel_size_m);
  if (map.truncation_m > 0) request.mutable_config()->set_truncation_m(map.truncation_m);
  for (const Label& label : map.classes) *request.add_label_classes() = ToProto(label);
  const auto created = caller_->Call(&v1::MapService::Stub::CreateMap, request, 0, Again::kNo);
  if (!created.ok()) return created.status();
  return Map(caller_, resource);
}

Result<ServerStatus> Client::GetStatus() const {
  const auto status = caller_->Call(&v1::ServerService::Stub::GetServerStatus, v1::GetServerStatusRequest());
  if (!status.ok()) return status.status();
  return FromProto(*status);
}

Status Client::DeleteMap(std::string_view name) const {
  v1::DeleteMapRequest request;
  request.set_name(ResourceName(name));
  return caller_->Call(&v1::MapService::Stub::DeleteMap, request, 0, Again::kNo).status();
}

}  // namespace dhpmap::client

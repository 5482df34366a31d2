// SPDX-License-Identifier: BSD-3-Clause
#include <string>
#include <utility>

#include "dhpmap/v1/map_service.grpc.pb.h"
#include "server/app/map_stats.h"
#include "server/app/submap_edits.h"
#include "server/grpc/map_conversion.h"
#include "server/grpc/resource_names.h"
#include "server/grpc/services.h"

namespace dhpmap {
namespace {

void Collect(const Status& status, const std::string& prefix, Status& bad) {
  for (const FieldViolation& violation : status.violations()) {
    bad.AddViolation(prefix + violation.field, violation.description);
  }
}

/// What a request for a new map says, all of its bad fields named at once.
Result<MapInfo> InfoFromProto(const v1::CreateMapRequest& request, const MapConfig& default_config) {
  Status bad = InvalidArgument("the map cannot be made like this").WithReason("BAD_MAP");
  MapInfo info;
  info.name = request.map_id();
  info.display_name = request.display_name();
  info.config = default_config;
  const Status name = ValidateMapName(info.name);
  for (const FieldViolation& violation : name.violations()) bad.AddViolation("map_id", violation.description);
  if (info.display_name.size() > kMaxDisplayNameBytes) {
    bad.AddViolation("display_name", "is longer than " + std::to_string(kMaxDisplayNameBytes) + " bytes");
  }
  if (!request.preset().empty()) Collect(ApplyPreset(request.preset(), info.config), "", bad);
  Collect(MergeConfig(request.config(), info.config), "", bad);
  Collect(info.config.Validate(), "config.", bad);
  auto label_set = LabelSetFromProto(request.label_classes());
  Collect(label_set.status(), "", bad);
  if (!bad.violations().empty()) return bad;
  if (!label_set.ok()) return label_set.status();
  info.label_set = std::make_shared<const LabelSet>(std::move(*label_set));
  return info;
}

Status FillStats(MapRegistry& registry, const std::string& name, v1::GetMapStatsResponse& response) {
  DHPMAP_ASSIGN_OR_RETURN(const auto session, registry.OpenSession(name));
  const auto view = session->View();
  const MapStats stats = ComputeStats(view->snapshot(), /*with_voxels=*/true);
  DHPMAP_ASSIGN_OR_RETURN(const std::int64_t disk_bytes, registry.DiskBytes(name));
  const std::int64_t num_allocated = stats.num_tsdf_blocks * kBlockVoxels;
  response.set_revision(view->snapshot().revision());
  response.set_num_frames(view->snapshot().info().num_frames);
  response.set_num_things(stats.num_things);
  response.set_num_stuff(stats.num_stuff);
  response.set_num_active(stats.num_active);
  response.set_num_tsdf_blocks(stats.num_tsdf_blocks);
  response.set_num_label_blocks(stats.num_label_blocks);
  response.set_num_allocated_voxels(num_allocated);
  response.set_num_observed_voxels(stats.num_observed_voxels);
  response.set_memory_bytes(stats.memory_bytes);
  response.set_disk_bytes(disk_bytes);
  if (num_allocated > 0) {
    response.set_memory_bytes_per_allocated_voxel(static_cast<double>(stats.memory_bytes) /
                                                  static_cast<double>(num_allocated));
  }
  return Status::Ok();
}

class MapService final : public v1::MapService::CallbackService {
 public:
  explicit MapService(const ServiceContext& context) : context_(context) {}

  grpc::ServerUnaryReactor* CreateMap(grpc::CallbackServerContext* call, const v1::CreateMapRequest* request,
                                      v1::CreateMapResponse* response) override {
    return Run(context_, call, "MapService/CreateMap", [=, this]() -> Status {
      DHPMAP_ASSIGN_OR_RETURN(MapInfo info, InfoFromProto(*request, context_.options.default_config));
      DHPMAP_ASSIGN_OR_RETURN(const MapSummary map, context_.registry.Create(std::move(info)));
      *response->mutable_map() = ToProto(map);
      response->set_revision(map.info.revision);
      return Status::Ok();
    });
  }

  grpc::ServerUnaryReactor* GetMap(grpc::CallbackServerContext* call, const v1::GetMapRequest* request,
                                   v1::GetMapResponse* response) override {
    return Run(context_, call, "MapService/GetMap", [=, this]() -> Status {
      DHPMAP_ASSIGN_OR_RETURN(const std::string name, ParseMapName(request->name(), "name"));
      DHPMAP_ASSIGN_OR_RETURN(const MapSummary map, context_.registry.Get(name));
      *response->mutable_map() = ToProto(map);
      response->set_revision(map.info.revision);
      return Status::Ok();
    });
  }

  grpc::ServerUnaryReactor* ListMaps(grpc::CallbackServerContext* call, const v1::ListMapsRequest*,
                                     v1::ListMapsResponse* response) override {
    return Run(context_, call, "MapService/ListMaps", [=, this]() -> Status {
      for (const MapSummary& map : context_.registry.List()) *response->add_maps() = ToProto(map);
      return Status::Ok();
    });
  }

  grpc::ServerUnaryReactor* DeleteMap(grpc::CallbackServerContext* call, const v1::DeleteMapRequest* request,
                                      v1::DeleteMapResponse* response) override {
    return Run(context_, call, "MapService/DeleteMap", [=, this]() -> Status {
      DHPMAP_ASSIGN_OR_RETURN(const std::string name, ParseMapName(request->name(), "name"));
      DHPMAP_ASSIGN_OR_RETURN(const std::int64_t revision, context_.registry.Delete(name));
      response->set_revision(revision);
      return Status::Ok();
    });
  }

  grpc::ServerUnaryReactor* GetMapStats(grpc::CallbackServerContext* call, const v1::GetMapStatsRequest* request,
                                        v1::GetMapStatsResponse* response) override {
    return Run(context_, call, "MapService/GetMapStats", [=, this]() -> Status {
      DHPMAP_ASSIGN_OR_RETURN(const std::string name, ParseMapName(request->name(), "name"));
      return FillStats(context_.registry, name, *response);
    });
  }

 private:
  const ServiceContext& context_;
};

}  // namespace

std::unique_ptr<grpc::Service> MakeMapService(const ServiceContext& context) {
  return std::make_unique<MapService>(context);
}

}  // namespace dhpmap

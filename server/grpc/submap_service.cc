// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <string>
#include <utility>

#include "dhpmap/v1/submap_service.grpc.pb.h"
#include "server/grpc/map_conversion.h"
#include "server/grpc/resource_names.h"
#include "server/grpc/services.h"
#include "server/grpc/submap_chunks.h"
#include "server/grpc/submap_conversion.h"
#include "server/ingest/pose_conversion.h"

namespace dhpmap {
namespace {

/// The last published state of a map, opened if it is not.
Result<std::shared_ptr<const MapView>> ViewOf(MapRegistry& registry, const std::string& map) {
  DHPMAP_ASSIGN_OR_RETURN(const auto session, registry.OpenSession(map));
  return session->View();
}

Status NoSuchSubmap(SubmapId id) {
  return NotFound("submap " + std::to_string(id.value) + " does not exist").WithReason("SUBMAP_NOT_FOUND");
}

/// Fills the answer of an edit: its revision and the submap as it is now.
template <typename Response>
Status FillOutcome(const Result<EditOutcome>& outcome, Response& response) {
  if (!outcome.ok()) return outcome.status();
  const MapSnapshot& snapshot = outcome->view->snapshot();
  response.set_revision(snapshot.revision());
  if constexpr (requires { response.mutable_submap(); }) {
    if (const Submap* submap = snapshot.Find(outcome->submap)) {
      *response.mutable_submap() = ToProto(*submap, snapshot.info());
    }
  }
  return Status::Ok();
}

Result<SubmapPatch> PatchFromProto(const v1::CloneSubmapRequest& request) {
  SubmapPatch patch;
  if (!request.display_name().empty()) patch.display_name = request.display_name();
  if (request.has_map_from_submap()) {
    DHPMAP_ASSIGN_OR_RETURN(patch.T_map_submap, TransformFromProto(request.map_from_submap(), "map_from_submap"));
  }
  return patch;
}

class SubmapService final : public v1::SubmapService::CallbackService {
 public:
  explicit SubmapService(const ServiceContext& context) : context_(context) {}

  grpc::ServerUnaryReactor* ListSubmaps(grpc::CallbackServerContext* call, const v1::ListSubmapsRequest* request,
                                        v1::ListSubmapsResponse* response) override {
    return Run(context_, call, "SubmapService/ListSubmaps", [=, this]() -> Status {
      DHPMAP_ASSIGN_OR_RETURN(const std::string map, ParseMapName(request->parent(), "parent"));
      DHPMAP_ASSIGN_OR_RETURN(const auto view, ViewOf(context_.registry, map));
      const MapSnapshot& snapshot = view->snapshot();
      DHPMAP_ASSIGN_OR_RETURN(const SubmapFilter filter, FilterFromProto(*request, *snapshot.info().label_set));
      response->set_revision(snapshot.revision());
      for (const auto& submap : SelectSubmaps(snapshot, filter)) {
        *response->add_submaps() = ToProto(*submap, snapshot.info());
      }
      return Status::Ok();
    });
  }

  grpc::ServerUnaryReactor* GetSubmap(grpc::CallbackServerContext* call, const v1::GetSubmapRequest* request,
                                      v1::GetSubmapResponse* response) override {
    return Run(context_, call, "SubmapService/GetSubmap", [=, this]() -> Status {
      DHPMAP_ASSIGN_OR_RETURN(const SubmapName name, ParseSubmapName(request->name(), "name"));
      DHPMAP_ASSIGN_OR_RETURN(const auto view, ViewOf(context_.registry, name.map));
      const Submap* submap = view->snapshot().Find(name.submap);
      if (submap == nullptr) return NoSuchSubmap(name.submap);
      response->set_revision(view->snapshot().revision());
      *response->mutable_submap() = ToProto(*submap, view->snapshot().info());
      return Status::Ok();
    });
  }

  grpc::ServerUnaryReactor* UpdateSubmap(grpc::CallbackServerContext* call, const v1::UpdateSubmapRequest* request,
                                         v1::UpdateSubmapResponse* response) override {
    return Edit(call, "SubmapService/UpdateSubmap", response, [=]() -> Result<PlannedEdit> {
      DHPMAP_ASSIGN_OR_RETURN(const SubmapName name, ParseSubmapName(request->submap().name(), "submap.name"));
      DHPMAP_RETURN_IF_ERROR(CheckUpdateMask(*request));
      const SubmapId id = name.submap;
      return PlannedEdit{name.map, [id, request](Map& map) -> Result<SubmapId> {
                           const std::string& etag = request->submap().etag();
                           DHPMAP_ASSIGN_OR_RETURN(const Submap* current, FindEditable(map, id, etag));
                           DHPMAP_ASSIGN_OR_RETURN(const SubmapPatch patch,
                                                   PatchFromProto(*request, *current, map.info()));
                           DHPMAP_RETURN_IF_ERROR(PatchSubmap(map, id, etag, patch));
                           return id;
                         }};
    });
  }

  grpc::ServerUnaryReactor* CloneSubmap(grpc::CallbackServerContext* call, const v1::CloneSubmapRequest* request,
                                        v1::CloneSubmapResponse* response) override {
    return Edit(call, "SubmapService/CloneSubmap", response, [=]() -> Result<PlannedEdit> {
      DHPMAP_ASSIGN_OR_RETURN(const SubmapName name, ParseSubmapName(request->name(), "name"));
      DHPMAP_ASSIGN_OR_RETURN(SubmapPatch patch, PatchFromProto(*request));
      const SubmapId id = name.submap;
      return PlannedEdit{name.map, [id, patch = std::move(patch)](Map& map) {
                           return dhpmap::CloneSubmap(map, id, /*etag=*/"", patch);
                         }};
    });
  }

  grpc::ServerUnaryReactor* DeleteSubmap(grpc::CallbackServerContext* call, const v1::DeleteSubmapRequest* request,
                                         v1::DeleteSubmapResponse* response) override {
    return Edit(call, "SubmapService/DeleteSubmap", response, [=]() -> Result<PlannedEdit> {
      DHPMAP_ASSIGN_OR_RETURN(const SubmapName name, ParseSubmapName(request->name(), "name"));
      const SubmapId id = name.submap;
      return PlannedEdit{name.map, [id, request](Map& map) -> Result<SubmapId> {
                           DHPMAP_RETURN_IF_ERROR(dhpmap::DeleteSubmap(map, id, request->etag()));
                           return id;
                         }};
    });
  }

  grpc::ServerWriteReactor<v1::StreamSubmapVoxelsResponse>* StreamSubmapVoxels(
      grpc::CallbackServerContext*, const v1::StreamSubmapVoxelsRequest* request) override {
    using Stream = ChunkStream<v1::StreamSubmapVoxelsResponse>;
    return Stream::Start(context_, "SubmapService/StreamSubmapVoxels", [=, this]() -> Result<Stream::Next> {
      DHPMAP_ASSIGN_OR_RETURN(const SubmapName name, ParseSubmapName(request->name(), "name"));
      const double limit_m = request->max_abs_distance_m();
      if (!std::isfinite(limit_m) || limit_m < 0) {
        return InvalidArgument("max_abs_distance_m is not usable")
            .WithReason("BAD_DISTANCE")
            .WithViolation("max_abs_distance_m", "must be finite and 0 or more");
      }
      DHPMAP_ASSIGN_OR_RETURN(const auto view, ViewOf(context_.registry, name.map));
      if (view->snapshot().Find(name.submap) == nullptr) return NoSuchSubmap(name.submap);
      return Stream::Next(StreamVoxels(view->shared_snapshot(), name.submap, limit_m));
    });
  }

  grpc::ServerWriteReactor<v1::GetSubmapMeshResponse>* GetSubmapMesh(grpc::CallbackServerContext*,
                                                                     const v1::GetSubmapMeshRequest* request) override {
    using Stream = ChunkStream<v1::GetSubmapMeshResponse>;
    return Stream::Start(context_, "SubmapService/GetSubmapMesh", [=, this]() -> Result<Stream::Next> {
      std::optional<SubmapId> submap;
      std::string map;
      if (request->name().find("/submaps/") == std::string::npos) {
        DHPMAP_ASSIGN_OR_RETURN(map, ParseMapName(request->name(), "name"));
      } else {
        DHPMAP_ASSIGN_OR_RETURN(SubmapName name, ParseSubmapName(request->name(), "name"));
        map = std::move(name.map);
        submap = name.submap;
      }
      DHPMAP_ASSIGN_OR_RETURN(const auto view, ViewOf(context_.registry, map));
      return StreamMesh(view->snapshot(), submap, request->format(), request->coloring());
    });
  }

 private:
  /// What is to be done on which map's writer thread.
  struct PlannedEdit {
    std::string map;
    std::function<Result<SubmapId>(Map&)> change;
  };

  /// Runs an edit without holding a thread while it waits for the writer and the disk.
  template <typename Response, typename Plan>
  grpc::ServerUnaryReactor* Edit(grpc::CallbackServerContext* call, std::string_view method, Response* response,
                                 Plan plan) {
    return RunAsync(context_, call, method, [this, response, plan](const Respond& respond) {
      auto planned = plan();
      if (!planned.ok()) return respond(planned.status());
      const auto session = context_.registry.OpenSession(planned->map);
      if (!session.ok()) return respond(session.status());
      (*session)->Edit(std::move(planned->change), [respond, response](const Result<EditOutcome>& outcome) {
        respond(RunGuarded([&] { return FillOutcome(outcome, *response); }));
      });
    });
  }

  const ServiceContext& context_;
};

}  // namespace

std::unique_ptr<grpc::Service> MakeSubmapService(const ServiceContext& context) {
  return std::make_unique<SubmapService>(context);
}

}  // namespace dhpmap

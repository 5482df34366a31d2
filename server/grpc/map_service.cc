// SPDX-License-Identifier: BSD-3-Clause
#include <string>
#include <utility>

#include "dhpmap/v1/map_service.grpc.pb.h"
#include "server/app/map_stats.h"
#include "server/grpc/edit_call.h"
#include "server/grpc/import_stream.h"
#include "server/grpc/services.h"
#include "server/wire/bulk_chunks.h"
#include "server/wire/map_conversion.h"
#include "server/wire/paging.h"
#include "server/wire/types/resource_names.h"

namespace dhpmap {
namespace {

class MapService final : public v1::MapService::CallbackService {
 public:
  explicit MapService(const ServiceContext& context) : context_(context) {}

  grpc::ServerUnaryReactor* CreateMap(grpc::CallbackServerContext*, const v1::CreateMapRequest* request,
                                      v1::CreateMapResponse* response) override {
    return Run(context_, {"MapService/CreateMap", request}, [=, this]() -> Status {
      DHPMAP_ASSIGN_OR_RETURN(MapInfo info, InfoFromProto(*request, context_.options.default_config));
      DHPMAP_ASSIGN_OR_RETURN(const MapSummary map, context_.registry.Create(std::move(info)));
      *response->mutable_map() = ToProto(map);
      response->set_revision(map.info.revision);
      return Status::Ok();
    });
  }

  grpc::ServerUnaryReactor* GetMap(grpc::CallbackServerContext*, const v1::GetMapRequest* request,
                                   v1::GetMapResponse* response) override {
    return Run(context_, {"MapService/GetMap", request, response}, [=, this]() -> Status {
      DHPMAP_ASSIGN_OR_RETURN(const std::string name, ParseMapName(request->name(), "name"));
      DHPMAP_ASSIGN_OR_RETURN(const MapSummary map, context_.registry.Get(name));
      *response->mutable_map() = ToProto(map);
      response->set_revision(map.info.revision);
      return Status::Ok();
    });
  }

  grpc::ServerUnaryReactor* ListMaps(grpc::CallbackServerContext*, const v1::ListMapsRequest* request,
                                     v1::ListMapsResponse* response) override {
    return Run(context_, {"MapService/ListMaps", request, response}, [=, this]() -> Status {
      DHPMAP_ASSIGN_OR_RETURN(Pager pager, Pager::Begin(*request, PageMark{}));
      for (const MapSummary& map : context_.registry.List(pager.after(), pager.num_wanted())) {
        v1::Map proto = ToProto(map);
        if (!request->include_label_classes()) proto.clear_label_classes();
        if (!pager.Takes(proto, map.info.name)) break;
        *response->add_maps() = std::move(proto);
      }
      response->set_next_page_token(pager.NextToken());
      return Status::Ok();
    });
  }

  grpc::ServerUnaryReactor* UpdateMap(grpc::CallbackServerContext*, const v1::UpdateMapRequest* request,
                                      v1::UpdateMapResponse* response) override {
    return RunAsync(context_, {.method = "MapService/UpdateMap", .request = request, .opens = request->map().name()},
                    [=, this](const Respond& respond, const std::stop_token&) {
                      const auto name = ParseMapName(request->map().name(), "map.name");
                      if (!name.ok()) return respond(name.status());
                      const auto patch = PatchFromProto(*request);
                      if (!patch.ok()) return respond(patch.status());
                      const auto session = context_.registry.OpenSession(*name);
                      if (!session.ok()) return respond(session.status());
                      auto change = [etag = request->map().etag(), patch = *patch](Map& map) -> Result<EditMade> {
                        DHPMAP_RETURN_IF_ERROR(PatchMap(map, etag, patch));
                        return EditMade{kUnknownSubmap, {.steps = {{EditAction::kRenameMap, kUnknownSubmap}}}};
                      };
                      (*session)->Edit(EditRequest{.change = std::move(change)},
                                       [respond, response](const Result<EditOutcome>& outcome) {
                                         RespondToEdit(outcome, respond, [&]() -> Status {
                                           const MapSnapshot& snapshot = outcome->view->snapshot();
                                           *response->mutable_map() = ToProto(SummaryOf(snapshot));
                                           response->set_revision(snapshot.revision());
                                           return Status::Ok();
                                         });
                                       });
                    });
  }

  grpc::ServerUnaryReactor* DeleteMap(grpc::CallbackServerContext*, const v1::DeleteMapRequest* request,
                                      v1::DeleteMapResponse* response) override {
    return Run(context_, {"MapService/DeleteMap", request}, [=, this]() -> Status {
      DHPMAP_ASSIGN_OR_RETURN(const std::string name, ParseMapName(request->name(), "name"));
      DHPMAP_ASSIGN_OR_RETURN(const std::int64_t revision, context_.registry.Delete(name, request->etag()));
      response->set_revision(revision);
      return Status::Ok();
    });
  }

  grpc::ServerWriteReactor<v1::BackupMapResponse>* BackupMap(grpc::CallbackServerContext* call,
                                                             const v1::BackupMapRequest* request) override {
    using Stream = ChunkStream<v1::BackupMapResponse>;
    return Stream::Start(
        context_, call, {"MapService/BackupMap", request},
        [this](const std::stop_token& stop, const StreamKeeps&) -> Result<Stream::Next> {
          DHPMAP_ASSIGN_OR_RETURN(std::unique_ptr<StoreBackup> backup, context_.registry.Backup(stop));
          return Stream::Next([chunks = FileChunks(std::move(backup))](v1::BackupMapResponse& message) mutable {
            return chunks.Next(message);
          });
        });
  }

  grpc::ServerWriteReactor<v1::ExportMapResponse>* ExportMap(grpc::CallbackServerContext* call,
                                                             const v1::ExportMapRequest* request) override {
    using Stream = ChunkStream<v1::ExportMapResponse>;
    return Stream::Start(
        context_, call, {"MapService/ExportMap", request},
        [=, this](const std::stop_token& stop, const StreamKeeps&) -> Result<Stream::Next> {
          DHPMAP_ASSIGN_OR_RETURN(const std::string name, ParseMapName(request->name(), "name"));
          DHPMAP_ASSIGN_OR_RETURN(std::unique_ptr<StoreBackup> file, context_.registry.Export(name, stop));
          return Stream::Next([chunks = FileChunks(std::move(file))](v1::ExportMapResponse& message) mutable {
            return chunks.Next(message);
          });
        });
  }

  grpc::ServerReadReactor<v1::ImportMapRequest>* ImportMap(grpc::CallbackServerContext*,
                                                           v1::ImportMapResponse* response) override {
    return ImportStream::Start(context_, response);
  }

  grpc::ServerUnaryReactor* VerifyMap(grpc::CallbackServerContext*, const v1::VerifyMapRequest* request,
                                      v1::VerifyMapResponse* response) override {
    return RunBulk(
        context_, {"MapService/VerifyMap", request, response}, 0, [=, this](const std::stop_token& stop) -> Status {
          DHPMAP_ASSIGN_OR_RETURN(const std::string name, ParseMapName(request->name(), "name"));
          DHPMAP_ASSIGN_OR_RETURN(const VerifyReport report, context_.registry.Verify(name, request->repair(), stop));
          *response = ToProto(report);
          return Status::Ok();
        });
  }

  grpc::ServerUnaryReactor* GetMapStats(grpc::CallbackServerContext*, const v1::GetMapStatsRequest* request,
                                        v1::GetMapStatsResponse* response) override {
    return RunBulk(context_, {"MapService/GetMapStats", request, response}, 0,
                   [=, this](const std::stop_token&) -> Status {
                     DHPMAP_ASSIGN_OR_RETURN(const std::string name, ParseMapName(request->name(), "name"));
                     DHPMAP_ASSIGN_OR_RETURN(const MapReport report, ReportOf(context_.registry, name));
                     *response = ToProto(report);
                     return Status::Ok();
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

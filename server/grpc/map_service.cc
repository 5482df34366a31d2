// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "dhpmap/v1/map_service.grpc.pb.h"
#include "proto/types/resource_names.h"
#include "server/app/maps/map_stats.h"
#include "server/grpc/answered_anywhere.h"
#include "server/grpc/counted_service.h"
#include "server/grpc/damaged_maps.h"
#include "server/grpc/edit_call.h"
#include "server/grpc/import_stream.h"
#include "server/grpc/map_quota.h"
#include "server/grpc/read_view.h"
#include "server/grpc/services.h"
#include "server/wire/bulk_chunks.h"
#include "server/wire/map_conversion.h"
#include "server/wire/paging.h"

namespace dhpmap {
namespace {

class MapService final : public CountedService<v1::MapService> {
 public:
  explicit MapService(const ServiceContext& context) : CountedService(context), context_(context) {
    Take(&MapService::CreateMap, &MapService::GetMap, &MapService::ListMaps, &MapService::UpdateMap,
         &MapService::DeleteMap, &MapService::BackupMaps, &MapService::ExportMap, &MapService::VerifyMap,
         &MapService::GetMapStats, &MapService::ListMapRevisions);
    TakeStream<v1::ImportMapRequest>(&MapService::BeginImport);
  }

  grpc::ServerUnaryReactor* CreateMap(grpc::CallbackServerContext* call, const v1::CreateMapRequest* request,
                                      v1::CreateMapResponse* response) override {
    return Run(context_, {"MapService/CreateMap", request}, [=, this, caller = CallerOf(*call)]() -> Status {
      DHPMAP_ASSIGN_OR_RETURN(MapInfo info, InfoFromProto(*request, context_.options.default_config));
      DHPMAP_ASSIGN_OR_RETURN(const auto making, context_.quota.Begin(caller));
      DHPMAP_ASSIGN_OR_RETURN(const MapSummary map, context_.registry.Create(std::move(info)));
      if (making != nullptr) making->Done(map);
      *response->mutable_map() = ToProto(map);
      response->set_revision(map.info.revision);
      return Status::Ok();
    });
  }

  grpc::ServerUnaryReactor* GetMap(grpc::CallbackServerContext*, const v1::GetMapRequest* request,
                                   v1::GetMapResponse* response) override {
    // A past state needs an open map. The present state of a closed map comes from the store, which is quick if this
    // process owns the database.
    const bool waits = request->read_revision() != 0 || context_.registry.SharesStore();
    const std::string_view opens = waits ? request->name() : std::string_view();
    return Run(context_, {"MapService/GetMap", request, response, opens}, [=, this]() -> Status {
      DHPMAP_ASSIGN_OR_RETURN(const std::string name, ParseMapName(request->name(), "name"));
      DHPMAP_ASSIGN_OR_RETURN(const MapSummary map, SummaryAt(name, *request));
      *response->mutable_map() = ToProto(map);
      response->set_revision(map.info.revision);
      return Status::Ok();
    });
  }

  grpc::ServerUnaryReactor* ListMaps(grpc::CallbackServerContext* call, const v1::ListMapsRequest* request,
                                     v1::ListMapsResponse* response) override {
    Lane& lane = context_.registry.SharesStore() ? context_.lanes.loads : context_.lanes.quick;
    return RunAsyncIn(lane, context_, {"MapService/ListMaps", request, response}, 0,
                      [=, this, caller = CallerOf(*call)](const Respond& respond, const std::stop_token&) {
                        respond(List(caller, *request, *response));
                      });
  }

  grpc::ServerUnaryReactor* UpdateMap(grpc::CallbackServerContext*, const v1::UpdateMapRequest* request,
                                      v1::UpdateMapResponse* response) override {
    const auto plan = [=, this]() -> Result<PlannedEdit> {
      DHPMAP_ASSIGN_OR_RETURN(const std::string name, ParseMapName(request->map().name(), "map.name"));
      DHPMAP_ASSIGN_OR_RETURN(MapPatch patch, PatchFromProto(*request));
      EditConditions conditions =
          ConditionsOf(*request, request->map().etag(), *context_.registry.LostRevisionsOf(name));
      return PlanEdit("UpdateMap", *request, name, context_.registry.PatchOf(std::move(patch), std::move(conditions)));
    };
    const auto fill = [](const MapView& view, const EditMade&, v1::UpdateMapResponse& answer) {
      *answer.mutable_map() = ToProto(SummaryOf(view.snapshot()));
      answer.set_revision(view.snapshot().revision());
    };
    return RunEdit(context_, {.method = "MapService/UpdateMap", .request = request, .opens = request->map().name()},
                   response, plan, fill);
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

  grpc::ServerWriteReactor<v1::BackupMapsResponse>* BackupMaps(grpc::CallbackServerContext* call,
                                                               const v1::BackupMapsRequest* request) override {
    using Stream = ChunkStream<v1::BackupMapsResponse>;
    return Stream::Start(
        context_, call, {"MapService/BackupMaps", request},
        [this](const std::stop_token& stop, const StreamKeeps&) -> Result<Stream::Next> {
          DHPMAP_ASSIGN_OR_RETURN(std::unique_ptr<StoreBackup> backup, context_.registry.Backup(stop));
          return Stream::Next([chunks = FileChunks(std::move(backup))](v1::BackupMapsResponse& message) mutable {
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

  grpc::ServerReadReactor<grpc::ByteBuffer>* BeginImport(grpc::CallbackServerContext* call,
                                                         v1::ImportMapResponse* response) {
    return ImportStream::Start(context_, CallerOf(*call), response);
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

  grpc::ServerUnaryReactor* ListMapRevisions(grpc::CallbackServerContext*, const v1::ListMapRevisionsRequest* request,
                                             v1::ListMapRevisionsResponse* response) override {
    return Run(context_, {"MapService/ListMapRevisions", request, response, request->parent()}, [=, this]() -> Status {
      DHPMAP_ASSIGN_OR_RETURN(const std::string name, ParseMapName(request->parent(), "parent"));
      DHPMAP_ASSIGN_OR_RETURN(const auto open_map, context_.registry.GetOpen(name));
      std::vector<SnapshotHistory::State> states = open_map->history()->All();
      const SnapshotHistory::State present = open_map->View()->shared_snapshot();
      // The history gets a state before the writer publishes it.
      while (!states.empty() && states.back()->revision() > present->revision()) states.pop_back();
      if (states.empty() || states.back()->revision() < present->revision()) states.push_back(present);
      const PageMark now{.history_id = present->info().history_id, .revision = present->revision()};
      DHPMAP_ASSIGN_OR_RETURN(Pager pager, Pager::Begin(*request, now, *context_.registry.LostRevisionsOf(name)));
      DHPMAP_ASSIGN_OR_RETURN(const auto before, RevisionFromPage(pager));
      for (auto state = states.rbegin(); state != states.rend(); ++state) {
        const std::int64_t revision = (*state)->revision();
        if (before && revision >= *before) continue;
        v1::MapRevision proto = RevisionToProto((*state)->info());
        if (!pager.Takes(proto, std::to_string(revision))) break;
        *response->add_revisions() = std::move(proto);
      }
      response->set_next_page_token(pager.NextToken());
      return Status::Ok();
    });
  }

  grpc::ServerUnaryReactor* GetMapStats(grpc::CallbackServerContext*, const v1::GetMapStatsRequest* request,
                                        v1::GetMapStatsResponse* response) override {
    return RunBulk(context_, {"MapService/GetMapStats", request, response}, 0,
                   [=, this](const std::stop_token& stop) -> Status {
                     DHPMAP_ASSIGN_OR_RETURN(const std::string name, ParseMapName(request->name(), "name"));
                     DHPMAP_ASSIGN_OR_RETURN(const MapReport report, ReportAt(name, *request, stop));
                     *response = ToProto(report);
                     return Status::Ok();
                   });
  }

 private:
  /// A page of the maps that the caller may see.
  Status List(const Caller& caller, const v1::ListMapsRequest& request, v1::ListMapsResponse& response) {
    constexpr std::size_t kMapsALook = 128;  // per look; label sets can be large
    DHPMAP_ASSIGN_OR_RETURN(Pager pager, Pager::Begin(request, PageMark{}));
    const std::size_t num_wanted = std::min(kMapsALook, pager.num_wanted());
    bool has_more = true;
    for (std::string after = pager.after(); has_more;) {
      DHPMAP_ASSIGN_OR_RETURN(const auto maps, context_.registry.List(after, num_wanted));
      has_more = AddMaps(maps, caller, request, pager, response) && maps.size() == num_wanted;
      if (has_more) after = maps.back().info.name;
    }
    response.set_next_page_token(pager.NextToken());
    return Status::Ok();
  }
  /// False if the page is full.
  bool AddMaps(const std::vector<MapSummary>& maps, const Caller& caller, const v1::ListMapsRequest& request,
               Pager& pager, v1::ListMapsResponse& response) {
    for (const MapSummary& map : maps) {
      if (!caller.MaySee(map.info.name)) continue;
      if (!map.damage.ok()) damaged_.Tell(map);
      v1::Map proto = ToProto(map);
      if (!request.include_label_classes()) proto.clear_label_classes();
      if (!pager.Takes(proto, map.info.name)) return false;
      *response.add_maps() = std::move(proto);
    }
    return true;
  }
  Result<MapSummary> SummaryAt(const std::string& map, const v1::GetMapRequest& request) const {
    if (AnsweredAnywhere(request)) return context_.registry.GetEventual(map);
    if (request.read_revision() == 0) return context_.registry.Get(map);
    DHPMAP_ASSIGN_OR_RETURN(const auto view, ViewFor(context_, map, request));
    return SummaryOf(view->snapshot());
  }
  Result<MapReport> ReportAt(const std::string& map, const v1::GetMapStatsRequest& request,
                             const std::stop_token& stop) const {
    DHPMAP_ASSIGN_OR_RETURN(const auto view, ViewFor(context_, map, request));
    return ReportOf(context_.registry, *view, OnBulkLane(context_), stop);
  }

  const ServiceContext& context_;
  DamagedMaps damaged_;
};

}  // namespace

std::unique_ptr<grpc::Service> MakeMapService(const ServiceContext& context) {
  return std::make_unique<MapService>(context);
}

}  // namespace dhpmap

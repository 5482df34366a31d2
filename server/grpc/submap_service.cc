// SPDX-License-Identifier: BSD-3-Clause
#include <memory>
#include <string>
#include <utility>

#include "dhpmap/v1/submap_service.grpc.pb.h"
#include "proto/types/metadata_keys.h"
#include "proto/types/resource_names.h"
#include "server/app/edits/edit_list.h"
#include "server/app/edits/edit_summary.h"
#include "server/grpc/counted_service.h"
#include "server/grpc/edit_call.h"
#include "server/grpc/read_view.h"
#include "server/grpc/services.h"
#include "server/wire/bulk_chunks.h"
#include "server/wire/edit_log_conversion.h"
#include "server/wire/paging.h"
#include "server/wire/submap_conversion.h"

namespace dhpmap {
namespace {

std::string HeldEtagsOf(const grpc::CallbackServerContext& call) {
  const auto found = call.client_metadata().find(kHeldEtagsKey);
  return found == call.client_metadata().end() ? std::string()
                                               : std::string(found->second.data(), found->second.size());
}

/// Fills the answer of an edit: its revision and the submap as it is now.
constexpr auto kFillAnswer = [](const MapView& view, const EditMade& made, auto& response) {
  const MapSnapshot& snapshot = view.snapshot();
  response.set_revision(snapshot.revision());
  if constexpr (requires { response.mutable_submap(); }) {
    if (const Submap* submap = snapshot.Find(made.submap)) *response.mutable_submap() = ToProto(*submap, view);
  }
};

class SubmapService final : public CountedService<v1::SubmapService> {
 public:
  explicit SubmapService(const ServiceContext& context) : CountedService(context), context_(context) {
    Take(&SubmapService::ListSubmaps, &SubmapService::GetSubmap, &SubmapService::UpdateSubmap,
         &SubmapService::CloneSubmap, &SubmapService::DeleteSubmap, &SubmapService::UndeleteSubmap,
         &SubmapService::StreamSubmapVoxels, &SubmapService::GetSubmapMesh);
  }

  grpc::ServerUnaryReactor* ListSubmaps(grpc::CallbackServerContext*, const v1::ListSubmapsRequest* request,
                                        v1::ListSubmapsResponse* response) override {
    return Run(context_, {"SubmapService/ListSubmaps", request, response, request->parent()}, [=, this]() -> Status {
      DHPMAP_ASSIGN_OR_RETURN(const std::string map, ParseMapName(request->parent(), "parent"));
      DHPMAP_ASSIGN_OR_RETURN(const auto view, ViewFor(context_, map, *request));
      const MapSnapshot& snapshot = view->snapshot();
      DHPMAP_ASSIGN_OR_RETURN(const SubmapFilter filter, FilterFromProto(*request, *snapshot.info().label_set));
      const PageMark now{.history_id = snapshot.info().history_id, .revision = snapshot.revision()};
      DHPMAP_ASSIGN_OR_RETURN(Pager pager, Pager::Begin(*request, now, *context_.registry.LostRevisionsOf(map)));
      DHPMAP_ASSIGN_OR_RETURN(const auto after, SubmapIdFromPage(pager));
      response->set_revision(snapshot.revision());
      for (const auto& submap : SelectSubmaps(snapshot, filter, after, pager.num_wanted())) {
        v1::Submap proto = ToProto(*submap, *view);
        if (!pager.Takes(proto, std::to_string(submap->id().value))) break;
        *response->add_submaps() = std::move(proto);
      }
      response->set_next_page_token(pager.NextToken());
      return Status::Ok();
    });
  }

  grpc::ServerUnaryReactor* GetSubmap(grpc::CallbackServerContext*, const v1::GetSubmapRequest* request,
                                      v1::GetSubmapResponse* response) override {
    return Run(context_, {"SubmapService/GetSubmap", request, response, request->name()}, [=, this]() -> Status {
      DHPMAP_ASSIGN_OR_RETURN(const SubmapName name, ParseSubmapName(request->name(), "name"));
      DHPMAP_ASSIGN_OR_RETURN(const auto view, ViewFor(context_, name.map, *request));
      const Submap* submap = view->snapshot().Find(name.submap);
      if (submap == nullptr) return NoSuchSubmap(view->snapshot().info(), name.submap);
      response->set_revision(view->snapshot().revision());
      *response->mutable_submap() = ToProto(*submap, *view, OutlineCache::Reading::kAllowed);
      return Status::Ok();
    });
  }

  grpc::ServerUnaryReactor* UpdateSubmap(grpc::CallbackServerContext*, const v1::UpdateSubmapRequest* request,
                                         v1::UpdateSubmapResponse* response) override {
    const auto plan = [=, this]() -> Result<PlannedEdit> {
      DHPMAP_ASSIGN_OR_RETURN(const SubmapName name, ParseSubmapName(request->submap().name(), "submap.name"));
      DHPMAP_ASSIGN_OR_RETURN(SubmapPatch patch, PatchFromProto(*request));
      return PlanOne("UpdateSubmap", *request, name, request->submap().etag(), PatchEdit{std::move(patch)});
    };
    return RunEdit(context_,
                   {.method = "SubmapService/UpdateSubmap", .request = request, .opens = request->submap().name()},
                   response, plan, kFillAnswer);
  }

  grpc::ServerUnaryReactor* CloneSubmap(grpc::CallbackServerContext*, const v1::CloneSubmapRequest* request,
                                        v1::CloneSubmapResponse* response) override {
    const auto plan = [=, this]() -> Result<PlannedEdit> {
      DHPMAP_ASSIGN_OR_RETURN(const SubmapName name, ParseSubmapName(request->name(), "name"));
      DHPMAP_ASSIGN_OR_RETURN(SubmapPatch patch, PatchFromProto(*request));
      return PlanOne("CloneSubmap", *request, name, request->etag(), CloneEdit{std::move(patch)});
    };
    return RunEdit(context_, {.method = "SubmapService/CloneSubmap", .request = request, .opens = request->name()},
                   response, plan, kFillAnswer);
  }

  grpc::ServerUnaryReactor* DeleteSubmap(grpc::CallbackServerContext*, const v1::DeleteSubmapRequest* request,
                                         v1::DeleteSubmapResponse* response) override {
    const auto plan = [=, this]() -> Result<PlannedEdit> {
      DHPMAP_ASSIGN_OR_RETURN(const SubmapName name, ParseSubmapName(request->name(), "name"));
      return PlanOne("DeleteSubmap", *request, name, request->etag(), DeleteEdit{});
    };
    return RunEdit(context_, {.method = "SubmapService/DeleteSubmap", .request = request, .opens = request->name()},
                   response, plan, kFillAnswer);
  }

  grpc::ServerUnaryReactor* UndeleteSubmap(grpc::CallbackServerContext*, const v1::UndeleteSubmapRequest* request,
                                           v1::UndeleteSubmapResponse* response) override {
    const auto plan = [=, this]() -> Result<PlannedEdit> {
      DHPMAP_ASSIGN_OR_RETURN(const SubmapName name, ParseSubmapName(request->name(), "name"));
      EditConditions conditions = ConditionsOf(*request, request->etag(), *context_.registry.LostRevisionsOf(name.map));
      return PlanEdit("UndeleteSubmap", *request, name.map,
                      context_.registry.UndeletionOf(name.submap, std::move(conditions)));
    };
    return RunEdit(context_, {.method = "SubmapService/UndeleteSubmap", .request = request, .opens = request->name()},
                   response, plan, kFillAnswer);
  }

  grpc::ServerWriteReactor<v1::StreamSubmapVoxelsResponse>* StreamSubmapVoxels(
      grpc::CallbackServerContext* call, const v1::StreamSubmapVoxelsRequest* request) override {
    using Stream = ChunkStream<v1::StreamSubmapVoxelsResponse>;
    return Stream::Start(
        context_, call, {"SubmapService/StreamSubmapVoxels", request},
        [=, this](const std::stop_token&, const StreamKeeps& keeps) -> Result<Stream::Next> {
          DHPMAP_ASSIGN_OR_RETURN(const SubmapName name, ParseSubmapName(request->name(), "name"));
          DHPMAP_ASSIGN_OR_RETURN(const auto view, ViewFor(context_, name.map, *request));
          const auto state = OnlySubmap(view->snapshot(), name.submap);
          if (state == nullptr) return NoSuchSubmap(view->snapshot().info(), name.submap);
          DHPMAP_RETURN_IF_ERROR(keeps.hold(state));
          DHPMAP_ASSIGN_OR_RETURN(
              VoxelWalk walk, VoxelWalk::Begin(state, name.submap, request->max_abs_tsdf_m(), OnBulkLane(context_)));
          return Stream::Next([chunks = VoxelChunks(std::move(walk))](v1::StreamSubmapVoxelsResponse& message) mutable {
            return chunks.Next(message);
          });
        });
  }

  grpc::ServerWriteReactor<v1::GetSubmapMeshResponse>* GetSubmapMesh(grpc::CallbackServerContext* call,
                                                                     const v1::GetSubmapMeshRequest* request) override {
    using Stream = ChunkStream<v1::GetSubmapMeshResponse>;
    return Stream::Start(
        context_, call, {"SubmapService/GetSubmapMesh", request},
        [=, this, held_etags = HeldEtagsOf(*call)](const std::stop_token& stop,
                                                   const StreamKeeps& keeps) -> Result<Stream::Next> {
          DHPMAP_ASSIGN_OR_RETURN(const ObjectName name, ParseObjectName(request->name(), "name"));
          DHPMAP_ASSIGN_OR_RETURN(MeshRequest wanted, MeshRequestFromProto(*request, name.submap));
          wanted.held_etags = held_etags;
          DHPMAP_ASSIGN_OR_RETURN(const auto view, ViewFor(context_, name.map, *request));
          auto state = view->shared_snapshot();
          // A GLB also depends on the surroundings: ExportMesh selects the submap.
          if (wanted.submap && wanted.format != MeshFormat::kGlb) state = OnlySubmap(*state, *wanted.submap);
          if (state == nullptr) return NoSuchSubmap(view->snapshot().info(), *wanted.submap);
          DHPMAP_RETURN_IF_ERROR(keeps.hold(state));
          DHPMAP_ASSIGN_OR_RETURN(MeshFile file, MeshOf(std::move(state), wanted, keeps, stop));
          return Stream::Next([chunks = std::make_shared<MeshChunks>(std::move(file))](
                                  v1::GetSubmapMeshResponse& message) mutable { return chunks->Next(message); });
        });
  }

 private:
  Result<MeshFile> MeshOf(std::shared_ptr<const MapSnapshot> state, const MeshRequest& wanted, const StreamKeeps& keeps,
                          const std::stop_token& stop) {
    if (wanted.format == MeshFormat::kGlb) {
      const auto room_for = [&keeps](std::size_t num_bytes) {
        return keeps.room.Grow(num_bytes) ? Status::Ok() : TooManyBytes();
      };
      return ExportGlb(state, wanted, glbs_, room_for, stop, OnBulkLane(context_));
    }
    if (!keeps.room.Grow(BytesOfExport(*state, wanted))) return TooManyBytes();
    return ExportMesh(std::move(state), wanted, stop, OnBulkLane(context_));
  }

  /// A list of one edit, so that the common fields of edit requests mean the same as in ApplyEdits.
  template <typename Request, typename Action>
  Result<PlannedEdit> PlanOne(const char* method, const Request& request, const SubmapName& name,
                              const std::string& etag, Action action) const {
    EditList list{.edits = {{.target = name.submap, .etag = etag, .action = std::move(action)}},
                  .expected_revision = request.expected_revision(),
                  .lost = *context_.registry.LostRevisionsOf(name.map)};
    auto change = [list = std::make_shared<const EditList>(std::move(list)),
                   id = name.submap](Map& map) -> Result<EditMade> {
      DHPMAP_ASSIGN_OR_RETURN(const EditResult result, ApplyOneEdit(*list, map));
      return EditMade{.submap = result.created.empty() ? id : result.created.front(),
                      .summary = SummaryOfList(*list, {result})};
    };
    return PlanEdit(method, request, name.map, std::move(change));
  }

  /// Enough for some apartments: repeated requests for the same mesh are answered at once.
  static constexpr std::size_t kGlbBytes = 64u << 20;

  const ServiceContext& context_;
  GlbCache glbs_{kGlbBytes};
};

}  // namespace

std::unique_ptr<grpc::Service> MakeSubmapService(const ServiceContext& context) {
  return std::make_unique<SubmapService>(context);
}

}  // namespace dhpmap

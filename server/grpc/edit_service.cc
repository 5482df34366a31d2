// SPDX-License-Identifier: BSD-3-Clause
#include <memory>
#include <utility>
#include <vector>

#include "dhpmap/v1/edit_service.grpc.pb.h"
#include "server/app/edits/edit_list.h"
#include "server/app/edits/edit_summary.h"
#include "server/grpc/counted_service.h"
#include "server/grpc/edit_call.h"
#include "server/grpc/read_view.h"
#include "server/grpc/services.h"
#include "server/wire/edit_conversion.h"
#include "server/wire/edit_log_conversion.h"
#include "server/wire/types/resource_names.h"

namespace dhpmap {
namespace {

/// What the writer's thread makes, and the answer tells.
using Results = std::vector<EditResult>;

/// Fills the answer of an undo, a redo or a restoration.
constexpr auto kFillUndone = [](const MapView& view, const EditMade& made, auto& response) {
  const std::string& map = view.snapshot().info().name;
  response.set_revision(view.snapshot().revision());
  if constexpr (requires { response.add_edits(std::string()); }) {
    for (const std::int64_t edit : made.summary.targets) response.add_edits(EditResourceName(map, edit));
  }
  for (const SubmapId id : made.summary.changed) response.add_changed(SubmapResourceName(map, id));
  for (const SubmapId id : made.summary.created) response.add_created(SubmapResourceName(map, id));
  for (const SubmapId id : made.summary.removed) response.add_removed(SubmapResourceName(map, id));
};

class EditService final : public CountedService<v1::EditService> {
 public:
  explicit EditService(const ServiceContext& context) : CountedService(context), context_(context) {
    Take(&EditService::ApplyEdits, &EditService::UndoEdits, &EditService::RedoEdits, &EditService::RestoreRevision,
         &EditService::ListEdits, &EditService::ListKeptClear);
  }

  grpc::ServerUnaryReactor* ApplyEdits(grpc::CallbackServerContext*, const v1::ApplyEditsRequest* request,
                                       v1::ApplyEditsResponse* response) override {
    const auto results = std::make_shared<Results>();
    return RunEdit(
        context_, {.method = "EditService/ApplyEdits", .request = request, .opens = request->map()}, response,
        [=, this] { return PlanList(*request, results); },
        [results](const MapView& view, const EditMade&, v1::ApplyEditsResponse& answer) {
          answer.set_revision(view.snapshot().revision());
          const std::string& map = view.snapshot().info().name;
          for (const EditResult& result : *results) *answer.add_results() = ToProto(result, map);
        });
  }

  grpc::ServerUnaryReactor* UndoEdits(grpc::CallbackServerContext*, const v1::UndoEditsRequest* request,
                                      v1::UndoEditsResponse* response) override {
    return RunEdit(
        context_, {.method = "EditService/UndoEdits", .request = request, .opens = request->map()}, response,
        [=, this] { return PlanUndo("UndoEdits", *request); }, kFillUndone);
  }

  grpc::ServerUnaryReactor* RedoEdits(grpc::CallbackServerContext*, const v1::RedoEditsRequest* request,
                                      v1::RedoEditsResponse* response) override {
    return RunEdit(
        context_, {.method = "EditService/RedoEdits", .request = request, .opens = request->map()}, response,
        [=, this] { return PlanUndo("RedoEdits", *request); }, kFillUndone);
  }

  grpc::ServerUnaryReactor* RestoreRevision(grpc::CallbackServerContext*, const v1::RestoreRevisionRequest* request,
                                            v1::RestoreRevisionResponse* response) override {
    return RunEdit(
        context_, {.method = "EditService/RestoreRevision", .request = request, .opens = request->map()}, response,
        [=, this] { return PlanRestore(*request); }, kFillUndone);
  }

  grpc::ServerUnaryReactor* ListEdits(grpc::CallbackServerContext*, const v1::ListEditsRequest* request,
                                      v1::ListEditsResponse* response) override {
    return Run(context_, {"EditService/ListEdits", request, response}, [=, this]() -> Status {
      DHPMAP_ASSIGN_OR_RETURN(const std::string map, ParseMapName(request->parent(), "parent"));
      DHPMAP_ASSIGN_OR_RETURN(const MapSummary summary, context_.registry.Get(map));
      const PageMark now{.history_id = summary.info.history_id, .revision = summary.info.revision};
      DHPMAP_ASSIGN_OR_RETURN(Pager pager, Pager::Begin(*request, now, *context_.registry.LostRevisionsOf(map)));
      DHPMAP_ASSIGN_OR_RETURN(const EditQuery query, EditQueryFromProto(*request, pager));
      DHPMAP_ASSIGN_OR_RETURN(const auto edits, context_.registry.ListEdits(map, query));
      for (const LoggedEdit& edit : edits) {
        v1::LoggedEdit proto = ToProto(edit, map);
        if (!pager.Takes(proto, std::to_string(edit.entry.revision))) break;
        *response->add_edits() = std::move(proto);
      }
      response->set_next_page_token(pager.NextToken());
      return Status::Ok();
    });
  }

  grpc::ServerUnaryReactor* ListKeptClear(grpc::CallbackServerContext*, const v1::ListKeptClearRequest* request,
                                          v1::ListKeptClearResponse* response) override {
    return Run(context_, {"EditService/ListKeptClear", request, response, request->parent()}, [=, this]() -> Status {
      DHPMAP_ASSIGN_OR_RETURN(const std::string map, ParseMapName(request->parent(), "parent"));
      DHPMAP_ASSIGN_OR_RETURN(const auto view, ViewFor(context_, map, *request));
      response->set_revision(view->snapshot().revision());
      for (const KeptClearRegion& region : view->snapshot().info().kept_clear.list()) {
        *response->add_regions() = ToProto(region);
      }
      return Status::Ok();
    });
  }

 private:
  Result<PlannedEdit> PlanList(const v1::ApplyEditsRequest& request, const std::shared_ptr<Results>& results) const {
    DHPMAP_ASSIGN_OR_RETURN(const std::string map, ParseMapName(request.map(), "map"));
    DHPMAP_ASSIGN_OR_RETURN(const auto view, context_.registry.ViewOf(map));
    DHPMAP_ASSIGN_OR_RETURN(EditList list, EditListFromProto(request, map, *view->snapshot().info().label_set));
    list.lost = *context_.registry.LostRevisionsOf(map);
    list.undelete = context_.registry.Undeletions();
    auto change = [results, list = std::make_shared<const EditList>(std::move(list))](Map& edited) -> Result<EditMade> {
      DHPMAP_ASSIGN_OR_RETURN(*results, dhpmap::ApplyEdits(*list, edited));
      return EditMade{
          .submap = SubmapId(), .summary = SummaryOfList(*list, *results), .cleared = ClearedBy(*list, *results)};
    };
    return PlanEdit("ApplyEdits", request, map, std::move(change));
  }

  template <typename Request>
  Result<PlannedEdit> PlanUndo(const char* method, const Request& request) const {
    DHPMAP_ASSIGN_OR_RETURN(const std::string map, ParseMapName(request.map(), "map"));
    DHPMAP_ASSIGN_OR_RETURN(UndoRequest undo, UndoFromProto(request, map));
    undo.conditions = ConditionsOf(request, request.etag(), *context_.registry.LostRevisionsOf(map));
    return PlanEdit(method, request, map, context_.registry.UndoOf(std::move(undo)));
  }

  Result<PlannedEdit> PlanRestore(const v1::RestoreRevisionRequest& request) const {
    DHPMAP_ASSIGN_OR_RETURN(const std::string map, ParseMapName(request.map(), "map"));
    DHPMAP_ASSIGN_OR_RETURN(RestoreRequest restore, RestoreFromProto(request, map));
    DHPMAP_ASSIGN_OR_RETURN(auto change, context_.registry.RestorationOf(map, std::move(restore)));
    return PlanEdit("RestoreRevision", request, map, std::move(change));
  }

  const ServiceContext& context_;
};

}  // namespace

std::unique_ptr<grpc::Service> MakeEditService(const ServiceContext& context) {
  return std::make_unique<EditService>(context);
}

}  // namespace dhpmap

// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "dhpmap/v1/edit_service.grpc.pb.h"
#include "proto/types/resource_names.h"
#include "server/app/edits/edit_list.h"
#include "server/grpc/counted_service.h"
#include "server/grpc/edit_call.h"
#include "server/grpc/read_view.h"
#include "server/grpc/services.h"
#include "server/wire/edit_conversion.h"
#include "server/wire/edit_log_conversion.h"
#include "server/wire/paging.h"

namespace dhpmap {
namespace {

/// Filled by the writer's thread, sent in the answer.
using Results = std::vector<EditResult>;

/// Fills the answer of an undo, a redo or a restoration.
constexpr auto kFillUndone = [](const MapView& view, const EditMade& made, auto& response) {
  const std::string& map = view.snapshot().info().name;
  response.set_revision(view.snapshot().revision());
  if constexpr (requires { response.add_edits(std::string()); }) {
    for (const std::int64_t edit : made.summary.targets) response.add_edits(EditResourceName(map, edit));
  }
  for (const SubmapId id : made.summary.changed) response.add_changed_submaps(SubmapResourceName(map, id));
  for (const SubmapId id : made.summary.created) response.add_created_submaps(SubmapResourceName(map, id));
  for (const SubmapId id : made.summary.removed) response.add_removed_submaps(SubmapResourceName(map, id));
};

bool Changes(const EditSummary& edit, SubmapId submap) {
  const auto has = [submap](const std::vector<SubmapId>& ids) {
    return std::find(ids.begin(), ids.end(), submap) != ids.end();
  };
  return has(edit.changed) || has(edit.created) || has(edit.removed);
}

Result<SubmapId> SubmapOfMap(const std::string& name, const std::string& map) {
  DHPMAP_ASSIGN_OR_RETURN(const SubmapName parsed, ParseSubmapName(name, "submap"));
  if (parsed.map == map) return parsed.submap;
  return InvalidArgument("the filter is not usable")
      .WithReason("BAD_FILTER")
      .WithViolation("submap", "is a submap of another map");
}

class EditService final : public CountedService<v1::EditService> {
 public:
  explicit EditService(const ServiceContext& context) : CountedService(context), context_(context) {
    Take(&EditService::ApplyEdits, &EditService::UndoEdits, &EditService::RedoEdits, &EditService::RestoreRevision,
         &EditService::ListEdits, &EditService::ListIgnoredRegions);
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

  grpc::ServerUnaryReactor* UndoEdits(grpc::CallbackServerContext* call, const v1::UndoEditsRequest* request,
                                      v1::UndoEditsResponse* response) override {
    return RunEdit(
        context_, {.method = "EditService/UndoEdits", .request = request, .opens = request->map()}, response,
        [=, this, caller = CallerOf(*call)] { return PlanUndo("UndoEdits", *request, caller); }, kFillUndone);
  }

  grpc::ServerUnaryReactor* RedoEdits(grpc::CallbackServerContext* call, const v1::RedoEditsRequest* request,
                                      v1::RedoEditsResponse* response) override {
    return RunEdit(
        context_, {.method = "EditService/RedoEdits", .request = request, .opens = request->map()}, response,
        [=, this, caller = CallerOf(*call)] { return PlanUndo("RedoEdits", *request, caller); }, kFillUndone);
  }

  grpc::ServerUnaryReactor* RestoreRevision(grpc::CallbackServerContext* call,
                                            const v1::RestoreRevisionRequest* request,
                                            v1::RestoreRevisionResponse* response) override {
    return RunEdit(
        context_, {.method = "EditService/RestoreRevision", .request = request, .opens = request->map()}, response,
        [=, this, caller = CallerOf(*call)] { return PlanRestore(*request, caller); }, kFillUndone);
  }

  grpc::ServerUnaryReactor* ListEdits(grpc::CallbackServerContext*, const v1::ListEditsRequest* request,
                                      v1::ListEditsResponse* response) override {
    return Run(context_, {"EditService/ListEdits", request, response}, [=, this]() -> Status {
      DHPMAP_ASSIGN_OR_RETURN(const std::string map, ParseMapName(request->parent(), "parent"));
      DHPMAP_ASSIGN_OR_RETURN(const MapSummary summary, context_.registry.Get(map));
      const PageMark now{.history_id = summary.info.history_id, .revision = summary.info.revision};
      DHPMAP_ASSIGN_OR_RETURN(Pager pager, Pager::Begin(*request, now, *context_.registry.LostRevisionsOf(map)));
      DHPMAP_ASSIGN_OR_RETURN(EditQuery query, EditQueryFromProto(*request, pager));
      std::optional<SubmapId> submap;
      if (!request->submap().empty()) {
        DHPMAP_ASSIGN_OR_RETURN(submap, SubmapOfMap(request->submap(), map));
      }
      DHPMAP_RETURN_IF_ERROR(AddEdits(map, submap, query, pager, *response));
      response->set_next_page_token(pager.NextToken());
      return Status::Ok();
    });
  }

  grpc::ServerUnaryReactor* ListIgnoredRegions(grpc::CallbackServerContext*,
                                               const v1::ListIgnoredRegionsRequest* request,
                                               v1::ListIgnoredRegionsResponse* response) override {
    const CallMessages call{"EditService/ListIgnoredRegions", request, response, request->parent()};
    return Run(context_, call, [=, this]() -> Status {
      DHPMAP_ASSIGN_OR_RETURN(const std::string map, ParseMapName(request->parent(), "parent"));
      DHPMAP_ASSIGN_OR_RETURN(const auto view, ViewFor(context_, map, *request));
      const MapInfo& info = view->snapshot().info();
      const PageMark now{.history_id = info.history_id, .revision = view->snapshot().revision()};
      DHPMAP_ASSIGN_OR_RETURN(Pager pager, Pager::Begin(*request, now, *context_.registry.LostRevisionsOf(map)));
      response->set_revision(view->snapshot().revision());
      for (const KeptClearRegion& region : info.kept_clear.list()) {
        if (region.name <= pager.after()) continue;
        v1::IgnoredRegion proto = ToProto(region);
        if (!pager.Takes(proto, region.name)) break;
        *response->add_ignored_regions() = std::move(proto);
      }
      response->set_next_page_token(pager.NextToken());
      return Status::Ok();
    });
  }

 private:
  /// A page of the log, or of its edits of one object. To find those, it reads a limited number of edits.
  Status AddEdits(const std::string& map, const std::optional<SubmapId>& submap, EditQuery query, Pager& pager,
                  v1::ListEditsResponse& response) const {
    constexpr std::size_t kMostLookedThrough = 10'000, kLeastAtOnce = 1'000;
    if (submap) query.max_edits = std::max(query.max_edits, kLeastAtOnce);
    for (std::size_t num_seen = 0; num_seen < kMostLookedThrough;) {
      DHPMAP_ASSIGN_OR_RETURN(const auto edits, context_.registry.ListEdits(map, query));
      for (const LoggedEdit& edit : edits) {
        if (submap && !Changes(edit.entry.summary, *submap)) continue;
        v1::LoggedEdit proto = ToProto(edit, map);
        if (!pager.Takes(proto, std::to_string(edit.entry.revision))) return Status::Ok();
        *response.add_edits() = std::move(proto);
      }
      if (edits.size() < query.max_edits) return Status::Ok();
      num_seen += edits.size();
      query.before_revision = edits.back().entry.revision;
    }
    pager.EndBehind(std::to_string(*query.before_revision));
    return Status::Ok();
  }

  Result<PlannedEdit> PlanList(const v1::ApplyEditsRequest& request, const std::shared_ptr<Results>& results) const {
    DHPMAP_ASSIGN_OR_RETURN(const std::string map, ParseMapName(request.map(), "map"));
    DHPMAP_ASSIGN_OR_RETURN(const auto view, context_.registry.ViewOf(map));
    DHPMAP_ASSIGN_OR_RETURN(EditList list, EditListFromProto(request, map, *view->snapshot().info().label_set));
    list.lost = *context_.registry.LostRevisionsOf(map);
    return PlanEdit("ApplyEdits", request, map, context_.registry.EditsOf(std::move(list), results));
  }

  template <typename Request>
  Result<PlannedEdit> PlanUndo(const char* method, const Request& request, const Caller& caller) const {
    DHPMAP_ASSIGN_OR_RETURN(const std::string map, ParseMapName(request.map(), "map"));
    DHPMAP_ASSIGN_OR_RETURN(UndoRequest undo, UndoFromProto(request, map));
    undo.conditions = ConditionsOf(request, request.etag(), *context_.registry.LostRevisionsOf(map));
    undo.is_own = [caller](const std::string& author) { return caller.Owns(author); };
    return PlanEdit(method, request, map, context_.registry.UndoOf(std::move(undo)));
  }

  /// A caller who may not undo others' edits may not undo them by restoring an older state either.
  Status CheckOwnsEditsAfter(std::int64_t revision, const std::string& map, const std::optional<SubmapId>& submap,
                             const Caller& caller) const {
    if (caller.OwnsAll()) return Status::Ok();
    EditQuery query{.max_edits = 1000};
    for (;;) {
      DHPMAP_ASSIGN_OR_RETURN(const std::vector<LoggedEdit> edits, context_.registry.ListEdits(map, query));
      for (const LoggedEdit& edit : edits) {
        if (edit.entry.revision <= revision) return Status::Ok();
        if (caller.Owns(edit.entry.source.author) || (submap && !Changes(edit.entry.summary, *submap))) continue;
        return Status(StatusCode::kPermissionDenied,
                      "since then there are edits of others, which only they and admins may undo")
            .WithReason("NOT_YOUR_NAME");
      }
      if (edits.size() < query.max_edits) return Status::Ok();
      query.before_revision = edits.back().entry.revision;
    }
  }

  Result<PlannedEdit> PlanRestore(const v1::RestoreRevisionRequest& request, const Caller& caller) const {
    DHPMAP_ASSIGN_OR_RETURN(const std::string map, ParseMapName(request.map(), "map"));
    DHPMAP_ASSIGN_OR_RETURN(RestoreRequest restore, RestoreFromProto(request, map));
    const std::int64_t revision = restore.revision;
    const std::optional<SubmapId> submap = restore.submap;
    DHPMAP_ASSIGN_OR_RETURN(auto restoration, context_.registry.RestorationOf(map, std::move(restore)));
    const auto change = [=, this, restoration = std::move(restoration)](Map& state) -> Result<EditMade> {
      DHPMAP_RETURN_IF_ERROR(
          CheckOwnsEditsAfter(revision, map, submap, caller));  // runs on the writer, so no other edit can come between
      return restoration(state);
    };
    return PlanEdit("RestoreRevision", request, map, change);
  }

  const ServiceContext& context_;
};

}  // namespace

std::unique_ptr<grpc::Service> MakeEditService(const ServiceContext& context) {
  return std::make_unique<EditService>(context);
}

}  // namespace dhpmap

// SPDX-License-Identifier: BSD-3-Clause
// Edits as jobs for the writer of a map.
#include <utility>

#include "server/app/edits/edit_summary.h"
#include "server/app/maps/map_registry.h"

namespace dhpmap {

std::function<Result<EditMade>(Map&)> MapRegistry::UndoOf(UndoRequest request) {
  return [this, request = std::move(request)](Map& map) -> Result<EditMade> {
    DHPMAP_ASSIGN_OR_RETURN(EditSummary summary, UndoEdits(request, store_, map));
    return EditMade{.submap = SubmapId(), .summary = std::move(summary)};
  };
}

std::function<Result<EditMade>(Map&)> MapRegistry::UndeletionOf(SubmapId id, EditConditions conditions) {
  return [this, id, conditions = std::move(conditions)](Map& map) -> Result<EditMade> {
    DHPMAP_ASSIGN_OR_RETURN(EditSummary summary, UndeleteSubmap(id, store_, map, conditions));
    return EditMade{.submap = id, .summary = std::move(summary)};
  };
}

std::function<Result<EditMade>(Map&)> MapRegistry::EditsOf(EditList list,
                                                           std::shared_ptr<std::vector<EditResult>> results) {
  return [this, list = std::make_shared<const EditList>(std::move(list)),
          results = std::move(results)](Map& map) -> Result<EditMade> {
    DHPMAP_ASSIGN_OR_RETURN(*results, ApplyEdits(*list, map, &store_));
    return EditMade{
        .submap = SubmapId(), .summary = SummaryOfList(*list, *results), .cleared = ClearedBy(*list, *results)};
  };
}

std::function<Result<EditMade>(Map&)> MapRegistry::PatchOf(MapPatch patch, EditConditions conditions) {
  return [this, patch = std::move(patch), conditions = std::move(conditions)](Map& map) -> Result<EditMade> {
    DHPMAP_RETURN_IF_ERROR(CheckExpectedRevision(conditions, map.info()));
    DHPMAP_RETURN_IF_ERROR(CheckMapNotEditedSince(conditions.expected_revision, store_, map.info().name));
    DHPMAP_RETURN_IF_ERROR(PatchMap(map, conditions.etag, patch));
    return EditMade{.submap = kUnknownSubmap, .summary = {.steps = {{EditAction::kRenameMap, kUnknownSubmap}}}};
  };
}

/// The past state is looked up on the writer's thread, so a repeated request is answered even if the state is no longer
/// kept.
Result<std::function<Result<EditMade>(Map&)>> MapRegistry::RestorationOf(const std::string& name,
                                                                         RestoreRequest request) {
  DHPMAP_ASSIGN_OR_RETURN(const auto open_map, GetOpen(name));
  request.lost = *LostRevisionsOf(name);
  return std::function([this, kept = open_map->history(), request = std::move(request)](Map& map) -> Result<EditMade> {
    DHPMAP_ASSIGN_OR_RETURN(EditSummary summary, RestoreRevision(request, *kept, store_, map));
    return EditMade{.submap = request.submap.value_or(kUnknownSubmap), .summary = std::move(summary)};
  });
}

}  // namespace dhpmap

// SPDX-License-Identifier: BSD-3-Clause
#include "server/app/edits/map_edits.h"

#include <algorithm>
#include <map>

#include "server/app/states/etag.h"

namespace dhpmap {
namespace {

bool RenamesMap(const EditSummary& summary) {
  return std::any_of(summary.steps.begin(), summary.steps.end(), [](const EditStep& step) {
    const bool is_whole_map_restored = step.action == EditAction::kRestore && step.submap == kUnknownSubmap;
    return step.action == EditAction::kRenameMap || is_whole_map_restored;  // which may restore an older name
  });
}

}  // namespace

Status CheckMapNotEditedSince(std::int64_t revision, MapStore& store, const std::string& map) {
  if (revision <= 0) return Status::Ok();
  const auto edited_in = [&](std::int64_t edit) { return CheckNotEditedSince(revision, edit, "map '" + map + "'"); };
  std::map<std::int64_t, std::int64_t> older;  // edits up to the revision, with their last undo or redo
  EditQuery query{.max_edits = 200};
  for (bool goes_on = true; goes_on;) {
    DHPMAP_ASSIGN_OR_RETURN(const auto edits, store.ListEdits(map, query));
    goes_on = edits.size() == query.max_edits;
    if (goes_on) query.before_revision = edits.back().entry.revision;
    for (const LoggedEdit& edit : edits) {
      if (edit.entry.revision <= revision) {
        goes_on = false;
        break;
      }
      if (RenamesMap(edit.entry.summary)) return edited_in(edit.entry.revision);
      for (const std::int64_t target : edit.entry.summary.targets) {
        if (target <= revision) older.try_emplace(target, edit.entry.revision);
      }
    }
  }
  for (const auto& [target, by] : older) {
    DHPMAP_ASSIGN_OR_RETURN(const auto found, store.ListEdits(map, {.before_revision = target + 1, .max_edits = 1}));
    const bool is_it = !found.empty() && found.front().entry.revision == target;
    if (is_it && RenamesMap(found.front().entry.summary)) return edited_in(by);
  }
  return Status::Ok();
}

Status PatchMap(Map& map, const std::string& etag, const MapPatch& patch) {
  DHPMAP_RETURN_IF_ERROR(CheckEtag(etag, EtagOf(map.info()), "map '" + map.info().name + "'"));
  if (!patch.display_name || *patch.display_name == map.info().display_name) return Status::Ok();
  if (patch.display_name->size() > kMaxDisplayNameBytes) {
    Status bad = InvalidArgument("the map cannot be changed like this").WithReason("BAD_EDIT");
    bad.AddViolation("display_name", "is longer than " + std::to_string(kMaxDisplayNameBytes) + " bytes");
    return bad;
  }
  map.mutable_info().display_name = *patch.display_name;
  return Status::Ok();
}

}  // namespace dhpmap

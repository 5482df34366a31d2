// SPDX-License-Identifier: BSD-3-Clause
#include "server/app/edits/edit_summary.h"

#include <set>

namespace dhpmap {
namespace {

void AddSteps(SubmapId id, const SubmapPatch& patch, std::vector<EditStep>& steps) {
  if (patch.T_map_submap || patch.pose_change) steps.push_back({EditAction::kMove, id});
  if (patch.class_id) steps.push_back({EditAction::kRelabel, id});
  if (patch.display_name) steps.push_back({EditAction::kRename, id});
  if (patch.is_locked) steps.push_back({*patch.is_locked ? EditAction::kLock : EditAction::kUnlock, id});
}

struct StepsOf {
  SubmapId id;
  std::vector<EditStep>& steps;
  void operator()(const PatchEdit& edit) const { AddSteps(id, edit.patch, steps); }
  void operator()(const CloneEdit&) const { steps.push_back({EditAction::kClone, id}); }
  void operator()(const DeleteEdit&) const { steps.push_back({EditAction::kDelete, id}); }
  void operator()(const MergeEdit&) const { steps.push_back({EditAction::kMerge, id}); }
  void operator()(const SplitEdit&) const { steps.push_back({EditAction::kSplit, id}); }
  void operator()(const ClearEdit& edit) const {
    steps.push_back({EditAction::kClear, id});
    if (!edit.keep_clear.empty()) steps.push_back({EditAction::kKeepClear, kUnknownSubmap});
  }
  void operator()(const PresenceEdit&) const { steps.push_back({EditAction::kSetPresence, id}); }
  void operator()(const KeepClearEdit&) const { steps.push_back({EditAction::kKeepClear, kUnknownSubmap}); }
  void operator()(const UndeleteEdit&) const { steps.push_back({EditAction::kUndelete, id}); }
  void operator()(const TurnEdit&) const { steps.push_back({EditAction::kMove, id}); }
  void operator()(const TranslateEdit&) const { steps.push_back({EditAction::kMove, id}); }
  void operator()(const PlaceEdit&) const { steps.push_back({EditAction::kMove, id}); }
  void operator()(const LiftEdit&) const { steps.push_back({EditAction::kLift, kUnknownSubmap}); }
};

SubmapId IdOf(const std::optional<EditTarget>& target, const std::vector<EditResult>& results) {
  if (!target) return kUnknownSubmap;
  if (const auto* id = std::get_if<SubmapId>(&*target)) return *id;
  return results[std::get<EarlierResult>(*target).edit].created.front();
}

}  // namespace

EditSummary SummaryOfList(const EditList& list, const std::vector<EditResult>& results) {
  EditSummary summary;
  std::set<SubmapId> changed, created, removed;
  for (std::size_t i = 0; i < results.size(); ++i) {
    const Edit& edit = list.edits[i];
    const StepsOf steps_of{IdOf(edit.target, results), summary.steps};
    std::visit([&](const auto& kind) { std::visit(steps_of, kind); }, edit.action);
    summary.num_voxels += results[i].num_voxels;
    for (const SubmapId id : results[i].changed) {
      if (!created.contains(id)) changed.insert(id);
    }
    created.insert(results[i].created.begin(), results[i].created.end());
    for (const SubmapId id : results[i].removed) {
      changed.erase(id);
      if (created.erase(id) == 0) removed.insert(id);
    }
  }
  summary.changed.assign(changed.begin(), changed.end());
  summary.created.assign(created.begin(), created.end());
  summary.removed.assign(removed.begin(), removed.end());
  return summary;
}

std::vector<RegionEvent> ClearedBy(const EditList& list, const std::vector<EditResult>& results) {
  std::vector<RegionEvent> cleared;
  for (std::size_t i = 0; i < results.size(); ++i) {
    const Edit& edit = list.edits[i];
    const auto* clear = ActionIf<ClearEdit>(edit);
    if (clear == nullptr) continue;
    RegionEvent& event = cleared.emplace_back(RegionEvent{.kind = RegionEventKind::kCleared,
                                                          .region = clear->region,
                                                          .submap = IdOf(edit.target, results),
                                                          .num_voxels = results[i].num_voxels});
    if (edit.target) continue;
    const std::set<ClassId> classes(clear->classes.begin(), clear->classes.end());
    event.classes.assign(classes.begin(), classes.end());
  }
  return cleared;
}

}  // namespace dhpmap

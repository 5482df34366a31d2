// SPDX-License-Identifier: BSD-3-Clause
#include "server/app/edits/edit_list.h"

#include <algorithm>
#include <set>
#include <utility>

#include "mapping/objects/merge_submaps.h"
#include "mapping/objects/split_submap.h"
#include "server/app/edits/edit_undo.h"
#include "server/app/edits/object_motion.h"
#include "server/app/states/etag.h"

namespace dhpmap {
namespace {

std::string Named(SubmapId id) { return "submap " + std::to_string(id.value); }

class Application {
 public:
  Application(const EditList& list, Map& map, MapStore* store) : list_(list), map_(map), store_(store) {
    edited_before_.reserve(map.submaps().size());
    for (const auto& submap : map.submaps()) edited_before_.emplace_back(submap->id(), submap->info().edited_revision);
  }

  Result<std::vector<EditResult>> Run() {
    for (std::size_t i = 0; i < list_.edits.size(); ++i) {
      Result<EditResult> result = RunOne(list_.edits[i]);
      if (!result.ok()) return WithPlace(result.status(), i);
      results_.push_back(std::move(result).value());
      // Only a single edit may leave vacated space for the next commit. In a list the next edit may depend on it, and
      // undo of the list would record a tile twice.
      if (list_.edits.size() > 1) map_.SettleVacated();
    }
    return std::move(results_);
  }

  Result<EditResult> RunOne(const Edit& edit) {
    DHPMAP_ASSIGN_OR_RETURN(EditResult result, Apply(edit));
    for (auto* ids : {&result.changed, &result.created, &result.removed}) {
      std::sort(ids->begin(), ids->end());
      ids->erase(std::unique(ids->begin(), ids->end()), ids->end());
    }
    for (const auto* ids : {&result.changed, &result.created}) NoteEdited(*ids);
    removed_.insert(result.removed.begin(), result.removed.end());
    return result;
  }

 private:
  /// Adds the position of the edit in the list to its error.
  static Status WithPlace(const Status& error, std::size_t i) {
    const std::string place = std::string("edits[").append(std::to_string(i)).append("]");
    Status placed(error.code(), place + ": " + error.message());
    placed.WithReason(error.reason());
    for (const auto& [field, description] : error.violations()) {
      placed.AddViolation(std::string(place).append(".").append(field), description);
    }
    for (const auto& [key, value] : error.metadata()) {
      Status with = std::move(placed).WithMetadata(key, value);
      placed = std::move(with);
    }
    return placed;
  }

  void NoteEdited(const std::vector<SubmapId>& ids) {
    for (const SubmapId id : ids) {
      if (Submap* submap = map_.FindMutable(id)) submap->mutable_info().edited_revision = map_.info().revision + 1;
    }
  }

  Result<SubmapId> Resolve(const EditTarget& target) const {
    if (const auto* id = std::get_if<SubmapId>(&target)) return *id;
    const std::size_t edit = std::get<EarlierResult>(target).edit;
    const std::string name = std::string("#").append(std::to_string(edit));
    if (edit >= results_.size()) {
      return InvalidArgument(name + " is no edit before this one").WithReason("BAD_EDIT");
    }
    if (results_[edit].created.empty()) {
      return InvalidArgument("edit " + name + " made no object").WithReason("BAD_EDIT");
    }
    return results_[edit].created.front();
  }

  /// The revision of an object's last edit before the list; nothing for objects that the list creates.
  [[nodiscard]] std::optional<std::int64_t> EditedBefore(SubmapId id) const {
    const auto found = std::lower_bound(edited_before_.begin(), edited_before_.end(), id,
                                        [](const auto& entry, SubmapId wanted) { return entry.first < wanted; });
    if (found == edited_before_.end() || found->first != id) return std::nullopt;
    return found->second;
  }

  /// The object of an edit, if it may be edited.
  Result<SubmapId> Editable(const EditTarget& target, const std::string& etag) const {
    DHPMAP_ASSIGN_OR_RETURN(const SubmapId id, Resolve(target));
    DHPMAP_ASSIGN_OR_RETURN(const Submap* submap, FindEditable(map_, id, {}));
    const std::optional<std::int64_t> edited = EditedBefore(id);
    if (!etag.empty()) {
      SubmapInfo before = submap->info();  // as etags refer to it: without earlier edits of the list
      before.edited_revision = edited.value_or(before.edited_revision);
      DHPMAP_RETURN_IF_ERROR(CheckEtag(etag, before, map_.info(), list_.lost));
    }
    DHPMAP_RETURN_IF_ERROR(CheckNotEditedSince(list_.expected_revision, edited.value_or(0), Named(id)));
    return id;
  }

  Result<EditResult> Apply(const Edit& edit) {
    if (const auto* of_map = std::get_if<MapAction>(&edit.action)) {
      return std::visit([&](const auto& action) { return Do(edit, action); }, *of_map);
    }
    if (!edit.target) return NamesNoObject();
    DHPMAP_ASSIGN_OR_RETURN(const SubmapId id, Editable(*edit.target, edit.etag));
    return std::visit([&](const auto& action) { return Do(id, action); }, std::get<ObjectAction>(edit.action));
  }

  static Status NamesNoObject() { return InvalidArgument("it names no object").WithReason("BAD_EDIT"); }

  Result<EditResult> Do(SubmapId id, const PatchEdit& edit) {
    const Transform T_map_before = map_.Find(id)->info().T_map_submap;
    const auto supported = edit.include_supported ? SupportedBy(id, map_) : std::vector<SubmapId>();
    DHPMAP_ASSIGN_OR_RETURN(const bool is_changed, PatchSubmap(map_, id, edit.patch));
    EditResult result;
    if (!is_changed) return result;
    result.changed.push_back(id);
    const Transform& T_map_now = map_.Find(id)->info().T_map_submap;
    if (T_map_now.matrix() == T_map_before.matrix()) return result;  // it is there already
    const Transform motion = T_map_now * T_map_before.inverse();
    DHPMAP_RETURN_IF_ERROR(Carry(supported, motion, result));
    return result;
  }

  Result<EditResult> Do(SubmapId id, const TurnEdit& edit) {
    DHPMAP_ASSIGN_OR_RETURN(const Transform motion, TurnOf(*map_.Find(id), edit.angle_rad));
    return MoveBy(id, motion, edit.include_supported ? SupportedBy(id, map_) : std::vector<SubmapId>());
  }

  Result<EditResult> Do(SubmapId id, const TranslateEdit& edit) {
    const Transform motion(Eigen::Translation3d(edit.offset_m));
    return MoveBy(id, motion, edit.include_supported ? SupportedBy(id, map_) : std::vector<SubmapId>());
  }

  Result<EditResult> Do(SubmapId id, const PlaceEdit& edit) {
    DHPMAP_ASSIGN_OR_RETURN(const SubmapId support, Editable(edit.support, {}));
    const auto supported = edit.include_supported ? SupportedBy(id, map_) : std::vector<SubmapId>();
    if (support == id || std::binary_search(supported.begin(), supported.end(), support)) {
      return FailedPrecondition(Named(id) + " cannot be placed on " + Named(support) +
                                (support == id ? ": it is itself" : ", which goes along"))
          .WithReason("SUPPORT_MOVES")
          .WithViolation("place.support", "moves, too");
    }
    DHPMAP_ASSIGN_OR_RETURN(const Transform motion, PlacingOf(*map_.Find(id), *map_.Find(support), edit.point_m));
    return MoveBy(id, motion, supported);
  }

  Result<EditResult> MoveBy(SubmapId id, const Transform& motion, const std::vector<SubmapId>& supported) {
    EditResult result;
    std::vector<SubmapId> all = supported;
    all.insert(all.begin(), id);
    DHPMAP_RETURN_IF_ERROR(Carry(all, motion, result));
    return result;
  }

  /// Moves all objects by the same motion.
  Status Carry(const std::vector<SubmapId>& ids, const Transform& motion, EditResult& result) {
    for (const SubmapId id : ids) {
      if (!result.changed.empty()) map_.SettleVacated();  // only one object may leave vacated space for later
      const SubmapPatch patch{.T_map_submap = motion * map_.Find(id)->info().T_map_submap};
      DHPMAP_ASSIGN_OR_RETURN(const bool is_changed, PatchSubmap(map_, id, patch));
      if (is_changed) result.changed.push_back(id);
    }
    return Status::Ok();
  }

  Result<EditResult> Do(SubmapId id, const CloneEdit& edit) {
    DHPMAP_ASSIGN_OR_RETURN(const SubmapId copy, CloneSubmap(map_, id, {}, edit.patch));
    return EditResult{.changed = {}, .created = {copy}, .removed = {}};
  }

  Result<EditResult> Do(SubmapId id, const DeleteEdit&) {
    DHPMAP_RETURN_IF_ERROR(DeleteSubmap(map_, id, {}));
    return EditResult{.changed = {}, .created = {}, .removed = {id}};
  }

  Result<EditResult> Do(const Edit& edit, const UndeleteEdit&) {
    if (!edit.target) return NamesNoObject();
    if (store_ == nullptr) return InvalidArgument("nothing can be brought back here").WithReason("BAD_EDIT");
    DHPMAP_ASSIGN_OR_RETURN(const SubmapId id, Resolve(*edit.target));
    if (removed_.contains(id)) {  // the log does not know it yet, but may know an earlier removal
      return NotFound(Named(id) + " was removed by an edit of the same list").WithReason("SUBMAP_NOT_FOUND");
    }
    const EditConditions conditions{
        .etag = edit.etag, .expected_revision = list_.expected_revision, .lost = list_.lost};
    DHPMAP_RETURN_IF_ERROR(UndeleteSubmap(id, *store_, map_, conditions).status());
    return EditResult{.changed = {}, .created = {id}, .removed = {}};
  }

  Result<EditResult> Do(SubmapId into, const MergeEdit& edit) {
    if (edit.others.empty()) return InvalidArgument("it names nothing to merge").WithReason("BAD_EDIT");
    EditResult result{.changed = {into}, .created = {}, .removed = {}};
    for (const EditTarget& other : edit.others) {
      DHPMAP_ASSIGN_OR_RETURN(const SubmapId from, Editable(other, {}));
      if (!CanMerge(map_, from, into)) {
        return FailedPrecondition(Named(from) + " cannot become a part of " + Named(into) +
                                  ": both must be things, and neither moved against the other")
            .WithReason("NOT_MERGEABLE");
      }
      MergeForGood(from, into, map_);
      result.removed.push_back(from);
    }
    return result;
  }

  Result<EditResult> Do(SubmapId id, const SplitEdit& edit) {
    const Submap& submap = *map_.Find(id);
    DHPMAP_RETURN_IF_ERROR(CheckClassOfParts(submap, edit.class_id));
    EditResult result{.changed = {id}, .created = {}, .removed = {}};
    const Transform T_map_submap = submap.info().T_map_submap;
    if (const auto* parts = std::get_if<SplitByParts>(&edit.by)) {
      result.created = SplitIntoConnectedParts(id, parts->least_voxels, parts->most_parts, map_);
    } else if (const auto* by_box = std::get_if<SplitByBox>(&edit.by)) {
      const auto in_box = [&](const Eigen::Vector3d& p_m) { return by_box->box_m.contains(T_map_submap * p_m); };
      if (const auto part = SplitSubmap(id, in_box, map_)) result.created.push_back(*part);
    } else {
      const auto& plane = std::get<SplitByPlane>(edit.by);
      const auto is_before = [&](const Eigen::Vector3d& p_m) {
        return plane.normal.dot(T_map_submap * p_m - plane.point_m) > 0;
      };
      if (const auto part = SplitSubmap(id, is_before, map_)) result.created.push_back(*part);
    }
    if (result.created.empty()) {
      return FailedPrecondition(Named(id) + " would stay as it is: there are no two parts of it")
          .WithReason("NOTHING_TO_SPLIT");
    }
    for (const SubmapId part : result.created) {
      if (edit.class_id) MakeThingOfClass(*edit.class_id, *map_.FindMutable(part));
      result.num_voxels += NumObserved(*map_.Find(part));
    }
    return result;
  }

  [[nodiscard]] Status CheckClassOfParts(const Submap& submap, const std::optional<ClassId>& class_id) const {
    if (!class_id) {
      if (submap.info().panoptic == Panoptic::kThing) return Status::Ok();
      return FailedPrecondition(Named(submap.id()) +
                                " is a background, of which there is one of each class: say which class of things its "
                                "parts become (class_name)")
          .WithReason("NOT_A_THING");
    }
    const LabelClass* wanted = map_.info().label_set->Find(*class_id);
    if (wanted != nullptr && wanted->panoptic == Panoptic::kThing) return Status::Ok();
    Status bad = InvalidArgument("parts cannot be of this class").WithReason("BAD_EDIT");
    const std::string name = wanted != nullptr ? "'" + wanted->name + "'" : std::to_string(class_id->value);
    bad.AddViolation("split.class_name", name + " is no class of things");
    return bad;
  }

  static std::int64_t NumObserved(const Submap& submap) {
    std::int64_t num_voxels = 0;
    for (const BlockEntry& entry : submap.blocks().entries()) {
      if (entry.tsdf != nullptr) num_voxels += entry.tsdf->NumObservedVoxels();
    }
    return num_voxels;
  }

  Result<EditResult> Do(const Edit& edit, const ClearEdit& clear) {
    std::optional<SubmapId> only;
    if (edit.target) {
      DHPMAP_ASSIGN_OR_RETURN(only, Editable(*edit.target, edit.etag));
    }
    const auto is_meant = [&](const SubmapInfo& info) {
      if (only) return info.id == *only;
      if (clear.classes.empty()) return true;
      return info.panoptic != Panoptic::kUnknown &&
             std::find(clear.classes.begin(), clear.classes.end(), info.class_id) != clear.classes.end();
    };
    if (!clear.keep_clear.empty())
      DHPMAP_RETURN_IF_ERROR(map_.mutable_info().kept_clear.Add({clear.keep_clear, clear.region}));
    ClearedRegion cleared = ClearRegion(clear.region, is_meant, map_);
    std::erase_if(cleared.changed, [&](SubmapId id) { return map_.Find(id) == nullptr; });
    return EditResult{.changed = std::move(cleared.changed),
                      .created = {},
                      .removed = std::move(cleared.removed),
                      .num_voxels = cleared.num_voxels};
  }

  Result<EditResult> Do(const Edit&, const KeepClearEdit& keep) {
    DHPMAP_RETURN_IF_ERROR(map_.mutable_info().kept_clear.Add(keep.region));
    return EditResult();
  }

  Result<EditResult> Do(const Edit&, const LiftEdit& lift) {
    if (!map_.mutable_info().kept_clear.Lift(lift.name)) {
      return NotFound("no region '" + lift.name + "' is kept clear").WithReason("IGNORED_REGION_NOT_FOUND");
    }
    return EditResult();
  }

  Result<EditResult> Do(SubmapId id, const PresenceEdit& edit) {
    if (map_.Find(id)->info().panoptic != Panoptic::kThing) {
      return FailedPrecondition(Named(id) + " is a background, which is never absent").WithReason("NOT_A_THING");
    }
    const Submap& now = *map_.Find(id);
    const bool is_so = now.info().presence == edit.presence && (now.IsAbsent() || !HasGone(now));
    if (is_so) return EditResult();
    Submap& submap = *map_.FindMutable(id);
    submap.mutable_info().presence = edit.presence;
    if (edit.presence == Presence::kPresent) submap.DropGone();
    return EditResult{.changed = {id}, .created = {}, .removed = {}};
  }

  const EditList& list_;
  Map& map_;
  MapStore* const store_;
  std::vector<std::pair<SubmapId, std::int64_t>> edited_before_;  // sorted by id
  std::vector<EditResult> results_;
  std::set<SubmapId> removed_;  ///< by edits of the list
};

Status CheckConditions(const EditList& list, const MapInfo& map) {
  if (list.edits.empty()) return InvalidArgument("there is no edit").WithReason("BAD_EDIT");
  if (list.edits.size() > kMaxEdits) {
    return InvalidArgument("there are more than " + std::to_string(kMaxEdits) + " edits").WithReason("BAD_EDIT");
  }
  DHPMAP_RETURN_IF_ERROR(CheckEtag(list.map_etag, EtagOf(map), "map '" + map.name + "'"));
  return CheckExpectedRevision({.expected_revision = list.expected_revision, .lost = list.lost}, map);
}

}  // namespace

Result<std::vector<EditResult>> ApplyEdits(const EditList& list, Map& map, MapStore* store) {
  DHPMAP_RETURN_IF_ERROR(CheckConditions(list, map.info()));
  return Application(list, map, store).Run();
}

Result<EditResult> ApplyOneEdit(const EditList& list_of_one, Map& map) {
  DHPMAP_RETURN_IF_ERROR(CheckConditions(list_of_one, map.info()));
  return Application(list_of_one, map, nullptr).RunOne(list_of_one.edits.front());
}

}  // namespace dhpmap

// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/objects/merge_submaps.h"

#include <algorithm>
#include <memory>
#include <utility>
#include <vector>

#include "mapping/evidence/submap_labels.h"
#include "mapping/voxels/voxel_average.h"

namespace dhpmap {
namespace {

/// Merges the geometry of one voxel and its look-through count.
void MergeGeometry(const BlockEntry& from, int linear, float max_weight, TsdfBlock& into, GoneBlock& gone) {
  if (from.tsdf == nullptr || !from.tsdf->IsObserved(linear)) return;
  const auto i = static_cast<std::size_t>(linear);
  const int from_count = from.gone != nullptr ? from.gone->Count(linear) : 0;
  const bool was_observed = into.IsObserved(linear);
  if (was_observed && from.IsContradicted(linear) && !gone.IsContradicted(linear)) return;
  if (was_observed && gone.IsContradicted(linear) && !from.IsContradicted(linear)) into.weight[i] = 0;
  const bool replaces = into.weight[i] == 0;
  MergedAverage<double> merged;
  merged.Add(into, i);
  merged.Add(*from.tsdf, i);
  merged.Store(into, i);
  into.weight[i] = std::min(into.weight[i], max_weight);
  gone.Set(linear, replaces ? from_count : std::min(from_count, gone.Count(linear)));
}

/// Whether the part's labels mean the same in the whole, if that has no block there.
bool AreTheSameOf(SubmapId into, const LabelBlock& labels) {
  if (labels.HasSeenInstance(into)) return false;  // that instance would become their own
  if (HasNone(labels.concluded())) return true;
  for (int linear = 0; linear < kBlockVoxels; ++linear) {
    if (!labels.IsConcluded(linear)) continue;
    if (labels.IsEmpty(linear) || labels.BestInstance(linear).id.IsOwn()) return false;
  }
  return true;
}

void MergeLabels(const LabelBlock& from, SubmapId into_id, LabelBlock& into) {
  LabelBlock renamed = from;
  if (renamed.HasSeenInstance(into_id)) renamed.RenameInstance(into_id, kOwnInstance);
  for (int linear = 0; linear < kBlockVoxels; ++linear) {
    if (renamed.IsEmpty(linear)) continue;
    const bool was_concluded = renamed.IsConcluded(linear) || into.IsConcluded(linear);
    into.Add(linear, renamed.Get(linear));
    into.SetConcluded(linear, was_concluded && !into.BestInstance(linear).id.IsOwn());
  }
}

/// Where the whole has no block, it shares that of the part.
void MergeOneBlock(const BlockEntry& from, float max_weight, Submap& into) {
  const BlockEntry* known = into.blocks().Find(from.index);
  if (known == nullptr) {
    const bool are_the_same = from.labels != nullptr && AreTheSameOf(into.id(), *from.labels);
    into.PutBlock(from.index, from.tsdf, are_the_same ? from.labels : nullptr);
    if (from.gone != nullptr) into.PutGone(from.index, from.gone);
    if (are_the_same) return;
  } else {
    const std::shared_ptr<const GoneBlock> before = known->gone;
    GoneBlock gone = before != nullptr ? *before : GoneBlock();
    if (before == nullptr && from.gone != nullptr) gone = GoneBlock({}, {}, from.gone->last());
    TsdfBlock& tsdf = into.MutableTsdf(from.index);
    for (int linear = 0; linear < kBlockVoxels; ++linear) MergeGeometry(from, linear, max_weight, tsdf, gone);
    const bool is_same = before != nullptr ? gone == *before : gone.empty();
    if (!is_same) into.PutGone(from.index, gone.empty() ? nullptr : std::make_shared<const GoneBlock>(gone));
  }
  if (from.labels != nullptr) MergeLabels(*from.labels, into.id(), into.MutableLabels(from.index));
}

void MergeRows(const SubmapInfo& from, SubmapInfo& into) {
  if (from.class_is_fixed && !into.class_is_fixed) {
    into.class_is_fixed = true;
    into.class_id = from.class_id;
  }
  if (into.display_name.empty()) into.display_name = from.display_name;
  if (from.activity == Activity::kActive) into.activity = Activity::kActive;
  if (from.presence == Presence::kPresent) into.presence = Presence::kPresent;
  into.is_confirmed = into.is_confirmed || from.is_confirmed;
  into.is_placed = into.is_placed || from.is_placed;
  into.is_locked = into.is_locked || from.is_locked;
  into.num_frames_observed += from.num_frames_observed;
  into.num_frames_missed = std::min(into.num_frames_missed, from.num_frames_missed);
  into.num_frames_overlooked = std::min(into.num_frames_overlooked, from.num_frames_overlooked);
  into.first_observed_ns = std::min(into.first_observed_ns, from.first_observed_ns);
  into.last_observed_ns = std::max(into.last_observed_ns, from.last_observed_ns);
  into.last_contradicted_ns = std::max(into.last_contradicted_ns, from.last_contradicted_ns);
  if (into.track_id == 0) into.track_id = from.track_id;
  into.sightings.Merge(from.sightings);
}

/// Renames `from` to `into` in all voxel labels.
void RenameEverywhere(SubmapId from, SubmapId into, Map& map) {
  std::vector<std::pair<SubmapId, BlockIndex>> found;
  for (const auto& submap : map.submaps()) {
    for (const BlockEntry& entry : submap->blocks().entries()) {
      const bool has_seen = entry.labels != nullptr && entry.labels->HasSeenInstance(from);
      if (has_seen) found.emplace_back(submap->id(), entry.index);
    }
  }
  for (const auto& [id, index] : found) {
    map.FindMutable(id)->MutableLabels(index).RenameInstance(from, SeenInstance::Of(into, id));
  }
}

}  // namespace

bool CanMerge(const Map& map, SubmapId from, SubmapId into) {
  const Submap* a = map.Find(from);
  const Submap* b = map.Find(into);
  if (a == nullptr || b == nullptr || a == b) return false;
  const SubmapInfo &x = a->info(), &y = b->info();
  return x.panoptic == Panoptic::kThing && y.panoptic == Panoptic::kThing && x.voxel_size_m == y.voxel_size_m &&
         x.T_map_submap.isApprox(y.T_map_submap, 0);
}

void MergeSubmaps(SubmapId from, SubmapId into, Map& map) {
  const Submap part = *map.Find(from);  // shares the blocks
  map.mutable_info().merged.Add(from, into);
  map.mutable_info().pairs.Merge(from, into);
  map.Remove(from);
  Submap& whole = *map.FindMutable(into);
  const auto max_weight = static_cast<float>(map.info().config.integration.max_weight);
  for (const BlockEntry& entry : part.blocks().entries()) {
    if (entry.tsdf != nullptr || entry.labels != nullptr) MergeOneBlock(entry, max_weight, whole);
  }
  MergeRows(part.info(), whole.mutable_info());
  whole.mutable_info().edited_revision = map.info().revision + 1;
  for (const ClassTotal& total : part.info().class_counts) whole.AddClassObservations(total.id, total.count);
  RenameEverywhere(from, into, map);
  RecomputeSubmapLabels(whole);
  whole.UpdateBoundingSphere();
}

void MergeForGood(SubmapId from, SubmapId into, Map& map) {
  MergeSubmaps(from, into, map);
  map.mutable_info().pairs.SetVerdict(from, into, PairVerdict::kMustBeOne);
  map.FindMutable(into)->mutable_info().is_confirmed = true;  // because a user requested it
}

}  // namespace dhpmap

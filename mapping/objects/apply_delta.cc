// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/objects/apply_delta.h"

#include <algorithm>
#include <map>
#include <string>
#include <utility>

namespace dhpmap {
namespace {

/// A value with two sides, seen in the direction in which it is applied.
template <typename T>
struct Way {
  const T& from;
  const T& to;
};
template <typename T>
Way<T> WayTo(DeltaSide to, const T& before, const T& after) {
  return to == DeltaSide::kBefore ? Way<T>{after, before} : Way<T>{before, after};
}

Status Conflict(SubmapId id, const std::string& field, const std::string& what) {
  return Aborted("submap " + std::to_string(id.value) + ": " + what)
      .WithReason("UNDO_CONFLICT")
      .WithMetadata("instance_id", std::to_string(id.value))
      .WithMetadata("field", field);
}

bool IsSame(const BoundingSphere& a, const BoundingSphere& b) {
  return a.center_m == b.center_m && a.radius_m == b.radius_m;
}

template <typename T>
void SetIfAsItWas(T& now, const T& from, const T& to) {
  if (now == from) now = to;
}

/// What edits set. Conflicts with later edits of the same.
Status SetEditedFields(const Way<SubmapInfo>& way, SubmapInfo& now) {
  const auto [from, to] = way;
  if (from.T_map_submap.matrix() != to.T_map_submap.matrix() || from.is_placed != to.is_placed) {
    if (now.T_map_submap.matrix() != from.T_map_submap.matrix()) {
      return Conflict(now.id, "pose", "it was moved since");
    }
    now.T_map_submap = to.T_map_submap;
    SetIfAsItWas(now.is_placed, from.is_placed, to.is_placed);
  }
  if (from.display_name != to.display_name) {
    if (now.display_name != from.display_name) return Conflict(now.id, "display_name", "it was renamed since");
    now.display_name = to.display_name;
  }
  if (from.class_id != to.class_id || from.class_is_fixed != to.class_is_fixed) {
    const bool is_as_it_was =
        now.class_is_fixed == from.class_is_fixed && (!now.class_is_fixed || now.class_id == from.class_id);
    if (!is_as_it_was) return Conflict(now.id, "class", "it was relabelled since");
    now.class_id = to.class_id;
    now.class_is_fixed = to.class_is_fixed;
  }
  return Status::Ok();
}

/// Counts of now, plus what the way adds.
std::vector<ClassTotal> Shifted(const std::vector<ClassTotal>& now, const Way<std::vector<ClassTotal>>& way) {
  std::map<ClassId, std::uint64_t> counts;
  for (const ClassTotal& total : now) counts[total.id] += total.count;
  for (const ClassTotal& total : way.to) counts[total.id] += total.count;
  for (const ClassTotal& total : way.from) counts[total.id] -= total.count;
  std::vector<ClassTotal> shifted;
  for (const auto& [id, count] : counts) {
    if (count != 0) shifted.push_back({id, count});
  }
  return shifted;
}

/// What frames set.
void SetSeenFields(const Way<SubmapInfo>& way, SubmapInfo& now) {
  const auto [from, to] = way;
  if (now.class_counts == from.class_counts) now.class_counts = to.class_counts;
  else now.class_counts = Shifted(now.class_counts, {from.class_counts, to.class_counts});
  now.num_frames_observed += to.num_frames_observed - from.num_frames_observed;
  SetIfAsItWas(now.instance_confidence, from.instance_confidence, to.instance_confidence);
  SetIfAsItWas(now.activity, from.activity, to.activity);
  SetIfAsItWas(now.is_confirmed, from.is_confirmed, to.is_confirmed);
  SetIfAsItWas(now.num_frames_missed, from.num_frames_missed, to.num_frames_missed);
  SetIfAsItWas(now.num_frames_overlooked, from.num_frames_overlooked, to.num_frames_overlooked);
  SetIfAsItWas(now.first_observed_ns, from.first_observed_ns, to.first_observed_ns);
  SetIfAsItWas(now.last_observed_ns, from.last_observed_ns, to.last_observed_ns);
  SetIfAsItWas(now.presence, from.presence, to.presence);
  SetIfAsItWas(now.last_contradicted_ns, from.last_contradicted_ns, to.last_contradicted_ns);
  SetIfAsItWas(now.track_id, from.track_id, to.track_id);
}

bool HasLayer(const BlockTile* tile, BlockLayer wanted) {
  if (tile == nullptr) return false;
  bool has = false;
  for (const BlockEntry& entry : tile->entries()) {
    ForEachLayer([&](BlockLayer layer, const auto& part) { has = has || (layer == wanted && part != nullptr); }, entry);
  }
  return has;
}

/// Whether a layer is what it was on the side `from`.
bool IsAsItWas(const BlockTile* now, const BlockTile* from, BlockLayer layer) {
  if (!HasLayer(from, layer)) return !HasLayer(now, layer);
  return now != nullptr && now->stored(layer).IsSameAs(from->stored(layer));
}

bool WritesSurfaces(const SubmapDelta& delta) {
  return std::any_of(delta.tiles.begin(), delta.tiles.end(), [](const TileDelta& tile) {
    return tile.differs[static_cast<std::size_t>(BlockLayer::kTsdf)] ||
           tile.differs[static_cast<std::size_t>(BlockLayer::kLabels)];
  });
}

class Application {
 public:
  Application(DeltaSide to, Map& map) : to_(to), map_(map) {}

  Status Apply(const StateDelta& delta) {
    for (const SubmapDelta& submap : delta.submaps) DHPMAP_RETURN_IF_ERROR(Apply(submap));
    for (const VacatedDelta& tile : delta.vacated) Apply(tile);
    if (!delta.merged.empty()) DHPMAP_RETURN_IF_ERROR(ApplyMerged(delta.merged));
    if (!delta.pairs.empty()) DHPMAP_RETURN_IF_ERROR(ApplyPairs(delta.pairs));
    if (!delta.display_name.empty()) {
      const auto [from, to] = WayTo(to_, delta.display_name.before, delta.display_name.after);
      if (map_.info().display_name != from.front()) {
        return Aborted("the map was renamed since").WithReason("UNDO_CONFLICT").WithMetadata("field", "display_name");
      }
      map_.mutable_info().display_name = to.front();
    }
    return Status::Ok();
  }

 private:
  Status Apply(const SubmapDelta& delta) {
    const auto [from, to] = WayTo(to_, delta.before, delta.after);
    const Submap* now = map_.Find(delta.id);
    if (from && now == nullptr) return Conflict(delta.id, "presence", "it is no longer there");
    if (!from && now != nullptr) return Conflict(delta.id, "presence", "it is there again already");
    if (!from) return PutBack(delta, *to);
    const bool is_strict = WritesSurfaces(delta);
    DHPMAP_RETURN_IF_ERROR(CheckTiles(delta, *now, is_strict));
    if (!to) return Remove(delta, *from, *now);
    Submap& submap = *map_.FindMutable(delta.id);
    for (const TileDelta& tile : delta.tiles) PutTile(tile, submap, is_strict);
    return SetRow({*from, *to}, submap);
  }

  Status PutBack(const SubmapDelta& delta, const SubmapRowState& row) {
    const std::uint32_t track_id = row.info.track_id;
    const bool is_another = std::any_of(map_.submaps().begin(), map_.submaps().end(), [track_id](const auto& submap) {
      return track_id != 0 && submap->info().track_id == track_id;
    });
    Submap& back = map_.PutBack(row.info);
    if (is_another) back.mutable_info().track_id = 0;  // its front end has found it again
    for (const TileDelta& tile : delta.tiles) {
      back.PutLayers(tile.index, WayTo(to_, tile.before, tile.after).to.get(), tile.differs);
    }
    back.set_bounding_sphere(row.sphere);
    NoteEdited(back);
    return Status::Ok();
  }

  Status CheckTiles(const SubmapDelta& delta, const Submap& now, bool is_strict) const {
    for (const TileDelta& tile : delta.tiles) {
      if (is_strict && !IsTileAsItWas(tile, now)) {
        return Conflict(delta.id, "voxels", "its voxels have changed since");
      }
    }
    return Status::Ok();
  }

  [[nodiscard]] bool IsTileAsItWas(const TileDelta& tile, const Submap& now) const {
    const TileEntry* entry = now.blocks().FindTile(tile.index);
    const BlockTile* from = WayTo(to_, tile.before, tile.after).from.get();
    for (std::size_t i = 0; i < kNumBlockLayers; ++i) {
      if (!tile.differs[i]) continue;
      if (!IsAsItWas(entry != nullptr ? entry->tile.get() : nullptr, from, static_cast<BlockLayer>(i))) return false;
    }
    return true;
  }

  /// Only what is all as the edit left it.
  Status Remove(const SubmapDelta& delta, const SubmapRowState& from, const Submap& now) {
    if (now.blocks().tiles().size() != delta.tiles.size()) {
      return Conflict(delta.id, "voxels", "something was added to it since");
    }
    for (const TileEntry& entry : now.blocks().tiles()) {
      const auto tile = std::find_if(delta.tiles.begin(), delta.tiles.end(),
                                     [&entry](const TileDelta& t) { return t.index == entry.index; });
      const bool is_known = tile != delta.tiles.end() && IsTileAsItWas(*tile, now);
      for (std::size_t i = 0; is_known && i < kNumBlockLayers; ++i) {
        if (!tile->differs[i] && HasLayer(entry.tile.get(), static_cast<BlockLayer>(i))) {
          return Conflict(delta.id, "voxels", "something was added to it since");
        }
      }
      if (!is_known) return Conflict(delta.id, "voxels", "its voxels have changed since");
    }
    const SubmapInfo &was = from.info, &is = now.info();
    if (is.T_map_submap.matrix() != was.T_map_submap.matrix()) {
      return Conflict(delta.id, "pose", "it was moved since");
    }
    if (is.display_name != was.display_name) return Conflict(delta.id, "display_name", "it was renamed since");
    if (is.class_is_fixed != was.class_is_fixed || (is.class_is_fixed && is.class_id != was.class_id)) {
      return Conflict(delta.id, "class", "it was relabelled since");
    }
    map_.Remove(delta.id);
    return Status::Ok();
  }

  void PutTile(const TileDelta& tile, Submap& submap, bool is_strict) const {
    if (!is_strict) {  // what was looked through alone: where there still is a surface, and nothing was since
      const TileEntry* entry = submap.blocks().FindTile(tile.index);
      const BlockTile* to = WayTo(to_, tile.before, tile.after).to.get();
      if (!IsTileAsItWas(tile, submap) || entry == nullptr) return;
      for (const BlockEntry& block : to != nullptr ? to->entries() : std::span<const BlockEntry>()) {
        const BlockEntry* known = entry->tile->Find(CellOf(block.index));
        if (known == nullptr || known->tsdf == nullptr) return;
      }
    }
    submap.PutLayers(tile.index, WayTo(to_, tile.before, tile.after).to.get(), tile.differs);
  }

  Status SetRow(const Way<SubmapRowState>& way, Submap& submap) {
    SubmapInfo& now = submap.mutable_info();
    const bool was_as_left = now.class_counts == way.from.info.class_counts;
    DHPMAP_RETURN_IF_ERROR(SetEditedFields({way.from.info, way.to.info}, now));
    SetSeenFields({way.from.info, way.to.info}, now);
    if (!was_as_left && !now.class_counts.empty()) {  // what frames have seen since counts, too
      constexpr std::uint64_t kNothingNew = 0;
      submap.AddClassObservations(now.class_counts.front().id, kNothingNew);
    }
    if (IsSame(submap.bounding_sphere(), way.from.sphere)) submap.set_bounding_sphere(way.to.sphere);
    else submap.UpdateBoundingSphere();
    NoteEdited(submap);
    return Status::Ok();
  }

  void NoteEdited(Submap& submap) const { submap.mutable_info().edited_revision = map_.info().revision + 1; }

  /// As it was, or else voxel by voxel: those that the way takes away go, those that it adds come.
  void Apply(const VacatedDelta& delta) {
    const auto [from, to] = WayTo(to_, delta.before, delta.after);
    const FreeTile* now = map_.vacated().Find(delta.index);
    const bool is_as_it_was = now == nullptr || from == nullptr ? now == from.get() : *now == *from;
    FreeSpace& vacated = map_.mutable_vacated();
    if (is_as_it_was) {
      vacated.Erase(delta.index);
      if (to != nullptr) vacated.Put(delta.index, to);
      return;
    }
    FreeBlocks left;
    for (int cell = 0; cell < kTileBlocks; ++cell) {
      const auto i = static_cast<std::size_t>(cell);
      const auto mask_of = [cell](const FreeTile* tile) { return tile != nullptr ? tile->MaskOf(cell) : FreeMask{}; };
      const FreeMask present = mask_of(now), lost = mask_of(from.get()), won = mask_of(to.get());
      bool is_full = true, is_empty = true;
      for (std::size_t word = 0; word < present.size(); ++word) {
        left.masks[i][word] = (present[word] & ~(lost[word] & ~won[word])) | (won[word] & ~lost[word]);
        is_full = is_full && left.masks[i][word] == ~std::uint64_t{0};
        is_empty = is_empty && left.masks[i][word] == 0;
      }
      if (is_full) left.full |= std::uint64_t{1} << cell;
      else if (!is_empty) left.mixed |= std::uint64_t{1} << cell;
    }
    auto tile = std::make_shared<FreeTile>();
    if (!left.empty()) tile->Add(left);
    tile->set_last_seen_ns(now != nullptr ? now->last_seen_ns() : to->last_seen_ns());
    vacated.Erase(delta.index);
    if (!tile->empty()) vacated.Put(delta.index, std::move(tile));
  }

  Status ApplyMerged(const ListDelta<MergedId>& delta) {
    const auto [from, to] = WayTo(to_, delta.before, delta.after);
    std::vector<MergedId> list = map_.info().merged.list();
    std::erase_if(list,
                  [&from](const MergedId& entry) { return std::find(from.begin(), from.end(), entry) != from.end(); });
    for (const MergedId& entry : to) {
      const auto is_it = [&entry](const MergedId& other) { return other.merged == entry.merged; };
      if (std::none_of(list.begin(), list.end(), is_it)) list.push_back(entry);
    }
    std::sort(list.begin(), list.end(), [](const MergedId& a, const MergedId& b) { return a.merged < b.merged; });
    DHPMAP_ASSIGN_OR_RETURN(map_.mutable_info().merged, MergedIds::Create(std::move(list)));
    return Status::Ok();
  }

  Status ApplyPairs(const ListDelta<ObjectPair>& delta) {
    const auto [from, to] = WayTo(to_, delta.before, delta.after);
    const auto present = map_.info().pairs.pairs();
    std::vector<ObjectPair> pairs(present.begin(), present.end());
    std::erase_if(pairs,
                  [&from](const ObjectPair& pair) { return std::find(from.begin(), from.end(), pair) != from.end(); });
    for (const ObjectPair& pair : to) {
      const auto is_it = [&pair](const ObjectPair& o) { return o.first == pair.first && o.second == pair.second; };
      const bool is_there = map_.Find(pair.first) != nullptr && map_.Find(pair.second) != nullptr;
      if (is_there && std::none_of(pairs.begin(), pairs.end(), is_it)) pairs.push_back(pair);
    }
    const auto key = [](const ObjectPair& pair) { return std::pair(pair.first, pair.second); };
    std::sort(pairs.begin(), pairs.end(), [key](const ObjectPair& a, const ObjectPair& b) { return key(a) < key(b); });
    DHPMAP_ASSIGN_OR_RETURN(map_.mutable_info().pairs, ObjectPairs::Create(std::move(pairs)));
    return Status::Ok();
  }

  const DeltaSide to_;
  Map& map_;
};

}  // namespace

Status ApplyDelta(const StateDelta& delta, DeltaSide to, Map& map) { return Application(to, map).Apply(delta); }

}  // namespace dhpmap

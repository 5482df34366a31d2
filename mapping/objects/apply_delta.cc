// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/objects/apply_delta.h"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <map>
#include <string>
#include <utility>

#include "mapping/submap/submap_fields.h"

namespace dhpmap {
namespace {

/// The two sides of a change, in the direction in which it is applied.
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

bool IsSameState(const BoundingSphere& a, const BoundingSphere& b) {
  return a.center_m == b.center_m && a.radius_m == b.radius_m;
}

template <typename T>
void SetIfAsItWas(T& now, const T& from, const T& to) {
  if (IsSameValue(now, from)) now = to;
}

/// Sets fields that edits set. Conflicts with later edits of the same fields.
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
  if (from.is_locked != to.is_locked) {
    if (now.is_locked != from.is_locked) return Conflict(now.id, "locked", "it was locked or unlocked since");
    now.is_locked = to.is_locked;
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

/// The current counts, plus the difference between the two sides.
std::vector<ClassTotal> Shifted(const std::vector<ClassTotal>& now, const Way<std::vector<ClassTotal>>& way) {
  std::map<ClassId, std::uint64_t> counts;
  for (const ClassTotal& total : now) counts[total.id] += total.count;
  for (const ClassTotal& total : way.to) counts[total.id] += total.count;
  for (const ClassTotal& total : way.from) {  // later edits may have moved some of them
    std::uint64_t& count = counts[total.id];
    count -= std::min(count, total.count);
  }
  std::vector<ClassTotal> shifted;
  for (const auto& [id, count] : counts) {
    if (count != 0) shifted.push_back({id, count});
  }
  return shifted;
}

/// Sets fields that frames set.
void SetSeenFields(const Way<SubmapInfo>& way, SubmapInfo& now) {
  const SubmapInfo &from = way.from, &to = way.to;  // no structured bindings: clang does not capture them in lambdas
  if (now.class_counts == from.class_counts) now.class_counts = to.class_counts;
  else now.class_counts = Shifted(now.class_counts, {from.class_counts, to.class_counts});
  now.num_frames_observed =
      std::max<std::int64_t>(0, now.num_frames_observed + to.num_frames_observed - from.num_frames_observed);
  VisitSubmapFields([&](const auto& field) {
    if (field.undo == UndoRule::kUnlessChanged) SetIfAsItWas(field.Of(now), field.Of(from), field.Of(to));
  });
}

/// Drops track ids that frames have since assigned to other things.
void ForgetTracksOfOthers(const Map& map, Submap& back) {
  SubmapInfo& info = back.mutable_info();
  const bool had_track = info.sightings.HasTrack();
  for (const auto& other : map.submaps()) {
    if (other->id() == back.id()) continue;
    if (!had_track && other->info().track_id == info.track_id) info.track_id = 0;  // the id of any session
    for (const Sighting& sighting : other->info().sightings.all()) {
      info.sightings.ForgetTrack(sighting.session, sighting.track_id);
    }
  }
  if (had_track && !info.sightings.HasTrack()) info.track_id = 0;
}

/// Calls visit(Sighting) for the track ids that only `some` has.
template <typename Visitor>
void VisitTracksOf(const Sightings& some, const Sightings& others, Visitor&& visit) {
  for (const Sighting& sighting : some.all()) {
    if (sighting.track_id != 0 && !others.IsTrackedAs(sighting.session, sighting.track_id)) visit(sighting);
  }
}

bool IsTracked(const Map& map, const Sighting& track) {
  return std::any_of(map.submaps().begin(), map.submaps().end(), [&track](const auto& submap) {
    return submap->info().sightings.IsTrackedAs(track.session, track.track_id);
  });
}

/// Whether the current sphere contains all blocks of the submap.
bool HoldsAllBlocks(const Submap& submap) {
  constexpr double kRounding = 1 + 1e-9;
  const BoundingSphere& sphere = submap.bounding_sphere();
  const double side_m = kBlockSide * submap.info().voxel_size_m;
  const auto holds = [&](const auto& index, double cube_m) {
    const Eigen::Array3d center_m = (Eigen::Array3d(index.x, index.y, index.z) + 0.5) * cube_m;
    const Eigen::Array3d farthest_m = (center_m - sphere.center_m.array()).abs() + 0.5 * cube_m;
    return farthest_m.matrix().norm() <= sphere.radius_m * kRounding;
  };
  const auto tiles = submap.blocks().tiles();
  return std::all_of(tiles.begin(), tiles.end(), [&](const TileEntry& tile) {
    if (holds(tile.index, kTileSide * side_m)) return true;
    for (std::uint64_t left = tile.tile->cells(); left != 0; left &= left - 1) {  // reads no pages
      if (!holds(BlockIn(tile.index, std::countr_zero(left)), side_m)) return false;
    }
    return true;
  });
}

bool HasLayer(const BlockTile* tile, BlockLayer wanted) { return tile != nullptr && tile->CellsWith(wanted) != 0; }

/// Whether a layer is equal to that on the side `from`.
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
    const ListDelta<MergedId>& merged = delta.merged;
    for (const bool goes : {true, false}) {  // remove before inserting
      for (const SubmapDelta& submap : delta.submaps) {
        if (WayTo(to_, submap.before, submap.after).to.has_value() == goes) continue;
        DHPMAP_RETURN_IF_ERROR(Apply(submap, WayTo(to_, merged.before, merged.after).from));
      }
    }
    SettleTracks(delta);
    for (const VacatedDelta& tile : delta.vacated) Apply(tile);
    if (!delta.merged.empty()) DHPMAP_RETURN_IF_ERROR(ApplyMerged(delta.merged));
    if (!delta.pairs.empty()) DHPMAP_RETURN_IF_ERROR(ApplyPairs(delta.pairs));
    if (!delta.kept_clear.empty()) DHPMAP_RETURN_IF_ERROR(ApplyKeptClear(delta.kept_clear));
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
  /// `unmerged`: submaps that become objects again.
  Status Apply(const SubmapDelta& delta, const std::vector<MergedId>& unmerged) {
    const auto [from, to] = WayTo(to_, delta.before, delta.after);
    const Submap* now = map_.Find(delta.id);
    if (from && now == nullptr) return Conflict(delta.id, "presence", "it is no longer there");
    if (!from && now != nullptr) return Conflict(delta.id, "presence", "it is there again already");
    if (!from) return PutBack(delta, *to, unmerged);
    const bool is_strict = WritesSurfaces(delta);
    DHPMAP_RETURN_IF_ERROR(CheckTiles(delta, *now, is_strict));
    if (!to) return Remove(delta, *from, *now);
    Submap& submap = *map_.FindMutable(delta.id);
    for (const TileDelta& tile : delta.tiles) PutTile(tile, submap, is_strict);
    return SetRow({*from, *to}, submap);
  }

  Status PutBack(const SubmapDelta& delta, const SubmapRowState& row, const std::vector<MergedId>& unmerged) {
    const auto is_unmerged = [&delta](const MergedId& entry) { return entry.merged == delta.id; };
    if (map_.info().merged.Into(delta.id) && std::none_of(unmerged.begin(), unmerged.end(), is_unmerged)) {
      return Conflict(delta.id, "presence", "it is a part of another by now");
    }
    // A class has one submap, which all its frames use even if it was relabelled, and those that were placed by an
    // edit.
    const auto is_in_its_place = [&row](const auto& other) {
      const SubmapInfo& info = other->info();
      const bool is_one = info.IsSeenAs(row.info.class_id) || row.info.IsSeenAs(info.class_id);
      return info.panoptic == Panoptic::kStuff && is_one && !info.is_placed;
    };
    if (row.info.panoptic == Panoptic::kStuff && !row.info.is_placed &&
        std::any_of(map_.submaps().begin(), map_.submaps().end(), is_in_its_place)) {
      return Conflict(delta.id, "class", "its class has been mapped anew since");
    }
    Submap& back = map_.PutBack(row.info);
    for (const TileDelta& tile : delta.tiles) {
      back.PutLayers(tile.index, WayTo(to_, tile.before, tile.after).to.get(), tile.differs);
    }
    back.set_bounding_sphere(row.sphere);
    NoteEdited(back);
    return Status::Ok();
  }

  /// Call once all submaps exist. Tracks that a merge handed over return with the restored submap. Only these tracks
  /// are changed: frames may have changed the sightings of the whole since, which stay.
  void SettleTracks(const StateDelta& delta) {
    for (const SubmapDelta& submap : delta.submaps) {
      const auto [from, to] = WayTo(to_, submap.before, submap.after);
      if (!from || !to) continue;
      VisitTracksOf(from->info.sightings, to->info.sightings, [&, id = submap.id](const Sighting& track) {
        if (ComesBackWith(track, delta)) {
          map_.FindMutable(id)->mutable_info().sightings.ForgetTrack(track.session, track.track_id);
        }
      });
    }
    for (const SubmapDelta& submap : delta.submaps) {
      const auto [from, to] = WayTo(to_, submap.before, submap.after);
      if (!from && to) ForgetTracksOfOthers(map_, *map_.FindMutable(submap.id));
      if (!from || !to) continue;
      VisitTracksOf(to->info.sightings, from->info.sightings, [&, id = submap.id](const Sighting& track) {
        if (IsTracked(map_, track)) return;
        map_.FindMutable(id)->mutable_info().sightings.AddTrack(track.session, track.track_id);
      });
    }
  }

  [[nodiscard]] bool ComesBackWith(const Sighting& track, const StateDelta& delta) const {
    return std::any_of(delta.submaps.begin(), delta.submaps.end(), [&](const SubmapDelta& submap) {
      const auto [from, to] = WayTo(to_, submap.before, submap.after);
      return !from && to && to->info.sightings.IsTrackedAs(track.session, track.track_id);
    });
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

  /// Only if all of it is as the edit left it.
  Status Remove(const SubmapDelta& delta, const SubmapRowState& from, const Submap& now) {
    if (now.blocks().tiles().size() != delta.tiles.size()) {
      return Conflict(delta.id, "voxels", "something was added to it since");
    }
    for (const TileEntry& entry : now.blocks().tiles()) {
      const auto tile = std::lower_bound(delta.tiles.begin(), delta.tiles.end(), entry.index,
                                         [](const TileDelta& t, TileIndex index) { return t.index < index; });
      const bool is_known = tile != delta.tiles.end() && tile->index == entry.index && IsTileAsItWas(*tile, now);
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
    if (is.is_locked != was.is_locked) return Conflict(delta.id, "locked", "it was locked or unlocked since");
    map_.Remove(delta.id);
    return Status::Ok();
  }

  void PutTile(const TileDelta& tile, Submap& submap, bool is_strict) const {
    if (!is_strict) {  // only look-through counts: where a surface is left and they did not change since
      const TileEntry* entry = submap.blocks().FindTile(tile.index);
      const BlockTile* to = WayTo(to_, tile.before, tile.after).to.get();
      if (!IsTileAsItWas(tile, submap) || entry == nullptr) return;
      for (const BlockEntry& block : to != nullptr ? to->entries() : std::span<const BlockEntry>()) {
        const BlockEntry* known = entry->tile->Find(CellOf(block.index));
        if (known == nullptr || known->tsdf == nullptr) return;
      }
    }
    submap.PutLayers(tile.index, WayTo(to_, tile.before, tile.after).to.get(), tile.differs);
    if (is_strict) EraseBareBlocks(tile.index, submap);
  }

  /// Look-through counts of a block without a surface have no meaning.
  static void EraseBareBlocks(TileIndex index, Submap& submap) {
    const TileEntry* entry = submap.blocks().FindTile(index);
    if (entry == nullptr) return;
    std::vector<BlockIndex> bare;
    for (const BlockEntry& block : entry->tile->entries()) {
      if (block.tsdf == nullptr && block.labels == nullptr) bare.push_back(block.index);
    }
    for (const BlockIndex block : bare) submap.EraseBlock(block);
  }

  Status SetRow(const Way<SubmapRowState>& way, Submap& submap) {
    SubmapInfo& now = submap.mutable_info();
    const bool was_as_left = now.class_counts == way.from.info.class_counts;
    DHPMAP_RETURN_IF_ERROR(SetEditedFields({way.from.info, way.to.info}, now));
    SetSeenFields({way.from.info, way.to.info}, now);
    if (!was_as_left && !now.class_counts.empty()) {  // counts of frames since then matter, too
      constexpr std::uint64_t kNothingNew = 0;
      submap.AddClassObservations(now.class_counts.front().id, kNothingNew);
    }
    SetSphere({way.from.sphere, way.to.sphere}, submap);
    NoteEdited(submap);
    return Status::Ok();
  }

  /// Restores the sphere, unless it would not contain all blocks: frames may have extended the submap since.
  static void SetSphere(const Way<BoundingSphere>& way, Submap& submap) {
    const bool is_as_it_was = IsSameState(submap.bounding_sphere(), way.from);
    if (is_as_it_was && IsSameState(way.from, way.to)) return;
    if (is_as_it_was) submap.set_bounding_sphere(way.to);
    if (!is_as_it_was || !HoldsAllBlocks(submap)) submap.UpdateBoundingSphere();
  }

  void NoteEdited(Submap& submap) const { submap.mutable_info().edited_revision = map_.info().revision + 1; }

  /// Restores the tile if it is unchanged. Else merges voxel by voxel: removes and adds the voxels of the change.
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
    const std::int64_t last_seen_ns = now != nullptr ? now->last_seen_ns() : to != nullptr ? to->last_seen_ns() : 0;
    vacated.Erase(delta.index);
    if (left.empty()) return;
    auto tile = std::make_shared<FreeTile>();
    tile->Add(left);
    tile->set_last_seen_ns(last_seen_ns);
    vacated.Put(delta.index, std::move(tile));
  }

  Status ApplyMerged(const ListDelta<MergedId>& delta) {
    const auto [from, to] = WayTo(to_, delta.before, delta.after);
    std::vector<MergedId> list = map_.info().merged.list();
    std::erase_if(list, [&from = from](const MergedId& entry) {
      return std::find(from.begin(), from.end(), entry) != from.end();
    });
    for (const MergedId& entry : to) {
      const auto is_it = [&entry](const MergedId& other) { return other.merged == entry.merged; };
      if (std::none_of(list.begin(), list.end(), is_it)) list.push_back(entry);
    }
    std::sort(list.begin(), list.end(), [](const MergedId& a, const MergedId& b) { return a.merged < b.merged; });
    DHPMAP_ASSIGN_OR_RETURN(map_.mutable_info().merged, MergedIds::Create(std::move(list)));
    return Status::Ok();
  }

  Status ApplyKeptClear(const ListDelta<KeptClearRegion>& delta) {
    const auto [from, to] = WayTo(to_, delta.before, delta.after);
    KeptClear& now = map_.mutable_info().kept_clear;
    const auto conflict = [](const std::string& name, const std::string& what) {
      return Aborted("the region '" + name + "' " + what)
          .WithReason("UNDO_CONFLICT")
          .WithMetadata("field", "ignored_regions");
    };
    for (const KeptClearRegion& region : from) {
      const KeptClearRegion* present = now.Find(region.name);
      if (present == nullptr || *present != region) return conflict(region.name, "is no longer kept clear");
      now.Lift(region.name);
    }
    for (const KeptClearRegion& region : to) {
      const Status added = now.Add(region);
      if (!added.ok()) return conflict(region.name, "cannot be kept clear again: " + added.message());
    }
    return Status::Ok();
  }

  /// Whether both exist, or one into which the other was merged.
  [[nodiscard]] bool IsThere(const ObjectPair& pair) const {
    const bool has_first = map_.Find(pair.first) != nullptr, has_second = map_.Find(pair.second) != nullptr;
    const MergedIds& merged = map_.info().merged;
    return (has_first && (has_second || merged.Into(pair.second) == pair.first)) ||
           (has_second && merged.Into(pair.first) == pair.second);
  }

  Status ApplyPairs(const ListDelta<ObjectPair>& delta) {
    const auto [from, to] = WayTo(to_, delta.before, delta.after);
    const auto present = map_.info().pairs.pairs();
    std::vector<ObjectPair> pairs(present.begin(), present.end());
    std::erase_if(pairs, [&from = from](const ObjectPair& pair) {
      return std::find(from.begin(), from.end(), pair) != from.end();
    });
    for (const ObjectPair& pair : to) {
      const auto is_it = [&pair](const ObjectPair& o) { return o.first == pair.first && o.second == pair.second; };
      if (IsThere(pair) && std::none_of(pairs.begin(), pairs.end(), is_it)) pairs.push_back(pair);
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

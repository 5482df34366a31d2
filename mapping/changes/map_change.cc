// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/changes/map_change.h"

#include <algorithm>
#include <set>
#include <tuple>
#include <utility>

#include "mapping/base/status_error.h"
#include "mapping/submap/observed_sphere.h"
#include "mapping/submap/submap_fields.h"
#include "mapping/submap/submap_outline.h"

namespace dhpmap {
namespace {

/// Rows of tiles along x become boxes; too many boxes become one.
std::vector<TileBox> BoxesAround(const std::set<TileIndex>& tiles_by_x) {
  std::vector<TileIndex> tiles(tiles_by_x.begin(), tiles_by_x.end());
  std::sort(tiles.begin(), tiles.end(),
            [](const TileIndex& a, const TileIndex& b) { return std::tie(a.z, a.y, a.x) < std::tie(b.z, b.y, b.x); });
  std::vector<TileBox> boxes;
  for (const TileIndex& tile : tiles) {
    TileBox* last = boxes.empty() ? nullptr : &boxes.back();
    if (last != nullptr && last->high.z == tile.z && last->high.y == tile.y && last->high.x + 1 == tile.x) {
      last->high = tile;
    } else {
      boxes.push_back({tile, tile});
    }
  }
  if (boxes.size() <= kMaxTileBoxes) return boxes;
  TileBox all = boxes.front();
  for (const TileBox& box : boxes) {
    all.low = {std::min(all.low.x, box.low.x), std::min(all.low.y, box.low.y), std::min(all.low.z, box.low.z)};
    all.high = {std::max(all.high.x, box.high.x), std::max(all.high.y, box.high.y), std::max(all.high.z, box.high.z)};
  }
  return {all};
}

bool IsWritten(const TileChange& tile, BlockLayer layer) { return tile.is_written[static_cast<std::size_t>(layer)]; }

std::vector<TileBox> TilesOfGeometry(const SubmapTileChange& change) {
  std::set<TileIndex> tiles;
  for (const TileChange& tile : change.tiles) {
    if (IsWritten(tile, BlockLayer::kTsdf) || IsWritten(tile, BlockLayer::kGone)) tiles.insert(tile.index);
  }
  return BoxesAround(tiles);
}

SubmapParts PartsOf(const SubmapInfo& before, const SubmapInfo& after) {
  SubmapParts parts;
  VisitSubmapFields([&](const auto& field) {
    if (field.told_as && !IsSameValue(field.Of(before), field.Of(after))) parts.Add(*field.told_as);
  });
  return parts;
}

SubmapPlace PlaceOf(const SubmapMarks& marks) {
  return {marks.info().panoptic, marks.info().class_id, marks.sphere_in_map()};
}

void MarkAsGone(SubmapEvent& event, const MergedIds& merged) {
  event.kind = ChangeKind::kRemoved;
  if (const auto into = merged.Into(event.info.id)) {
    event.kind = ChangeKind::kMerged;
    event.into = *into;
  }
}

SubmapEvent EventOfMissing(const SubmapMarks& before, const MergedIds& merged) {
  SubmapEvent event{.info = before.info(), .before = PlaceOf(before)};
  MarkAsGone(event, merged);
  return event;
}

/// Those that came after `before` and are gone again: nobody is told that they came, but who listed them meanwhile has
/// them.
void AddPassing(const StateMarks& before, const MapSnapshot& after, std::vector<SubmapEvent>& events) {
  if (before.revision() == 0) return;
  for (SubmapId id = before.info().next_submap_id; id < after.info().next_submap_id; ++id.value) {
    if (after.Find(id) != nullptr) continue;
    SubmapEvent event;
    event.info.id = id;
    MarkAsGone(event, after.info().merged);
    events.push_back(std::move(event));
  }
}

/// Around all blocks where some cannot be read: nobody's commit waits for a disk to be mended.
BoundingSphere ObservedOrAll(const Submap& submap) {
  try {
    return SphereOfObservedInMap(submap);
  } catch (const StatusError&) {
    return submap.BoundingSphereInMap();
  }
}

/// Nothing where it cannot be read; likewise.
std::int64_t NumBlocksIfKnown(const Submap& submap) {
  try {
    return static_cast<std::int64_t>(submap.blocks().size());
  } catch (const StatusError&) {
    return 0;
  }
}

/// Likewise.
std::optional<PoseBoxes> PoseBoxesIfKnown(const Transform& T_map_before, const Submap& submap) {
  try {
    const auto before = OutlineAt(T_map_before, submap), after = OutlineInMap(submap);
    if (!before || !after) return std::nullopt;
    return PoseBoxes{BoxAround(*before), BoxAround(*after)};
  } catch (const StatusError&) {
    return std::nullopt;
  }
}

SubmapEvent EventOfPresent(const SubmapMarks* before, const SubmapTileChange& change) {
  const Submap& submap = *change.after;
  SubmapEvent event{.kind = before == nullptr ? ChangeKind::kCreated : ChangeKind::kChanged,
                    .info = submap.info(),
                    .observed = ObservedOrAll(submap),
                    .num_blocks = NumBlocksIfKnown(submap)};
  if (before == nullptr) return event;
  event.before = PlaceOf(*before);
  event.parts = PartsOf(before->info(), submap.info());
  if (event.parts.Has(SubmapPart::kPose)) {
    event.pose_boxes = PoseBoxesIfKnown(before->info().T_map_submap, submap);
  }
  event.tiles = TilesOfGeometry(change);
  if (!event.tiles.empty()) event.parts.Add(SubmapPart::kGeometry);
  const bool has_new_labels = std::any_of(change.tiles.begin(), change.tiles.end(),
                                          [](const TileChange& tile) { return IsWritten(tile, BlockLayer::kLabels); });
  if (has_new_labels) event.parts.Add(SubmapPart::kVoxelLabels);
  return event;
}

/// A region of the same name that is another one is lifted and kept clear.
void AddKeptClear(const KeptClear& before, const KeptClear& after, std::vector<RegionEvent>& events) {
  const auto add = [&events](const KeptClear& of, const KeptClear& other, RegionEventKind kind) {
    for (const KeptClearRegion& region : of.list()) {
      const KeptClearRegion* same = other.Find(region.name);
      if (same == nullptr || !(*same == region)) {
        events.push_back({.kind = kind, .region = region.region, .name = region.name});
      }
    }
  };
  add(before, after, RegionEventKind::kLifted);
  add(after, before, RegionEventKind::kKeptClear);
}

}  // namespace

MapChange DescribeChange(const StateMarks& before, const MapSnapshot& after,
                         const std::vector<SubmapTileChange>& submaps, const std::vector<RegionEvent>& cleared) {
  MapChange change{.first_revision = before.revision() + 1,
                   .last_revision = after.revision(),
                   .time_ns = after.info().update_time_ns,
                   .submaps = {},
                   .regions = cleared};
  AddKeptClear(before.info().kept_clear, after.info().kept_clear, change.regions);
  if (before.revision() > 0 && before.info().display_name != after.info().display_name) {
    change.display_name = after.info().display_name;
  }
  for (const SubmapTileChange& submap : submaps) {
    const SubmapMarks* old = before.Find(submap.id);
    if (submap.after != nullptr) change.submaps.push_back(EventOfPresent(old, submap));
    else if (old != nullptr) change.submaps.push_back(EventOfMissing(*old, after.info().merged));
  }
  AddPassing(before, after, change.submaps);
  std::sort(change.submaps.begin(), change.submaps.end(),
            [](const SubmapEvent& a, const SubmapEvent& b) { return a.info.id < b.info.id; });
  return change;
}

std::size_t BytesOf(const MapChange& change) {
  std::size_t bytes = sizeof change;
  for (const SubmapEvent& event : change.submaps) {
    bytes += sizeof event + event.info.display_name.size() + event.tiles.size() * sizeof(TileBox) +
             event.info.class_counts.size() * sizeof(ClassTotal);
  }
  for (const RegionEvent& event : change.regions) {
    bytes += sizeof event + event.name.size() + event.classes.size() * sizeof(ClassId);
  }
  return bytes;
}

}  // namespace dhpmap

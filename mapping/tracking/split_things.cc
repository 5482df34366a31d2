// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/tracking/split_things.h"

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <optional>
#include <utility>

#include "mapping/fusion/band_size.h"
#include "mapping/map/map_grid.h"
#include "mapping/tracking/find_stuff.h"
#include "mapping/tracking/find_track.h"
#include "mapping/tracking/things_in_view.h"

namespace dhpmap {
namespace {

/// A segment shows a thing if this many of its points hit it, or this share of the segment if that is fewer. Fewer hits
/// come from masks that bleed over a neighbour. The first value equals that in the evidence of pairs.
constexpr std::int64_t kLeastPointsShown = 60, kLeastPercentShown = 5;

/// A piece of a background's segment belongs to a thing if one in this many of its points hits the thing; the others
/// are newly observed sides. Points of other objects on the thing are fewer (above).
constexpr std::int64_t kLeastShareOfPiece = 5;

/// Persistent ids separate things already; only a user's verdict overrides them.
bool AreTwo(const ObjectPair& pair, bool has_persistent_ids) {
  return has_persistent_ids ? pair.verdict == PairVerdict::kMustBeTwo : pair.AreTwo();
}

bool IsOnGridOf(const Map& map, SubmapId id) { return IsOnMapGrid(map.Find(id)->info(), map.info().config); }

/// Hits of segments on things, by bundle and in total.
struct FrameHits {
  FrameHits(const ThingsInView& things, const std::vector<SegmentBundles>& segments, ThreadPool& pool)
      : hit_by(segments.size()), of_segment(segments.size()), of_frame(things.list().size(), 0) {
    pool.ParallelFor(segments.size(), [&](std::size_t s) {
      std::vector<std::uint32_t> hits = things.HitsOf(segments[s]);
      std::vector<std::int64_t> num_points(of_frame.size(), 0);
      for (std::size_t b = 0; b < hits.size(); ++b) {
        if (hits[b] != ThingsInView::kNone) num_points[hits[b]] += segments[s].bundles[b].num_points;
      }
      hit_by[s] = std::move(hits);
      of_segment[s] = std::move(num_points);
    });
    for (const auto& hits : of_segment) {
      for (std::size_t t = 0; t < hits.size(); ++t) of_frame[t] += hits[t];
    }
  }

  std::vector<std::vector<std::uint32_t>> hit_by;     ///< by segment, then bundle
  std::vector<std::vector<std::int64_t>> of_segment;  ///< points, by segment, then thing
  std::vector<std::int64_t> of_frame;                 ///< by thing
};

/// The background of the segment's class if things were split from it by a user, else null.
const Submap* SplitBackgroundOf(const PanopticFrame& frame, int row, const Map& map) {
  if (row < 0) return nullptr;
  const auto& class_id = frame.segments[static_cast<std::size_t>(row)].class_id;
  const LabelClass* label_class = class_id ? map.info().label_set->Find(*class_id) : nullptr;
  if (label_class == nullptr || label_class->panoptic != Panoptic::kStuff) return nullptr;
  const Submap* background = FindStuff(map, *class_id);
  if (background == nullptr) return nullptr;
  const auto pairs = map.info().pairs.pairs();
  const bool is_split = std::any_of(pairs.begin(), pairs.end(), [background](const ObjectPair& pair) {
    return pair.verdict == PairVerdict::kMustBeTwo &&
           (pair.first == background->id() || pair.second == background->id());
  });
  return is_split ? background : nullptr;
}

/// The submap of the segment as a whole. Nothing: do not cut it.
std::optional<SubmapId> WholeOf(const PanopticFrame& frame, const SegmentBundles& segment, const ThingsInView& things,
                                const std::vector<std::int64_t>& hits, const Map& map) {
  if (frame.has_persistent_ids) {
    const SegmentId id = frame.segments[static_cast<std::size_t>(segment.row)].id;
    const Submap* known = FindTrack(map, frame.session, id.value);
    // A submap with its own grid takes the whole segment: see FuseFrame.
    return known != nullptr && IsOnGridOf(map, known->id()) ? std::optional(known->id()) : std::nullopt;
  }
  const auto most = std::max_element(hits.begin(), hits.end());
  if (most == hits.end() || *most == 0) return std::nullopt;
  const ThingInView& thing = things.list()[static_cast<std::size_t>(most - hits.begin())];
  return thing.is_on_map_grid ? std::optional(thing.submap->id()) : std::nullopt;
}

/// For each thing the number of its piece; 0: it stays with the rest of the segment. A thing with most of its points of
/// this frame in another segment is separated by the frame itself, and gets no piece.
std::vector<std::uint32_t> PiecesOf(SubmapId whole, bool has_persistent_ids, const ThingsInView& things,
                                    std::int64_t num_points, const std::vector<std::int64_t>& hits,
                                    const std::vector<std::int64_t>& of_frame, const Map& map,
                                    std::uint32_t& num_pieces) {
  std::vector<std::uint32_t> piece_of(things.list().size(), 0);
  num_pieces = 1;
  const std::int64_t least_points =
      std::clamp<std::int64_t>(kLeastPercentShown * num_points / 100, 1, kLeastPointsShown);
  for (std::size_t t = 0; t < piece_of.size(); ++t) {
    const ThingInView& thing = things.list()[t];
    const bool is_shown = hits[t] >= least_points && 2 * hits[t] > of_frame[t] && thing.is_on_map_grid;
    if (is_shown && AreTwo(map.info().pairs.Of(whole, thing.submap->id()), has_persistent_ids))
      piece_of[t] = num_pieces++;
  }
  return piece_of;
}

std::vector<VoxelIndex> VoxelsOf(const SegmentBundles& segment) {
  std::vector<VoxelIndex> voxels(segment.bundles.size());
  for (const BundleCell& cell : segment.cells) {
    for (std::uint32_t b = cell.first_bundle; b < cell.first_bundle + cell.num_bundles; ++b) {
      voxels[b] = VoxelIn(cell.block, segment.bundles[b].linear);
    }
  }
  return voxels;
}

/// The bundle of the segment that ends in the voxel, or kNone.
std::uint32_t BundleAt(const SegmentBundles& segment, VoxelIndex voxel) {
  const BundleCell* cell = segment.Find(BlockOf(voxel));
  const int linear = LinearIndex(voxel);
  return cell != nullptr && IsIn(cell->ends, linear) ? cell->BundleAt(linear) : ThingsInView::kNone;
}

/// Newly observed sides hit nothing. They join the piece next to them on the segment's surface, if there is one.
void SpreadPieces(const SegmentBundles& segment, std::vector<std::uint32_t>& piece_of_bundle) {
  const std::vector<VoxelIndex> voxels = VoxelsOf(segment);
  std::vector<std::uint32_t> reached;
  reached.reserve(voxels.size());
  for (std::uint32_t b = 0; b < voxels.size(); ++b) {
    if (piece_of_bundle[b] != ThingsInView::kNone) reached.push_back(b);
  }
  for (std::size_t next = 0; next < reached.size(); ++next) {
    const VoxelIndex v = voxels[reached[next]];
    for (int n = 0; n < 27; ++n) {
      const std::uint32_t b = BundleAt(segment, {v.x + n % 3 - 1, v.y + n / 3 % 3 - 1, v.z + n / 9 - 1});
      if (b == ThingsInView::kNone || piece_of_bundle[b] != ThingsInView::kNone) continue;
      piece_of_bundle[b] = piece_of_bundle[reached[next]];
      reached.push_back(b);
    }
  }
}

/// Points on the background itself stay with the rest.
void KeepBackground(const SegmentBundles& segment, const Submap& background,
                    std::vector<std::uint32_t>& piece_of_bundle) {
  for (const BundleCell& cell : segment.cells) {
    const BlockEntry* entry = background.blocks().Find(cell.block);
    if (entry == nullptr || entry->tsdf == nullptr) continue;
    for (std::uint32_t b = cell.first_bundle; b < cell.first_bundle + cell.num_bundles; ++b) {
      const bool is_open = piece_of_bundle[b] == ThingsInView::kNone;
      if (is_open && entry->tsdf->IsObserved(segment.bundles[b].linear)) piece_of_bundle[b] = 0;
    }
  }
}

/// Pieces with points, the largest first. `hit_by`: see ThingsInView::HitsOf; `background`: that of the segment, or
/// null.
std::vector<SegmentBundles> CutSegment(const SegmentBundles& segment, const std::vector<std::uint32_t>& hit_by,
                                       const std::vector<std::uint32_t>& piece_of, std::uint32_t num_pieces,
                                       const Submap* background) {
  std::vector<std::uint32_t> piece_of_bundle(hit_by.size(), ThingsInView::kNone);
  for (std::size_t b = 0; b < hit_by.size(); ++b) {
    if (hit_by[b] != ThingsInView::kNone) piece_of_bundle[b] = piece_of[hit_by[b]];
  }
  if (background != nullptr) KeepBackground(segment, *background, piece_of_bundle);
  SpreadPieces(segment, piece_of_bundle);
  std::vector<SegmentBundles> pieces(num_pieces);
  for (const BundleCell& cell : segment.cells) {
    for (std::uint32_t b = cell.first_bundle; b < cell.first_bundle + cell.num_bundles; ++b) {
      const Bundle& bundle = segment.bundles[b];
      SegmentBundles& piece = pieces[piece_of_bundle[b] != ThingsInView::kNone ? piece_of_bundle[b] : 0];
      piece.Append(cell.block, bundle);
      piece.row = segment.row;
    }
  }
  std::erase_if(pieces, [](const SegmentBundles& piece) { return piece.bundles.empty(); });
  std::stable_sort(pieces.begin(), pieces.end(),
                   [](const auto& x, const auto& y) { return x.num_points > y.num_points; });
  return pieces;
}

bool IsOfThing(const PanopticFrame& frame, const SegmentBundles& segment, const Map& map) {
  if (segment.row < 0 || segment.is_cut_short) return false;
  const auto& class_id = frame.segments[static_cast<std::size_t>(segment.row)].class_id;
  const LabelClass* label_class = class_id ? map.info().label_set->Find(*class_id) : nullptr;
  return label_class != nullptr && label_class->panoptic == Panoptic::kThing;
}

/// Whether frames may show two separate things in view as one.
bool HasTwo(const ThingsInView& things, bool has_persistent_ids, const Map& map) {
  const auto is_in_view = [&](SubmapId id) {
    const Submap* submap = map.Find(id);
    if (submap != nullptr && submap->info().panoptic == Panoptic::kStuff) return true;  // it may be anywhere
    return std::any_of(things.list().begin(), things.list().end(),
                       [id](const ThingInView& thing) { return thing.submap->id() == id; });
  };
  const auto pairs = map.info().pairs.pairs();
  return std::any_of(pairs.begin(), pairs.end(), [&](const ObjectPair& pair) {
    return AreTwo(pair, has_persistent_ids) && is_in_view(pair.first) && is_in_view(pair.second);
  });
}

}  // namespace

void CutSegmentsAtSplits(const PanopticFrame& frame, const Map& map, ThreadPool& pool,
                         std::vector<SegmentBundles>& segments) {
  const auto pairs = map.info().pairs.pairs();
  const auto are_two = [&frame](const ObjectPair& pair) { return AreTwo(pair, frame.has_persistent_ids); };
  if (std::none_of(pairs.begin(), pairs.end(), are_two)) return;
  const ThingsInView things(frame, map);
  if (!HasTwo(things, frame.has_persistent_ids, map)) return;
  const FrameHits hits(things, segments, pool);
  std::size_t num_cells = 0;
  for (const SegmentBundles& segment : segments) num_cells += segment.cells.size();
  std::vector<SegmentBundles> result;
  result.reserve(segments.size());
  for (std::size_t s = 0; s < segments.size(); ++s) {
    std::uint32_t num_pieces = 1;
    std::vector<std::uint32_t> piece_of;
    const Submap* background = segments[s].is_cut_short ? nullptr : SplitBackgroundOf(frame, segments[s].row, map);
    std::optional<SubmapId> whole;
    if (background != nullptr) whole = background->id();
    else if (IsOfThing(frame, segments[s], map)) whole = WholeOf(frame, segments[s], things, hits.of_segment[s], map);
    if (whole) {
      piece_of = PiecesOf(*whole, frame.has_persistent_ids, things, segments[s].num_points, hits.of_segment[s],
                          hits.of_frame, map, num_pieces);
    }
    const std::size_t most_added = (num_pieces - 1) * segments[s].cells.size();
    if (num_pieces == 1 || num_cells + most_added > kMaxBlocksAFrame) {  // the same limit as for the bundler
      result.push_back(std::move(segments[s]));
      continue;
    }
    num_cells += most_added;
    std::vector<SegmentBundles> pieces = CutSegment(segments[s], hits.hit_by[s], piece_of, num_pieces, background);
    std::move(pieces.begin(), pieces.end(), std::back_inserter(result));
  }
  segments = std::move(result);
}

void HandToSplitParts(const PanopticFrame& frame, const std::vector<SegmentBundles>& segments,
                      const OverlapTable& overlaps, const Map& map, std::vector<Assignment>& assignments) {
  const auto is_of_row = [&segments](std::size_t s, int row) { return s < segments.size() && segments[s].row == row; };
  for (std::size_t begin = 0, end = 0; begin < segments.size(); begin = end) {
    for (end = begin + 1; is_of_row(end, segments[begin].row);) ++end;
    if (segments[begin].row < 0) continue;
    const bool is_of_background = SplitBackgroundOf(frame, segments[begin].row, map) != nullptr;
    const bool is_whole = end == begin + 1;  // then the thing below must be unambiguous
    const std::vector<Assignment> of_row(assignments.begin() + static_cast<std::ptrdiff_t>(begin),
                                         assignments.begin() + static_cast<std::ptrdiff_t>(end));
    for (std::size_t s = begin; s < end; ++s) {
      const auto most = std::max_element(overlaps.hits[s].begin(), overlaps.hits[s].end());
      if (most == overlaps.hits[s].end() || *most == 0) continue;
      if (is_whole && 2 * *most <= segments[s].num_points) continue;
      if (is_of_background && kLeastShareOfPiece * *most <= segments[s].num_points) continue;
      const auto c = static_cast<std::size_t>(most - overlaps.hits[s].begin());
      if (!IsOnGridOf(map, overlaps.candidates[c])) continue;  // it would get the other parts, too
      const bool was_split = std::any_of(of_row.begin(), of_row.end(), [&](const Assignment& whole) {
        return whole.submap != kUnknownSubmap &&
               AreTwo(map.info().pairs.Of(whole.submap, overlaps.candidates[c]), frame.has_persistent_ids);
      });
      if (!was_split) continue;
      assignments[s] = {overlaps.candidates[c], false, static_cast<float>(overlaps.Iou(s, c, segments[s].num_points))};
    }
  }
}

bool HasSplitBackground(const Map& map) {
  const auto pairs = map.info().pairs.pairs();
  const auto is_stuff = [&map](SubmapId id) {
    const Submap* submap = map.Find(id);
    return submap != nullptr && submap->info().panoptic == Panoptic::kStuff;
  };
  return std::any_of(pairs.begin(), pairs.end(), [&](const ObjectPair& pair) {
    return pair.verdict == PairVerdict::kMustBeTwo && (is_stuff(pair.first) || is_stuff(pair.second));
  });
}

}  // namespace dhpmap

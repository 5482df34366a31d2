// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/fusion/segment_parts.h"

#include <algorithm>
#include <numeric>
#include <optional>
#include <utility>

#include "mapping/base/index_map.h"
#include "mapping/fusion/band_size.h"

namespace dhpmap {
namespace {

/// Disjoint sets of coarse cells.
class Islands {
 public:
  std::uint32_t Add() {
    parent_.push_back(static_cast<std::uint32_t>(parent_.size()));
    return parent_.back();
  }
  std::uint32_t RootOf(std::uint32_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  /// Keeps the older root, so roots are numbered in the order of the bundles.
  void Join(std::uint32_t a, std::uint32_t b) {
    a = RootOf(a), b = RootOf(b);
    parent_[std::max(a, b)] = std::min(a, b);
  }

 private:
  std::vector<std::uint32_t> parent_;
};

constexpr std::int32_t FloorDiv(std::int32_t a, std::int32_t b) { return (a >= 0 ? a : a - b + 1) / b; }

/// The part of each bundle. Parts are numbered in the order of their first bundles.
std::vector<std::uint32_t> FindParts(const SegmentBundles& segment, int gap_vox, std::uint32_t& num_parts) {
  constexpr std::uint32_t kNone = IndexMap<BlockIndex>::kNone, kNoPart = kNone;
  IndexMap<BlockIndex> numbers;   // of cells of gap_vox voxels
  std::vector<BlockIndex> cells;  // by number
  Islands islands;                // likewise
  std::vector<std::uint32_t> cell_of(segment.bundles.size());
  for (const BundleCell& cell : segment.cells) {
    for (std::uint32_t b = cell.first_bundle; b < cell.first_bundle + cell.num_bundles; ++b) {
      const VoxelIndex v = VoxelIn(cell.block, segment.bundles[b].linear);
      const BlockIndex coarse{FloorDiv(v.x, gap_vox), FloorDiv(v.y, gap_vox), FloorDiv(v.z, gap_vox)};
      std::uint32_t number = numbers.Find(coarse);
      if (number == kNone) {
        number = islands.Add();
        numbers.Set(coarse, number);
        cells.push_back(coarse);
      }
      cell_of[b] = number;
    }
  }
  for (std::uint32_t number = 0; number < cells.size(); ++number) {
    const BlockIndex c = cells[number];
    for (int n = 14; n < 27; ++n) {  // half of the neighbours: the others find this one
      const std::uint32_t other = numbers.Find({c.x + n % 3 - 1, c.y + n / 3 % 3 - 1, c.z + n / 9 - 1});
      if (other != kNone) islands.Join(number, other);
    }
  }
  num_parts = 0;
  std::vector<std::uint32_t> part_of_root(cells.size(), kNoPart);
  for (std::uint32_t& cell : cell_of) {
    std::uint32_t& part = part_of_root[islands.RootOf(cell)];
    if (part == kNoPart) part = num_parts++;
    cell = part;
  }
  return cell_of;
}

/// Nothing if the parts need more cells than `cells_left`, which it decreases. Every part has at least one cell.
std::optional<std::vector<SegmentBundles>> Cut(const SegmentBundles& segment, const std::vector<std::uint32_t>& part_of,
                                               std::uint32_t num_parts, std::size_t& cells_left) {
  if (num_parts > cells_left) return std::nullopt;
  std::vector<SegmentBundles> parts(num_parts);
  for (const BundleCell& cell : segment.cells) {
    for (std::uint32_t b = cell.first_bundle; b < cell.first_bundle + cell.num_bundles; ++b) {
      SegmentBundles& part = parts[part_of[b]];
      if (part.Append(cell.block, segment.bundles[b]) && cells_left-- == 0) return std::nullopt;
      part.row = segment.row;
    }
  }
  std::stable_sort(parts.begin(), parts.end(),
                   [](const auto& a, const auto& b) { return a.num_points > b.num_points; });
  return parts;
}

/// Nothing if the parts have too many cells.
std::optional<std::vector<SegmentBundles>> AllParts(const std::vector<bool>& may_split, int gap_vox,
                                                    std::vector<SegmentBundles>& segments) {
  std::vector<SegmentBundles> result;
  result.reserve(segments.size());
  std::size_t cells_left = kMaxBlocksAFrame;
  for (SegmentBundles& segment : segments) {
    if (segment.is_cut_short) return std::nullopt;
    std::uint32_t num_parts = 1;
    std::vector<std::uint32_t> part_of;
    if (segment.row >= 0 && may_split[static_cast<std::size_t>(segment.row)]) {
      part_of = FindParts(segment, gap_vox, num_parts);
    }
    if (num_parts == 1) {
      if (segment.cells.size() > cells_left) return std::nullopt;
      cells_left -= segment.cells.size();
      result.push_back(std::move(segment));
      continue;
    }
    auto parts = Cut(segment, part_of, num_parts, cells_left);
    if (!parts) return std::nullopt;
    for (SegmentBundles& part : *parts) result.push_back(std::move(part));
  }
  return result;
}

}  // namespace

void SplitIntoParts(const std::vector<bool>& may_split, int gap_vox, std::vector<SegmentBundles>& segments) {
  auto parts = AllParts(may_split, gap_vox, segments);
  segments = parts ? *std::move(parts) : CutShortSegments(may_split.size());
}

}  // namespace dhpmap

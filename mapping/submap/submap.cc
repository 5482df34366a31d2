// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/submap/submap.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

namespace dhpmap {
namespace {

/// The layer to write to: the present one if this writer made it, else a private copy or a new one. Not made by
/// make_shared: StateMarks would keep its memory.
template <typename Layer>
Layer& Own(std::shared_ptr<const Layer>& layer, bool& is_owned) {
  if (layer == nullptr) {
    layer = std::shared_ptr<const Layer>(new Layer());
  } else if (!is_owned) {
    layer = std::shared_ptr<const Layer>(new Layer(*layer));
  }
  is_owned = true;
  return const_cast<Layer&>(*layer);  // nobody else holds it
}

/// Calls visit(BlockIndex) for the blocks of a tile, and reads none.
template <typename Visitor>
void VisitBlocks(const TileEntry& tile, Visitor&& visit) {
  for (std::uint64_t left = tile.tile->cells(); left != 0; left &= left - 1) {
    visit(BlockIn(tile.index, std::countr_zero(left)));
  }
}

bool HasLabels(const LabelBlock* labels) {
  for (int linear = 0; labels != nullptr && linear < kBlockVoxels; ++linear) {
    if (!labels->IsEmpty(linear)) return true;
  }
  return false;
}

}  // namespace

BoundingSphere Submap::BoundingSphereInMap() const { return {info_.T_map_submap * sphere_.center_m, sphere_.radius_m}; }

TsdfBlock& Submap::MutableTsdf(BlockIndex index) {
  BlockEntry& entry = WritableBlocks().FindOrInsert(index, generation_);
  return Own(entry.tsdf, entry.owns_tsdf);
}

LabelBlock& Submap::MutableLabels(BlockIndex index) {
  BlockEntry& entry = blocks_.FindOrInsert(index, generation_);
  return Own(entry.labels, entry.owns_labels);
}

GoneBlock& Submap::MutableGone(BlockIndex index) {
  BlockEntry& entry = WritableBlocks().FindOrInsert(index, generation_);
  return Own(entry.gone, entry.owns_gone);
}

BlockInPlace Submap::BlockInPlace(BlockIndex index, bool with_labels, bool in_place) {
  dhpmap::BlockInPlace block;
  BlockTable& blocks = WritableBlocks();
  const auto [own, is_forked] = in_place ? blocks.FindOwn(index, generation_) : BlockTable::OwnEntry();
  if (own != nullptr && own->tsdf != nullptr && (own->owns_tsdf || own->owned_tsdf)) {
    block.notes_tsdf = is_forked || !own->owns_tsdf;
    block.tsdf = const_cast<TsdfBlock*>(own->tsdf.get());  // nobody else holds it but a fork
  }
  if (with_labels && own != nullptr && own->labels != nullptr && (own->owns_labels || own->owned_labels)) {
    block.notes_labels = is_forked || !own->owns_labels;
    block.labels = const_cast<LabelBlock*>(own->labels.get());
  }
  if (block.tsdf != nullptr && (block.labels != nullptr || !with_labels)) {
    block.gone = own->gone.get();
    return block;
  }
  BlockEntry& entry = blocks.FindOrInsert(index, generation_);
  if (block.tsdf == nullptr) block.tsdf = &Own(entry.tsdf, entry.owns_tsdf);
  if (with_labels && block.labels == nullptr) block.labels = &Own(entry.labels, entry.owns_labels);
  block.gone = entry.gone.get();
  return block;
}

void Submap::PutBlock(BlockIndex index, std::shared_ptr<const TsdfBlock> tsdf,
                      std::shared_ptr<const LabelBlock> labels) {
  BlockEntry& entry = WritableBlocks().FindOrInsert(index, generation_);
  entry.tsdf = std::move(tsdf);
  entry.labels = std::move(labels);
  entry.owns_tsdf = entry.owns_labels = entry.owned_tsdf = entry.owned_labels = false;
}

void Submap::PutGone(BlockIndex index, std::shared_ptr<const GoneBlock> gone) {
  BlockEntry& entry = WritableBlocks().FindOrInsert(index, generation_);
  entry.gone = std::move(gone);
  entry.owns_gone = false;
}

void Submap::AddLayers(const BlockEntry& block) {
  BlockEntry& entry = WritableBlocks().FindOrInsert(block.index, generation_);
  ForEachLayer(
      [](BlockLayer, const auto& given, auto& layer) {
        if (given != nullptr) layer = given;
      },
      block, entry);
  if (block.tsdf != nullptr) entry.owns_tsdf = entry.owned_tsdf = false;
  if (block.labels != nullptr) entry.owns_labels = entry.owned_labels = false;
  if (block.gone != nullptr) entry.owns_gone = false;
}

void Submap::DropGone() {
  std::vector<BlockIndex> marked;
  for (const TileEntry& tile : blocks_.tiles()) {
    std::uint64_t left = tile.tile->CellsWith(BlockLayer::kGone);  // reads none
    for (; left != 0; left &= left - 1) marked.push_back(BlockIn(tile.index, std::countr_zero(left)));
  }
  for (const BlockIndex index : marked) PutGone(index, nullptr);
}

int Submap::PruneBlocks() {
  std::vector<BlockIndex> empty;
  for (const BlockEntry& entry : blocks_.entries()) {
    const bool is_observed = entry.tsdf != nullptr && entry.tsdf->HasObservedVoxel();
    if (!is_observed && !HasLabels(entry.labels.get())) empty.push_back(entry.index);
  }
  for (const BlockIndex index : empty) WritableBlocks().Erase(index, generation_);
  return static_cast<int>(empty.size());
}

void Submap::DropLabels() {
  blocks_.ForEachMutable(generation_, [](BlockEntry& entry) { entry.labels = nullptr; });
}

std::shared_ptr<const Submap> Submap::WithTiles(const OtherTile& other) const {
  auto same = std::make_shared<Submap>(*this);
  if (!same->blocks_.Replace(other)) return nullptr;
  same->part_id_.Restore(part_id_.value());
  return same;
}

void Submap::UpdateBoundingSphere() {
  sphere_ = {};
  if (blocks_.empty()) return;
  constexpr auto kMax = std::numeric_limits<std::int32_t>::max();
  Eigen::Array3i low(kMax, kMax, kMax), high(-kMax, -kMax, -kMax);
  for (const TileEntry& tile : blocks_.tiles()) {
    const Eigen::Array3i tile_low = Eigen::Array3i(tile.index.x, tile.index.y, tile.index.z) * kTileSide;
    if ((tile_low >= low).all() && (tile_low + kTileSide <= high).all()) continue;  // adds nothing to the box
    VisitBlocks(tile, [&](BlockIndex index) {
      const Eigen::Array3i corner(index.x, index.y, index.z);
      low = low.min(corner);
      high = high.max(corner + 1);
    });
  }
  // In block units; the farthest corner of a cube from c is |its centre - c| + half a side along each axis.
  const Eigen::Array3d center = (low.cast<double>() + high.cast<double>()) / 2;
  const auto farthest_squared = [&center](const auto& index, double side) {
    const Eigen::Array3d cube_center = (Eigen::Array3d(index.x, index.y, index.z) + 0.5) * side;
    return ((cube_center - center).abs() + 0.5 * side).square().sum();
  };
  double radius_squared = 0;
  for (const TileEntry& tile : blocks_.tiles()) {
    if (farthest_squared(tile.index, kTileSide) <= radius_squared) continue;  // nor does any block in it reach farther
    VisitBlocks(tile,
                [&](BlockIndex index) { radius_squared = std::max(radius_squared, farthest_squared(index, 1.0)); });
  }
  const double side_m = kBlockSide * info_.voxel_size_m;
  sphere_ = {center.matrix() * side_m, std::sqrt(radius_squared) * side_m};
}

void Submap::AddClassObservations(ClassId c, std::uint64_t count) {
  std::vector<ClassTotal>& totals = info_.class_counts;
  auto it = std::lower_bound(totals.begin(), totals.end(), c,
                             [](const ClassTotal& entry, ClassId wanted) { return entry.id < wanted; });
  if (it == totals.end() || it->id != c) it = totals.insert(it, {c, 0});
  it->count += count;
  if (info_.class_is_fixed || info_.panoptic == Panoptic::kStuff) return;
  const auto best = std::max_element(totals.begin(), totals.end(),
                                     [](const ClassTotal& x, const ClassTotal& y) { return x.count < y.count; });
  info_.class_id = best->id;
}

}  // namespace dhpmap

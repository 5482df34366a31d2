// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/space/gone_finder.h"

#include <cmath>

#include "mapping/map/region.h"
#include "mapping/paging/read_tiles.h"
#include "mapping/voxels/voxel_mask.h"

namespace dhpmap {
namespace {

/// A tile without any count is tested in one of this many frames: most of a map stays as it is.
constexpr std::uint64_t kTurns = 3;

/// A departure longer ago than this is unrelated to what is there now.
constexpr std::uint64_t kLeavesFor_ns = 60'000'000'000;

/// Correct even if the stamps are as far apart as possible.
bool IsWithin(std::uint64_t most_ns, std::int64_t a_ns, std::int64_t b_ns) {
  const auto a = static_cast<std::uint64_t>(a_ns), b = static_cast<std::uint64_t>(b_ns);
  return (a_ns > b_ns ? a - b : b - a) <= most_ns;
}

/// Whether any part of the sphere, of a submap on the map's grid, lies within a box around the sensor.
bool MayReach(const Box& reach, const GridOrigin& origin, const BoundingSphere& sphere, double voxel_size_m) {
  if (sphere.IsEmpty()) return false;
  const Eigen::Vector3d eye_vox = Eigen::Vector3d(origin.voxel.x, origin.voxel.y, origin.voxel.z) + origin.offset_vox;
  const Eigen::Array3d center_vox = (sphere.center_m / voxel_size_m - eye_vox).array();
  const double radius_vox = sphere.radius_m / voxel_size_m + 1;
  // In this form NaN, from an absurd focal length, counts as within.
  return !(center_vox + radius_vox < reach.least_vox.array()).any() &&
         !(center_vox - radius_vox > reach.most_vox.array()).any();
}

/// Digit sum in base kTurns. Its remainders differ among kTurns consecutive frames that start at a multiple of kTurns.
/// If several sensors send in turn, each sensor's frames also get all remainders in the long run.
std::uint64_t DigitSum(std::uint64_t number) {
  std::uint64_t sum = 0;
  for (; number > 0; number /= kTurns) sum += number % kTurns;
  return sum;
}

/// `turn` is the frame's. Neighbouring tiles have different turns.
bool IsItsTurn(TileIndex tile, std::uint64_t turn) {
  constexpr auto kMost = static_cast<std::int64_t>(kTurns);
  const std::int64_t place = (std::int64_t{tile.x} + tile.y + tile.z) % kMost + kMost;  // positive
  return (static_cast<std::uint64_t>(place) + turn) % kTurns == 0;
}

bool HasCounts(const BlockTile& tile) {
  if (!tile.IsRead()) return tile.CellsWith(BlockLayer::kGone) != 0;  // known without reading
  return std::any_of(tile.entries().begin(), tile.entries().end(),
                     [](const BlockEntry& entry) { return entry.gone != nullptr; });
}

/// Removes the submap's voxels in the region from a block.
void LeaveOutRegion(const Region& region, const SubmapInfo& info, ContradictedBlock& block) {
  const double half_m = 0.5 * kBlockSide * info.voxel_size_m;
  const Eigen::Vector3d center_m = BlockCorner(block.index, info.voxel_size_m).array() + half_m;
  if (!Touches(region, info.T_map_submap * center_m, std::sqrt(3.0) * half_m)) return;
  for (int i = 0; i < kBlockVoxels; ++i) {
    if (!IsIn(block.voxels, i)) continue;
    if (!Contains(region, info.T_map_submap * VoxelCentre(VoxelIn(block.index, i), info.voxel_size_m))) continue;
    SetIn(block.voxels, i, false);
    --block.num_voxels;
    --block.num_in_all;
  }
}

}  // namespace

void GoneFinder::LeaveOutKeptClear(const KeptClear& kept_clear, const SubmapInfo& info,
                                   std::vector<ContradictedBlock>& found) {
  for (const KeptClearRegion& region : kept_clear.list()) {
    for (ContradictedBlock& block : found) {
      if (block.num_voxels > 0) LeaveOutRegion(region.region, info, block);
    }
  }
}

void GoneFinder::AddJob(const Submap& submap, const TileEntry& entry, Role role, std::uint64_t turn) {
  const BlockTile& tile = *entry.tile;
  const bool has_counts = HasCounts(tile);
  if (role == Role::kStays && !has_counts && !IsItsTurn(entry.index, turn)) return;
  if (num_jobs_ == jobs_.size()) jobs_.emplace_back();
  jobs_[num_jobs_].id = submap.id();
  jobs_[num_jobs_].submap = &submap;
  jobs_[num_jobs_].tile = &tile;
  jobs_[num_jobs_].has_counts = has_counts;
  jobs_[num_jobs_].role = role;
  ++num_jobs_;
}

void GoneFinder::AddJobs(const Submap& submap, Role role, std::uint64_t turn) {
  const BlockTable& blocks = submap.blocks();
  if (blocks.tiles().size() <= tiles_.size()) {
    for (const TileEntry& entry : blocks.tiles()) {
      if (in_view_.Find(entry.index) != IndexMap<TileIndex>::kNone) AddJob(submap, entry, role, turn);
    }
  } else {  // a wall may be very long
    for (const TileToLook& tile : tiles_) {
      if (const TileEntry* entry = blocks.FindTile(tile.index)) AddJob(submap, *entry, role, turn);
    }
  }
}

void GoneFinder::ListJobs(const Box& reach, const GridOrigin& origin, const Viewpoint& from, const Map& map) {
  num_jobs_ = 0;
  in_view_ = {};
  in_view_.Reserve(tiles_.size());
  for (std::size_t i = 0; i < tiles_.size(); ++i) in_view_.Set(tiles_[i].index, static_cast<std::uint32_t>(i));
  const auto is_looked_at = [&](const Submap& submap) {
    const SubmapInfo& info = submap.info();
    return !info.is_placed && !info.is_locked && IsOnMapGrid(info, map.info().config) &&
           MayReach(reach, origin, submap.bounding_sphere(), info.voxel_size_m);
  };
  const std::uint64_t turn = DigitSum(static_cast<std::uint64_t>(map.info().num_frames));
  const Submap* unknown = nullptr;
  for (const auto& submap : map.submaps()) {
    if (!is_looked_at(*submap)) continue;
    const SubmapInfo& info = submap->info();
    if (info.panoptic == Panoptic::kUnknown) {
      unknown = submap.get();
      continue;
    }
    const bool may_have_left = info.panoptic == Panoptic::kThing && info.last_observed_ns != from.stamp_ns;
    AddJobs(*submap, may_have_left ? Role::kMayHaveLeft : Role::kStays, turn);
  }
  if (unknown != nullptr) AddJobs(*unknown, Role::kNameless, turn);  // after the tiles of all things are known
}

void GoneFinder::NoteLeft(const Viewpoint& from, ThreadPool& pool, const std::stop_token& stop) {
  left_.Clear();
  std::vector<const BlockTile*> unread;
  for (std::size_t i = 0; i < num_jobs_; ++i) {
    if (jobs_[i].has_counts && !jobs_[i].tile->IsRead()) unread.push_back(jobs_[i].tile);
  }
  ReadTiles(
      unread, [&pool](std::size_t count, const auto& body) { pool.ParallelFor(count, body); }, stop);
  ThrowIfStopped(stop);
  for (std::size_t i = 0; i < num_jobs_; ++i) {
    if (!jobs_[i].has_counts) continue;
    for (const BlockEntry& entry : jobs_[i].tile->entries()) {
      if (entry.gone == nullptr || !IsWithin(kLeavesFor_ns, from.stamp_ns, entry.gone->last().stamp_ns)) continue;
      left_.Add(entry.index, NumIn(entry.gone->Contradicted()));
    }
  }
}

void GoneFinder::AddUp() {
  together_.Clear();
  leaving_.Clear();
  for (std::size_t i = 0; i < num_jobs_; ++i) {
    for (const ContradictedBlock& block : jobs_[i].found) {
      together_.Add(block.index, block.num_in_all);
      // A block that was looked through before no longer affects its neighbours.
      if (jobs_[i].role == Role::kMayHaveLeft) leaving_.Add(block.index, block.num_voxels);
    }
  }
}

bool GoneFinder::IsByWhatLeaves(BlockIndex block) const {
  for (int n = 0; n < 27; ++n) {
    if (leaving_.CountIn({block.x + n % 3 - 1, block.y + n / 3 % 3 - 1, block.z + n / 9 - 1}) >= kLeastVoxels)
      return true;
  }
  return false;
}

bool GoneFinder::IsEnough(const ContradictedBlock& block) const {
  if (block.num_voxels >= kLeastVoxels) return true;
  return block.num_voxels > 0 && together_.CountIn(block.index) >= kLeastTogether;
}

std::vector<SubmapId> GoneFinder::Count(const Viewpoint& from, Map& map) {
  AddUp();
  std::vector<SubmapId> changed;
  for (std::size_t i = 0; i < num_jobs_; ++i) {
    std::erase_if(jobs_[i].found, [&](const ContradictedBlock& block) { return !IsEnough(block); });
    if (jobs_[i].found.empty()) continue;
    Submap& submap = *map.FindMutable(jobs_[i].id);
    int num_became = 0;
    for (const ContradictedBlock& block : jobs_[i].found) {
      const bool counts_twice = block.is_much || (jobs_[i].role == Role::kNameless && IsByWhatLeaves(block.index));
      for (int n = counts_twice ? 2 : 1; n > 0; --n) {
        num_became += submap.MutableGone(block.index).Raise(block.voxels, from);
      }
    }
    if (num_became > 0) submap.mutable_info().last_contradicted_ns = from.stamp_ns;
    if (changed.empty() || changed.back() != submap.id()) changed.push_back(submap.id());
  }
  std::sort(changed.begin(), changed.end());  // the unknown submap's jobs come last
  return changed;
}

}  // namespace dhpmap

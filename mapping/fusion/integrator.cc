// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/fusion/integrator.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <new>

#include "mapping/base/stopped.h"
#include "mapping/fusion/grazed_columns.h"
#include "mapping/fusion/ray_kernel.h"
#include "mapping/fusion/ray_neighbourhood.h"
#include "mapping/voxels/voxel_average.h"

namespace dhpmap {
namespace {

struct UpdateRule {
  float truncation_m;
  float dropoff_start_m;  ///< behind the surface, where the weight starts to fall; the truncation if it does not
  float fade_per_m;       ///< slope of the weight from there on; 0 if it does not fall but ends
  float max_weight;
};

/// Adds an observation to the voxel's average. Returns false if its weight is 0. `journal` belongs to `here`.
bool UpdateVoxel(float sdf_m, float weight, const Eigen::Vector3f& color, const UpdateRule& rule, const Neighbour& here,
                 std::size_t i, VoxelJournal* journal) {
  TsdfBlock& block = *here.tsdf;
  if (-sdf_m > rule.dropoff_start_m) {
    weight *= (rule.truncation_m + sdf_m) * rule.fade_per_m;
  }
  const float old_weight = block.weight[i];
  const float sum = old_weight + weight;
  if (weight <= 0.0f || sum < kMinObservedWeight) return false;
  if (here.tsdf_number != VoxelJournal::kNoNotes) journal->Note(here.tsdf_number, i, block);
  const RunningAverage average(old_weight, weight);
  // Each observation is clamped before averaging, so that the average does not depend on their order; the average is
  // clamped again because rounding may push it out of the band.
  const float clamped_m = std::clamp(sdf_m, -rule.truncation_m, rule.truncation_m);
  block.distance_m[i] = std::clamp(average(block.distance_m[i], clamped_m), -rule.truncation_m, rule.truncation_m);
  if (std::abs(sdf_m) < rule.truncation_m) {
    Color& c = block.color[i];
    c = {average.Channel(c.r, color.x()), average.Channel(c.g, color.y()), average.Channel(c.b, color.z())};
  }
  block.weight[i] = std::min(sum, rule.max_weight);
  return true;
}

/// The same for a voxel with a gone count, which is reset. If the voxel was contradicted, something new is there, so
/// the old average is dropped.
bool ObserveAnew(float sdf_m, float weight, const Eigen::Vector3f& color, const UpdateRule& rule, BlockIndex block,
                 std::size_t i, Neighbour& here, Submap& submap, VoxelJournal* journal) {
  const auto linear = static_cast<int>(i);
  const float before = here.tsdf->weight[i];
  if (here.gone->IsContradicted(linear)) {
    if (here.tsdf_number != VoxelJournal::kNoNotes) journal->Note(here.tsdf_number, i, *here.tsdf);
    here.tsdf->weight[i] = 0;
  }
  if (!UpdateVoxel(sdf_m, weight, color, rule, here, i, journal)) {
    here.tsdf->weight[i] = before;
    return false;
  }
  GoneBlock& gone = submap.MutableGone(block);
  gone.Forget(linear);
  here.gone = &gone;
  if (gone.empty()) {
    submap.PutGone(block, nullptr);
    here.gone = nullptr;
  }
  return true;
}

UpdateRule MakeRule(const IntegrationConfig& config, const Submap& submap) {
  const auto truncation_m = static_cast<float>(submap.info().truncation_m);
  const auto voxel_size_m = static_cast<float>(submap.info().voxel_size_m);
  const bool fades = config.weight_dropoff && truncation_m > voxel_size_m * 1.001f;
  const float dropoff_start_m = fades ? voxel_size_m : truncation_m;
  const float fade_per_m = fades ? 1 / (truncation_m - dropoff_start_m) : 0.0f;
  return {truncation_m, dropoff_start_m, fade_per_m, static_cast<float>(config.max_weight)};
}

void FillLane(const Bundle& bundle, BlockIndex block, const RayOrigin& origin, std::size_t lane, RayLanes& rays) {
  rays.sum_x_m[lane] = bundle.weighted_sum_m.x(), rays.sum_y_m[lane] = bundle.weighted_sum_m.y();
  rays.sum_z_m[lane] = bundle.weighted_sum_m.z(), rays.weight[lane] = bundle.weight;
  rays.normal_x[lane] = bundle.plane.normal.x(), rays.normal_y[lane] = bundle.plane.normal.y();
  rays.normal_z[lane] = bundle.plane.normal.z(), rays.offset_m[lane] = bundle.plane.offset_m;
  rays.before_m[lane] = bundle.plane.before_m, rays.behind_m[lane] = bundle.plane.behind_m;
  const VoxelIndex first = VoxelIn({block.x - 1, block.y - 1, block.z - 1}, 0);
  rays.from_corner_x[lane] = origin.voxel.x - first.x, rays.from_corner_y[lane] = origin.voxel.y - first.y;
  rays.from_corner_z[lane] = origin.voxel.z - first.z;
}

/// Updates one submap with the bundles of one segment.
class SegmentUpdate {
 public:
  SegmentUpdate(const SegmentBundles& segment, std::optional<ClassId> label, const IntegrationConfig& config,
                Submap& submap, KeptClearVoxels* kept_clear, VoxelJournal* journal)
      : label_(label),
        anti_grazing_(config.anti_grazing),
        rule_(MakeRule(config, submap)),
        voxel_size_m_(static_cast<float>(submap.info().voxel_size_m)),
        submap_(submap),
        journal_(journal),
        neighbourhood_(segment, label.has_value(), submap, kept_clear, journal) {}

  /// Throws Stopped.
  void AddAll(const SegmentBundles& segment, const RayOrigin& origin, const std::stop_token& stop) {
    grid_ = {voxel_size_m_, rule_.truncation_m, origin.offset_vox.x(), origin.offset_vox.y(), origin.offset_vox.z()};
    std::size_t num = 0;
    for (const BundleCell& cell : segment.cells) {
      for (std::uint32_t b = cell.first_bundle; b < cell.first_bundle + cell.num_bundles; ++b) {
        ends_[num] = {&cell, &segment.bundles[b]};
        FillLane(segment.bundles[b], cell.block, origin, num, rays_);
        if (++num < kRayLanes) continue;
        AddRays(num, stop);
        num = 0;
      }
    }
    if (num == 0) return;
    for (std::size_t lane = num; lane < kRayLanes; ++lane) {
      FillLane(*ends_[0].bundle, ends_[0].cell->block, origin, lane, rays_);
    }
    AddRays(num, stop);
  }

  [[nodiscard]] std::int64_t num_updates() const { return num_updates_; }
  [[nodiscard]] std::uint64_t num_labelled() const { return num_labelled_; }

 private:
  /// The ray of a lane.
  struct End {
    const BundleCell* cell = nullptr;
    const Bundle* bundle = nullptr;
  };

  void AddRays(std::size_t num, const std::stop_token& stop) {
    ThrowIfStopped(stop);
    WalkRays(grid_, rays_, walked_);
    if (journal_ != nullptr) journal_->Reserve(kRayLanes * WalkedVoxels::kMostSteps);
    for (std::size_t lane = 0; lane < num; ++lane) {
      if (ends_[lane].cell != cell_) {
        cell_ = ends_[lane].cell;
        neighbourhood_.MoveTo(cell_->block);
      }
      AddRay(*ends_[lane].bundle, lane);
    }
  }

  void AddRay(const Bundle& bundle, std::size_t lane) {
    const Eigen::Vector3f color = bundle.weighted_color / bundle.weight;
    const int end = RayNeighbourhood::kCenter * kBlockVoxels + bundle.linear;
    const auto num_steps = static_cast<std::size_t>(walked_.num_steps[lane]);
    for (std::size_t step = 0; step < num_steps; ++step) {
      const std::int32_t code = walked_.voxel[step][lane];
      if (code == WalkedVoxels::kNone) continue;
      const int voxel = code & (WalkedVoxels::kLabelled - 1), linear = voxel % kBlockVoxels;
      Neighbour& here = neighbourhood_.At(voxel / kBlockVoxels);
      if (here.clear != nullptr && IsIn(*here.clear, linear)) continue;
      if (anti_grazing_ && here.ends != nullptr && voxel != end && IsIn(here.ends->ends, linear)) continue;
      if (!Update(walked_.distance_m[step][lane], bundle.weight, color, voxel, here)) continue;
      ++num_updates_;
      if (!label_ || (code & WalkedVoxels::kLabelled) == 0) continue;
      AddLabel(voxel, here);
      ++num_labelled_;
    }
    const Eigen::Vector3f end_m = bundle.weighted_sum_m / bundle.weight;
    if (GrazedColumns::AreNeeded(bundle.plane, end_m.normalized())) AddColumns(bundle, end_m, color, lane);
  }

  void AddLabel(int voxel, Neighbour& here) {
    const int linear = voxel % kBlockVoxels;
    if (!here.labels->AddInPlace(linear, *label_)) return AddNewLabel(voxel, here);
    if (here.labels_number != VoxelJournal::kNoNotes) journal_->NoteLabel(here.labels_number, linear);
  }

  /// Rare: a label that is new to the voxel. It may change the layout of the whole block, which a rollback keeps.
  [[gnu::noinline]] void AddNewLabel(int voxel, Neighbour& here) {
    here.labels = &submap_.MutableLabels(neighbourhood_.IndexOf(voxel / kBlockVoxels));
    here.labels_number = VoxelJournal::kNoNotes;
    here.labels->AddObservation(voxel % kBlockVoxels, *label_);
  }

  /// Updates those voxels of the columns that the ray has not crossed. Writes no labels, as in the band beyond the
  /// truncation.
  [[gnu::noinline]] void AddColumns(const Bundle& bundle, const Eigen::Vector3f& end_m, const Eigen::Vector3f& color,
                                    std::size_t lane) {
    constexpr int kSideAround = 3 * kBlockSide;
    const Eigen::Vector3f offset_vox(grid_.offset_x_vox, grid_.offset_y_vox, grid_.offset_z_vox);
    for (const GrazedColumns::Voxel& v : GrazedColumns(bundle.plane, end_m, offset_vox, voxel_size_m_)) {
      const VoxelIndex at{v.offset.x + rays_.from_corner_x[lane], v.offset.y + rays_.from_corner_y[lane],
                          v.offset.z + rays_.from_corner_z[lane]};
      if (std::min({at.x, at.y, at.z}) < 0 || std::max({at.x, at.y, at.z}) >= kSideAround) continue;
      const BlockIndex block = BlockOf(at);
      const int linear = LinearIndex(at), voxel = (block.x + 3 * (block.y + 3 * block.z)) * kBlockVoxels + linear;
      if (IsCrossed(voxel, lane)) continue;
      Neighbour& here = neighbourhood_.At(voxel / kBlockVoxels);
      if (here.clear != nullptr && IsIn(*here.clear, linear)) continue;
      if (anti_grazing_ && here.ends != nullptr && IsIn(here.ends->ends, linear)) continue;
      if (journal_ != nullptr) journal_->Reserve(1);
      if (Update(v.distance_m, bundle.weight, color, voxel, here)) ++num_updates_;
    }
  }

  [[nodiscard]] bool IsCrossed(int voxel, std::size_t lane) const {
    for (std::size_t step = 0; step < static_cast<std::size_t>(walked_.num_steps[lane]); ++step) {
      const std::int32_t code = walked_.voxel[step][lane];
      if (code != WalkedVoxels::kNone && (code & (WalkedVoxels::kLabelled - 1)) == voxel) return true;
    }
    return false;
  }

  bool Update(float sdf_m, float weight, const Eigen::Vector3f& color, int voxel, Neighbour& here) {
    const int linear = voxel % kBlockVoxels;
    if (here.gone != nullptr && here.gone->Count(linear) != 0) {
      const BlockIndex block = neighbourhood_.IndexOf(voxel / kBlockVoxels);
      return ObserveAnew(sdf_m, weight, color, rule_, block, static_cast<std::size_t>(linear), here, submap_, journal_);
    }
    return UpdateVoxel(sdf_m, weight, color, rule_, here, static_cast<std::size_t>(linear), journal_);
  }

  const std::optional<ClassId> label_;
  const bool anti_grazing_;
  const UpdateRule rule_;
  const float voxel_size_m_;
  Submap& submap_;
  VoxelJournal* journal_;
  RayNeighbourhood neighbourhood_;
  const BundleCell* cell_ = nullptr;  ///< the centre of the neighbourhood
  std::array<End, kRayLanes> ends_;
  RayGrid grid_{};
  RayLanes rays_;
  WalkedVoxels walked_;
  std::int64_t num_updates_ = 0;
  std::uint64_t num_labelled_ = 0;
};

}  // namespace

RayOrigin::RayOrigin(const Eigen::Vector3d& p_grid_m, double voxel_size_m)
    : voxel(VoxelAt(p_grid_m, voxel_size_m)),
      offset_vox((p_grid_m / voxel_size_m - Eigen::Vector3d(voxel.x, voxel.y, voxel.z)).cast<float>()) {}

std::int64_t IntegrateSegment(const SegmentBundles& segment, const RayOrigin& origin, std::optional<ClassId> label,
                              const IntegrationConfig& config, Submap& submap, const std::stop_token& stop,
                              KeptClearVoxels* kept_clear, VoxelJournal* journal) {
  if (segment.is_cut_short) throw std::bad_alloc();  // it did not fit into memory: the frame fails as a whole
  SegmentUpdate update(segment, label, config, submap, kept_clear, journal);
  update.AddAll(segment, origin, stop);
  if (update.num_labelled() != 0) submap.AddClassObservations(*label, update.num_labelled());
  return update.num_updates();
}

}  // namespace dhpmap

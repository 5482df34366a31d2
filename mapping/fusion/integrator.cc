// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/fusion/integrator.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <new>

#include "mapping/base/stopped.h"
#include "mapping/fusion/grazed_columns.h"
#include "mapping/fusion/grid_ray.h"
#include "mapping/fusion/ray_kernel.h"
#include "mapping/voxels/voxel_average.h"

namespace dhpmap {
namespace {

// Calls, as the loops that need them would lose registers to what is inlined: 12 % of their time.
[[gnu::noinline]] const GoneBlock* GoneAt(const Submap& submap, BlockIndex index) {
  return submap.blocks().Find(index)->gone.get();
}
[[gnu::noinline]] const TsdfBlock* TsdfAt(const Submap& submap, BlockIndex index) {
  const BlockEntry* entry = submap.blocks().Find(index);
  return entry != nullptr ? entry->tsdf.get() : nullptr;
}

/// What one submap stores where one block of a ray's neighbourhood lies.
struct Neighbour {
  TsdfBlock* tsdf = nullptr;
  LabelBlock* labels = nullptr;
  const GoneBlock* gone = nullptr;   ///< what was looked through since it was observed; null: nothing
  const BundleCell* ends = nullptr;  ///< bundles of the same segment that end here
  const VoxelMask* clear = nullptr;  ///< voxels that are kept clear; null: none
};

/// The 3 x 3 x 3 blocks around the one in which a cell's bundles end, looked up when a ray first enters them.
class Neighbourhood {
 public:
  /// `kept_clear` may be null.
  Neighbourhood(const SegmentBundles& segment, bool with_labels, Submap& submap, KeptClearVoxels* kept_clear)
      : segment_(segment), with_labels_(with_labels), submap_(submap), kept_clear_(kept_clear) {}

  void MoveTo(BlockIndex center) {
    center_ = center;
    blocks_.fill({});
    is_near_clear_ = kept_clear_ != nullptr && kept_clear_->MayBeAround(center);
  }

  /// `number`: x + 3 y + 9 z.
  Neighbour& At(int number) {
    Neighbour& neighbour = blocks_[static_cast<std::size_t>(number)];
    return neighbour.tsdf != nullptr ? neighbour : Load(IndexOf(number), neighbour);
  }
  [[nodiscard]] BlockIndex IndexOf(int number) const {
    return {center_.x + number % 3 - 1, center_.y + number / 3 % 3 - 1, center_.z + number / 9 - 1};
  }
  static constexpr int kCenter = 13;

 private:
  [[gnu::noinline]] Neighbour& Load(BlockIndex block, Neighbour& neighbour) {
    neighbour.tsdf = &submap_.MutableTsdf(block);
    if (with_labels_) neighbour.labels = &submap_.MutableLabels(block);
    neighbour.gone = GoneAt(submap_, block);
    neighbour.ends = segment_.Find(block);
    neighbour.clear = is_near_clear_ ? kept_clear_->In(block) : nullptr;
    return neighbour;
  }

  const SegmentBundles& segment_;
  const bool with_labels_;
  Submap& submap_;
  KeptClearVoxels* kept_clear_;
  bool is_near_clear_ = false;
  BlockIndex center_;
  std::array<Neighbour, 27> blocks_;
};

struct UpdateRule {
  float truncation_m;
  float dropoff_start_m;  ///< behind the surface, where the weight starts to fade; the truncation if it never does
  float fade_per_m;       ///< of the weight from there on; 0 where it never does: it is gone at once
  float max_weight;
};

/// Adds an observation to the voxel's average. Returns false where the observation weighs nothing.
bool UpdateVoxel(float sdf_m, float weight, const Eigen::Vector3f& color, const UpdateRule& rule, TsdfBlock& block,
                 std::size_t i) {
  if (-sdf_m > rule.dropoff_start_m) {
    weight *= (rule.truncation_m + sdf_m) * rule.fade_per_m;
  }
  const float old_weight = block.weight[i];
  const float sum = old_weight + weight;
  if (weight <= 0.0f || sum < kMinObservedWeight) return false;
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

/// The same for a voxel that sensors have looked through: it is seen again. Where it was contradicted there is
/// something new, which what was there before does not hold down.
bool ObserveAnew(float sdf_m, float weight, const Eigen::Vector3f& color, const UpdateRule& rule, BlockIndex block,
                 std::size_t i, Neighbour& here, Submap& submap) {
  const auto linear = static_cast<int>(i);
  const float before = here.tsdf->weight[i];
  if (here.gone->IsContradicted(linear)) here.tsdf->weight[i] = 0;
  if (!UpdateVoxel(sdf_m, weight, color, rule, *here.tsdf, i)) {
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

/// `stored`: what there is of the block. Where there is nothing, there is nothing to keep.
const VoxelMask* KeptClearAt(BlockIndex block, const TsdfBlock* stored, KeptClearVoxels* kept_clear) {
  return kept_clear != nullptr && stored != nullptr ? kept_clear->In(block) : nullptr;
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
                Submap& submap, KeptClearVoxels* kept_clear)
      : label_(label),
        anti_grazing_(config.anti_grazing),
        rule_(MakeRule(config, submap)),
        voxel_size_m_(static_cast<float>(submap.info().voxel_size_m)),
        submap_(submap),
        neighbourhood_(segment, label.has_value(), submap, kept_clear) {}

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
  /// What is in a lane.
  struct End {
    const BundleCell* cell = nullptr;
    const Bundle* bundle = nullptr;
  };

  void AddRays(std::size_t num, const std::stop_token& stop) {
    ThrowIfStopped(stop);
    WalkRays(grid_, rays_, walked_);
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
    const int end = Neighbourhood::kCenter * kBlockVoxels + bundle.linear;
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
      here.labels->AddObservation(linear, *label_);
      ++num_labelled_;
    }
    const Eigen::Vector3f end_m = bundle.weighted_sum_m / bundle.weight;
    if (GrazedColumns::AreNeeded(bundle.plane, end_m.normalized())) AddColumns(bundle, end_m, color, lane);
  }

  /// What the ray has not crossed of the columns about its end; without labels, as its band beyond the truncation.
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
      return ObserveAnew(sdf_m, weight, color, rule_, block, static_cast<std::size_t>(linear), here, submap_);
    }
    return UpdateVoxel(sdf_m, weight, color, rule_, *here.tsdf, static_cast<std::size_t>(linear));
  }

  const std::optional<ClassId> label_;
  const bool anti_grazing_;
  const UpdateRule rule_;
  const float voxel_size_m_;
  Submap& submap_;
  Neighbourhood neighbourhood_;
  const BundleCell* cell_ = nullptr;  ///< around which the neighbourhood is
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
                              KeptClearVoxels* kept_clear) {
  if (segment.is_cut_short) throw std::bad_alloc();  // it was too much for memory: the frame fails as a whole
  SegmentUpdate update(segment, label, config, submap, kept_clear);
  update.AddAll(segment, origin, stop);
  if (update.num_labelled() != 0) submap.AddClassObservations(*label, update.num_labelled());
  return update.num_updates();
}

std::int64_t CarveFreeSpace(std::span<const SegmentBundles> segments, const RayOrigin& origin,
                            const IntegrationConfig& config, Submap& submap, const std::stop_token& stop,
                            KeptClearVoxels* kept_clear) {
  const UpdateRule rule = MakeRule(config, submap);
  const auto voxel_size_m = static_cast<float>(submap.info().voxel_size_m);
  const float margin_m = rule.truncation_m + voxel_size_m;
  const BoundingSphere& sphere = submap.bounding_sphere();
  const Eigen::Vector3f to_center =
      (sphere.center_m - Eigen::Vector3d(origin.voxel.x, origin.voxel.y, origin.voxel.z) * submap.info().voxel_size_m)
          .cast<float>() -
      origin.offset_vox * voxel_size_m;
  const auto radius_m = static_cast<float>(sphere.radius_m);
  std::int64_t num_updates = 0;

  for (const SegmentBundles& segment : segments) {
    for (const Bundle& bundle : segment.bundles) {
      ThrowIfStopped(stop);
      const Eigen::Vector3f end_m = bundle.weighted_sum_m / bundle.weight;
      const float range_m = end_m.norm();
      const Eigen::Vector3f direction = end_m / range_m;
      // The part of the ray inside the bounding sphere.
      const float nearest_m = to_center.dot(direction);
      const float half2 = radius_m * radius_m - (to_center - nearest_m * direction).squaredNorm();
      if (half2 <= 0) continue;
      const float half_m = std::sqrt(half2);
      const float from_m = std::max(nearest_m - half_m, 0.0f);
      const float to_m = std::min(nearest_m + half_m, range_m - margin_m);
      if (to_m <= from_m) continue;

      GridRay ray(origin.voxel, origin.offset_vox, direction, voxel_size_m, from_m, to_m);
      BlockIndex block = BlockOf(ray.voxel());
      const TsdfBlock* seen = TsdfAt(submap, block);
      const VoxelMask* clear = KeptClearAt(block, seen, kept_clear);
      TsdfBlock* tsdf = nullptr;
      for (int step = ray.num_voxels(); step > 0; --step, ray.Next()) {
        const VoxelIndex voxel = ray.voxel();
        if (const BlockIndex now = BlockOf(voxel); now != block) {
          block = now;
          seen = TsdfAt(submap, now);
          clear = KeptClearAt(now, seen, kept_clear);
          tsdf = nullptr;
        }
        const auto linear = static_cast<std::size_t>(LinearIndex(voxel));
        if (seen == nullptr || !seen->IsObserved(static_cast<int>(linear))) continue;
        if (clear != nullptr && IsIn(*clear, static_cast<int>(linear))) continue;
        if (std::any_of(segments.begin(), segments.end(), [&](const auto& s) { return s.EndsIn(voxel); })) continue;
        if (tsdf == nullptr) seen = tsdf = &submap.MutableTsdf(block);
        // The colour weighs nothing: free space has none.
        if (UpdateVoxel(rule.truncation_m, bundle.weight, Eigen::Vector3f::Zero(), rule, *tsdf, linear)) ++num_updates;
      }
    }
  }
  return num_updates;
}

}  // namespace dhpmap

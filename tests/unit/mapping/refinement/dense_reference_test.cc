// SPDX-License-Identifier: BSD-3-Clause
// The CRF on maps, tile by tile and filtered on lattices, against the obvious way: all pairs of all voxels of a map
// that frames have made, in double precision.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <random>
#include <set>
#include <vector>

#include "mapping/evidence/label_management.h"
#include "mapping/pipeline/map_builder.h"
#include "mapping/refinement/crf_tiles.h"
#include "mapping/refinement/label_crf.h"
#include "mapping/refinement/near_evidence.h"
#include "mapping/refinement/tile_marginals.h"
#include "tests/support/map_infos.h"
#include "tests/support/scenes.h"
#include "tests/unit/mapping/evidence/random_map.h"

namespace dhpmap {
namespace {

constexpr double kCoarseVoxel_m = 0.08;

/// A preset with its lengths in voxels on coarser ones, so that all pairs can be afforded.
MapConfig OnCoarseVoxels(MapConfig config) {
  const double scale = kCoarseVoxel_m / config.voxel_size_m;
  config.voxel_size_m = kCoarseVoxel_m;
  config.truncation_m = 2 * kCoarseVoxel_m;
  config.integration = {};
  config.tracking.min_points_small = config.tracking.min_points_medium = 1;
  config.tracking.min_points_large = config.tracking.min_points_stuff = 1;
  RefinementConfig& refine = config.refinement;
  refine.management = refine.crf = false;  // while mapping
  refine.evidence_radius_m *= scale;
  refine.smoothness.position_m *= scale;
  refine.appearance.position_m *= scale;
  return config;
}

/// Gives a quarter of the image to other segments, in squares as a network's masks err, and noise to its colours.
void Spoil(std::mt19937& random, PanopticFrame& frame) {
  constexpr int kSquare_px = 4;
  DepthCameraData& data = *frame.camera;
  const int columns = (data.camera.width_px + kSquare_px - 1) / kSquare_px;
  std::vector<std::uint32_t> instead(static_cast<std::size_t>(columns * data.camera.height_px), 0);
  for (std::uint32_t& id : instead) id = random() % 4 == 0 ? static_cast<std::uint32_t>(1 + random() % 3) : 0u;
  for (std::size_t i = 0; i < data.segments.size(); ++i) {
    const int u = static_cast<int>(i) % data.camera.width_px, v = static_cast<int>(i) / data.camera.width_px;
    const std::uint32_t id = instead[static_cast<std::size_t>(v / kSquare_px * columns + u / kSquare_px)];
    if (id != 0 && data.segments[i] != 0) data.segments[i] = id;
    for (std::uint8_t* channel : {&data.color[i].r, &data.color[i].g, &data.color[i].b}) {
      *channel = static_cast<std::uint8_t>(*channel + random() % 13 - 6);
    }
  }
}

/// Two boxes that touch, before a wall, seen four times with labels of which many are wrong; positions are exclusive.
Map MapOfFrames(const MapConfig& config, unsigned seed) {
  using testing::Solid;
  const testing::Scene scene{{{Solid::Shape::kBox, {1.5, 0.2, 1}, {0.2, 0.2, 0.3}, 1, {170, 60, 50}},
                              {Solid::Shape::kBox, {1.5, -0.2, 0.9}, {0.2, 0.2, 0.2}, 2, {60, 150, 70}},
                              {Solid::Shape::kHalfSpace, {1.8, 0, 0}, {-1, 0, 0}, 3, {100, 100, 140}}}};
  const PinholeCamera camera{.width_px = 64, .height_px = 48, .fx_px = 64, .fy_px = 64, .cx_px = 32, .cy_px = 24};
  MapInfo info = testing::NamedMap("m", 2, 1);
  info.config = config;
  MapBuilder builder(std::move(info), 1);
  std::mt19937 random(seed);
  for (int i = 0; i < 4; ++i) {
    PanopticFrame frame = Render(scene, camera, testing::LookAt({0, 0.15 * (i - 1.5), 1}, {1.5, 0, 1}));
    frame.has_persistent_ids = true;
    frame.segments = {{.id = SegmentId(1), .class_id = ClassId(1)},
                      {.id = SegmentId(2), .class_id = ClassId(2)},
                      {.id = SegmentId(3), .class_id = ClassId(3)}};
    Spoil(random, frame);
    EXPECT_TRUE(builder.Integrate(frame).ok());
  }
  Map map(builder.map().Freeze());
  ThreadPool pool(1);
  ManageLabels(testing::AllIds(map), map, pool);
  return map;
}

/// Mean field over all voxels at once. What may be at a voxel, and the evidence for it, are as refinement defines them.
class DenseReference {
 public:
  DenseReference(const Map& map, int rim) : config_(map.info().config) {
    CollectVoxels(map);
    FindPossible(rim);
    GatherUnaries();
    SumKernels();
    Infer();
  }

  [[nodiscard]] std::size_t num_voxels() const { return voxels_.size(); }
  [[nodiscard]] bool Has(VoxelIndex at) const { return number_.contains(at); }
  [[nodiscard]] bool IsPossible(VoxelIndex at, std::uint32_t label) const {
    return voxels_[number_.at(at)].unary.contains(label);
  }
  [[nodiscard]] double Marginal(VoxelIndex at, std::uint32_t label) const {
    return voxels_[number_.at(at)].q.at(label);
  }
  [[nodiscard]] std::uint32_t MostSeen(VoxelIndex at) const { return voxels_[number_.at(at)].most_seen; }
  /// Where none is more likely, what was seen most.
  [[nodiscard]] std::uint32_t Likeliest(VoxelIndex at) const {
    const Voxel& voxel = voxels_[number_.at(at)];
    std::uint32_t best = voxel.most_seen;
    for (const auto& [label, q] : voxel.q) {
      if (q > voxel.q.at(best)) best = label;
    }
    return best;
  }

 private:
  using ByLabel = std::map<std::uint32_t, double>;
  struct Voxel {
    VoxelIndex at;
    Color color;
    double distance_m = 0;
    ByLabel seen, evidence, unary, q;
    std::uint32_t most_seen = 0;
  };

  void CollectVoxels(const Map& map) {
    const KnownInstances known(testing::AllIds(map), map);
    const auto blocks = CollectBlocks(testing::AllIds(map), map);
    for (const HeldBlock& block : blocks) {
      for (int i = 0; i < kBlockVoxels; ++i) {
        if (!block.TakesPart(i)) continue;
        const auto linear = static_cast<std::size_t>(i);
        Voxel voxel{.at = VoxelIn(block.index, i),
                    .color = block.entry->tsdf->color[linear],
                    .distance_m = block.entry->tsdf->distance_m[linear]};
        for (const InstanceCount& count : block.entry->labels->Get(i).instances) {
          const std::uint32_t id = count.id.In(block.holder).value;
          if (map.Find(SubmapId(id)) != nullptr) voxel.seen[id] += count.count;
        }
        voxel.most_seen = block.holder.value;
        std::uint32_t most = 0;
        for (const auto& [id, count] : voxel.seen) {
          if (count > most) voxel.most_seen = id, most = static_cast<std::uint32_t>(count);
        }
        number_[voxel.at] = voxels_.size();
        voxels_.push_back(std::move(voxel));
      }
    }
  }

  /// What any voxel of the blocks within the rim has seen.
  void FindPossible(int rim) {
    std::map<BlockIndex, std::set<std::uint32_t>> of_block;
    for (const Voxel& voxel : voxels_) {
      VisitBlocksAround(BlockOf(voxel.at), rim, [&](BlockIndex near) {
        std::set<std::uint32_t>& labels = of_block[near];
        for (const auto& [label, count] : voxel.seen) labels.insert(label);
        labels.insert(voxel.most_seen);
      });
    }
    for (Voxel& voxel : voxels_) {
      for (const std::uint32_t label : of_block[BlockOf(voxel.at)]) voxel.unary[label] = voxel.evidence[label] = 0;
    }
  }

  static double NearKernel(double d) {  // of Melkumyan and Ramos; d: in radii
    if (d >= 1) return 0;
    const double angle = 2 * std::numbers::pi * d;
    return (2 + std::cos(angle)) / 3 * (1 - d) + std::sin(angle) / (2 * std::numbers::pi);
  }

  static double SquaredVoxels(const Voxel& a, const Voxel& b) {
    const int x = a.at.x - b.at.x, y = a.at.y - b.at.y, z = a.at.z - b.at.z;
    return x * x + y * y + z * z;
  }

  void GatherUnaries() {
    const double radius_vox = config_.refinement.evidence_radius_m / config_.voxel_size_m;
    for (const Voxel& from : voxels_) {
      const bool is_at_surface = std::abs(from.distance_m) <= 1.5 * config_.voxel_size_m;
      for (Voxel& to : voxels_) {
        const double distance_vox = std::sqrt(SquaredVoxels(from, to));
        if (distance_vox > 0 && !(is_at_surface && distance_vox < radius_vox)) continue;
        const double weight = distance_vox == 0 ? 1 : double{kNearWeight} * NearKernel(distance_vox / radius_vox);
        for (const auto& [label, count] : from.seen) to.evidence[label] += weight * count;
      }
    }
    for (Voxel& voxel : voxels_) {
      double all = 0;
      for (const auto& [label, evidence] : voxel.evidence) all += evidence;
      for (auto& [label, unary] : voxel.unary) unary = -voxel.evidence[label] / std::sqrt(all + 1);
    }
  }

  /// Squared distance in the kernel's standard deviations.
  double Squared(const Voxel& a, const Voxel& b, const CrfKernelConfig& kernel, bool with_color) const {
    const double in_space = SquaredVoxels(a, b) * std::pow(config_.voxel_size_m / kernel.position_m, 2);
    if (!with_color) return in_space;
    const double red = a.color.r - b.color.r, green = a.color.g - b.color.g, blue = a.color.b - b.color.b;
    return in_space + (red * red + green * green + blue * blue) / (kernel.color * kernel.color);
  }

  /// Of both kernels, as DenseCrf defines them: w D^-1/2 K D^-1/2.
  void SumKernels() {
    const std::size_t n = voxels_.size();
    kernel_.assign(n * n, 0.0f);
    for (const bool with_color : {false, true}) {
      const CrfKernelConfig& kernel = with_color ? config_.refinement.appearance : config_.refinement.smoothness;
      std::vector<float> k(n * n);
      std::vector<double> sums(n, 0.0);
      for (std::size_t i = 0; i < n; ++i) {
        for (std::size_t j = 0; j <= i; ++j) {
          const double value = std::exp(-0.5 * Squared(voxels_[i], voxels_[j], kernel, with_color));
          k[i * n + j] = k[j * n + i] = static_cast<float>(value);
          sums[i] += value;
          if (i != j) sums[j] += value;
        }
      }
      for (std::size_t i = 0; i < n; ++i) {
        for (std::size_t j = 0; j < n; ++j) {
          kernel_[i * n + j] += static_cast<float>(kernel.weight * k[i * n + j] / std::sqrt(sums[i] * sums[j]));
        }
      }
    }
  }

  [[nodiscard]] std::vector<double> MessageOf(const std::vector<double>& q) const {
    const std::size_t n = voxels_.size();
    std::vector<double> sums(n, 0.0);
    for (std::size_t i = 0; i < n; ++i) {
      for (std::size_t j = 0; j < n; ++j) sums[i] += double{kernel_[i * n + j]} * q[j];
    }
    return sums;
  }

  void Infer() {
    const std::size_t n = voxels_.size();
    std::set<std::uint32_t> labels;
    for (const Voxel& voxel : voxels_) {
      for (const auto& [label, unary] : voxel.unary) labels.insert(label);
    }
    std::map<std::uint32_t, std::vector<double>> q, message;
    for (const std::uint32_t label : labels) message[label].assign(n, 0.0);
    for (int iteration = 0; iteration <= config_.refinement.crf_iterations; ++iteration) {
      for (const std::uint32_t label : labels) {
        if (iteration > 0) message[label] = MessageOf(q[label]);
      }
      for (const std::uint32_t label : labels) q[label].assign(n, 0.0);
      for (std::size_t i = 0; i < n; ++i) {
        double total = 0;
        for (const auto& [label, unary] : voxels_[i].unary) total += std::exp(message[label][i] - unary);
        for (const auto& [label, unary] : voxels_[i].unary) {
          q[label][i] = voxels_[i].q[label] = std::exp(message[label][i] - unary) / total;
        }
      }
    }
  }

  MapConfig config_;
  std::vector<Voxel> voxels_;
  std::map<VoxelIndex, std::size_t> number_;
  std::vector<float> kernel_;
};

class DenseReferenceTest : public ::testing::TestWithParam<bool> {
 protected:
  const MapConfig config_ = OnCoarseVoxels(GetParam() ? OutdoorLidarConfig() : IndoorConfig());
  const int rim_ = RimOfLabels(config_);
  ThreadPool pool_{2};
};

TEST_P(DenseReferenceTest, MarginalsOfTilesAreThoseOfTheWholeMapUpToTheLatticeAndTheRim) {
  const Map map = MapOfFrames(config_, 1);
  const DenseReference reference(map, rim_);
  ASSERT_GT(reference.num_voxels(), 1000u);
  ASSERT_LT(reference.num_voxels(), 6000u) << "all pairs of them";
  const KnownInstances known(testing::AllIds(map), map);
  const auto blocks = CollectBlocks(testing::AllIds(map), map);
  for (const int side : {1, kCubeSide}) {  // tiles of one block have the most rims
    double sum = 0;
    std::int64_t num_marginals = 0, num_voxels = 0;
    for (const CrfTile& tile : CutTiles(blocks, known, side, rim_, pool_)) {
      const TileProblem problem(blocks, known, tile, rim_, config_.voxel_size_m);
      const auto values = TileMarginals(problem, config_);
      const auto stride = static_cast<std::size_t>(problem.channels().num_channels());
      for (std::size_t m = 0; m < problem.num_inner(); ++m) {
        const TileProblem::Member& member = problem.members()[m];
        const VoxelIndex at = VoxelIn(problem.BlockOf(member).index, member.linear);
        ASSERT_TRUE(reference.Has(at));
        ++num_voxels;
        for (std::uint32_t c = 0; c < stride; ++c) {
          const std::uint32_t label = problem.channels().LabelAt(member.place, c);
          if (label == LabelChannels::kNone) continue;
          ASSERT_TRUE(reference.IsPossible(at, label));
          sum += std::abs(double{values[m * stride + c]} - reference.Marginal(at, label));
          ++num_marginals;
        }
      }
    }
    const double mean = sum / static_cast<double>(num_marginals);
    RecordProperty("mean_difference_side_" + std::to_string(side), std::to_string(mean));
    EXPECT_GT(num_voxels, 500);
    EXPECT_LT(mean, side == 1 ? 0.05 : 0.02) << "tiles of " << side << " blocks";
  }
}

TEST_P(DenseReferenceTest, LabelsOfARefinedMapAreThoseOfTheWholeMap) {
  for (const unsigned seed : {1u, 2u}) {
    Map map = MapOfFrames(config_, seed);
    const DenseReference reference(map, rim_);
    RefineLabels(testing::AllIds(map), map, pool_);
    std::int64_t num_voxels = 0, num_equal = 0, num_against_votes = 0;
    testing::ForEachVoxel(map, [&](const Submap& submap, const BlockEntry& entry, int i) {
      const VoxelIndex at = VoxelIn(entry.index, i);
      if (!reference.Has(at)) return;
      ++num_voxels;
      num_equal += submap.id().value == reference.Likeliest(at);
      num_against_votes += reference.Likeliest(at) != reference.MostSeen(at);
    });
    EXPECT_EQ(num_voxels, static_cast<std::int64_t>(reference.num_voxels()));
    EXPECT_GT(num_against_votes, num_voxels / 100) << "there is something to refine";
    const double share = static_cast<double>(num_equal) / static_cast<double>(num_voxels);
    RecordProperty("equal_share_seed_" + std::to_string(seed), std::to_string(share));
    EXPECT_GE(share, 0.99);
  }
}

INSTANTIATE_TEST_SUITE_P(Presets, DenseReferenceTest, ::testing::Bool(),
                         [](const auto& preset) { return preset.param ? "Outdoor" : "Indoor"; });

}  // namespace
}  // namespace dhpmap

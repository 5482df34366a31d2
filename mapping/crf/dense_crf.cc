// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/crf/dense_crf.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cassert>
#include <chrono>
#include <cstdint>
#include <vector>

#include "mapping/base/scratch_loop.h"
#include "mapping/crf/grow_buffer.h"
#include "mapping/crf/mean_field.h"
#include "mapping/crf/permutohedral_lattice.h"
#include "mapping/crf/spatial_order.h"

namespace dhpmap {
namespace {

constexpr std::size_t kChunkPoints = PermutohedralLattice<3>::kChunkPoints;
static_assert(kChunkPoints == PermutohedralLattice<6>::kChunkPoints);

std::size_t NumChunks(std::size_t num_points) { return (num_points + kChunkPoints - 1) / kChunkPoints; }

/// Bounds of the points with a finite position.
Eigen::AlignedBox3f BoundsOf(std::span<const CrfPoint> points) {
  Eigen::AlignedBox3f bounds;
  for (const CrfPoint& point : points) {
    if (point.position_m.allFinite()) bounds.extend(point.position_m);
  }
  return bounds.isEmpty() ? Eigen::AlignedBox3f(Eigen::Vector3f::Zero()) : bounds;
}

}  // namespace

struct DenseCrf::Impl {
  /// One kernel: its lattice, and a row of values for each of the lattice's rows.
  template <int D>
  struct Kernel {
    PermutohedralLattice<D> lattice;
    GrowBuffer<float> values;
    bool is_on = false;

    [[nodiscard]] LatticeChunk<D> Chunk(std::size_t chunk, std::size_t stride) {
      if (!is_on) return {};
      const std::vector<std::size_t>& first_row = lattice.graph().chunk_row;
      return {lattice.corners() + chunk * kChunkPoints, first_row[chunk + 1] - first_row[chunk],
              values.data() + first_row[chunk] * stride};
    }
  };

  explicit Impl(ThreadPool& thread_pool) : pool(thread_pool) {}

  void SortPoints(std::span<const CrfPoint> points);
  /// Returns the number of vertices.
  template <int D>
  std::size_t BuildKernel(std::span<const CrfPoint> points, const CrfKernel& config, Kernel<D>& kernel);

  ThreadPool& pool;
  Eigen::Vector3f origin_m = Eigen::Vector3f::Zero();
  GrowBuffer<std::uint32_t> order;  ///< sorts the points so that neighbours are close in memory
  Kernel<3> smoothness;
  Kernel<6> appearance;
  std::vector<MeanFieldScratch> scratch;
};

void DenseCrf::Impl::SortPoints(std::span<const CrfPoint> points) {
  const Eigen::AlignedBox3f bounds = BoundsOf(points);
  origin_m = bounds.min();
  const float extent_m = std::max(bounds.sizes().maxCoeff(), 1e-6f);
  GrowBuffer<std::uint32_t> codes;
  codes.Resize(points.size());
  pool.ParallelFor(NumChunks(points.size()), [&](std::size_t chunk) {
    const std::size_t end = std::min(points.size(), (chunk + 1) * kChunkPoints);
    for (std::size_t i = chunk * kChunkPoints; i < end; ++i) {
      codes[i] = MortonCode((points[i].position_m - origin_m) / extent_m);
    }
  });
  SortByCode(codes, order, pool);
}

template <int D>
std::size_t DenseCrf::Impl::BuildKernel(std::span<const CrfPoint> points, const CrfKernel& config, Kernel<D>& kernel) {
  kernel.is_on = config.weight > 0 && !points.empty();
  if (!kernel.is_on) return 0;
  // Paper eq. (5): p / theta_1 and, for the appearance kernel, o / theta_2, so that the filter is a unit Gaussian.
  constexpr float kFarthest = 1e6f;  // in kernel widths; keeps lattice coordinates within the range of integers
  const auto per_m = static_cast<float>(1.0 / config.position_m);
  const float per_color = D == 6 ? static_cast<float>(1.0 / config.color) : 0.0f;
  GrowBuffer<typename PermutohedralLattice<D>::Feature> features;
  features.Resize(points.size());
  pool.ParallelFor(NumChunks(points.size()), [&](std::size_t chunk) {
    const std::size_t end = std::min(points.size(), (chunk + 1) * kChunkPoints);
    for (std::size_t i = chunk * kChunkPoints; i < end; ++i) {
      const CrfPoint& point = points[order[i]];
      const Eigen::Vector3f position = (point.position_m - origin_m) * per_m;
      for (int k = 0; k < 3; ++k) features[i][k] = position[k] < kFarthest ? std::max(position[k], 0.0f) : kFarthest;
      if constexpr (D == 6) {
        features[i][3] = static_cast<float>(point.color.r) * per_color;
        features[i][4] = static_cast<float>(point.color.g) * per_color;
        features[i][5] = static_cast<float>(point.color.b) * per_color;
      }
    }
  });
  kernel.lattice.Build({features.data(), features.size()}, pool);
  kernel.lattice.Normalize(static_cast<float>(config.weight), pool);
  return kernel.lattice.graph().num_vertices;
}

DenseCrf::DenseCrf(ThreadPool& pool) : impl_(std::make_unique<Impl>(pool)) {}
DenseCrf::~DenseCrf() = default;
DenseCrf::DenseCrf(DenseCrf&&) noexcept = default;
DenseCrf& DenseCrf::operator=(DenseCrf&&) noexcept = default;

CrfBuildReport DenseCrf::SetPoints(std::span<const CrfPoint> points, const CrfKernel& smoothness,
                                   const CrfKernel& appearance) {
  Impl& impl = *impl_;
  CrfBuildReport report;
  const auto start = std::chrono::steady_clock::now();
  impl.SortPoints(points);
  const auto sorted = std::chrono::steady_clock::now();
  report.num_smoothness_vertices = impl.BuildKernel(points, smoothness, impl.smoothness);
  const auto smoothness_built = std::chrono::steady_clock::now();
  report.num_appearance_vertices = impl.BuildKernel(points, appearance, impl.appearance);
  const auto appearance_built = std::chrono::steady_clock::now();
  report.sort_s = std::chrono::duration<double>(sorted - start).count();
  report.smoothness_s = std::chrono::duration<double>(smoothness_built - sorted).count();
  report.appearance_s = std::chrono::duration<double>(appearance_built - smoothness_built).count();
  return report;
}

void DenseCrf::Infer(std::span<const int> num_labels, int iterations, std::span<float> values) {
  Impl& impl = *impl_;
  const LabelLayout layout(num_labels);
  assert(values.size() == impl.order.size() * layout.num_labels);
  const std::size_t stride = layout.num_channels(), num_points = impl.order.size();
  if (num_points == 0 || layout.num_labels == 0) return;
  Impl::Kernel<3>& smoothness = impl.smoothness;
  Impl::Kernel<6>& appearance = impl.appearance;
  const int num_steps = smoothness.is_on || appearance.is_on ? iterations : 0;
  if (num_steps > 0 && smoothness.is_on) smoothness.values.Resize(smoothness.lattice.graph().num_rows() * stride);
  if (num_steps > 0 && appearance.is_on) appearance.values.Resize(appearance.lattice.graph().num_rows() * stride);

  // Mean field for paper eq. (2).
  for (int step = 0; step <= num_steps; ++step) {
    const MeanFieldPass pass = num_steps == 0      ? MeanFieldPass::kOnly
                               : step == 0         ? MeanFieldPass::kFirst
                               : step == num_steps ? MeanFieldPass::kLast
                                                   : MeanFieldPass::kMiddle;
    ParallelForWithScratch(
        impl.pool, NumChunks(num_points), impl.scratch, [&](std::size_t c, MeanFieldScratch& scratch) {
          const std::size_t begin = c * kChunkPoints, end = std::min(num_points, begin + kChunkPoints);
          RunMeanFieldPass(pass, layout, {impl.order.data() + begin, end - begin}, smoothness.Chunk(c, stride),
                           appearance.Chunk(c, stride), values, scratch);
        });
    if (step == num_steps) break;
    if (smoothness.is_on) smoothness.lattice.graph().Blur(smoothness.values.data(), stride, impl.pool);
    if (appearance.is_on) appearance.lattice.graph().Blur(appearance.values.data(), stride, impl.pool);
  }
}

}  // namespace dhpmap

// SPDX-License-Identifier: BSD-3-Clause
#include <malloc.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <random>

#include "mapping/crf/dense_crf.h"
#include "mapping/pipeline/map_builder.h"
#include "tests/bench/bench.h"
#include "tests/bench/cpu_time.h"
#include "tests/bench/frames.h"

namespace dhpmap::bench {
namespace {

constexpr double kVoxelSize_m = 0.04;

/// Voxels less than one voxel from the surface of a map of the data set's geometry.
Result<std::vector<CrfPoint>> SurfaceOf(const CrfBenchOptions& options) {
  DHPMAP_ASSIGN_OR_RETURN(LoadedFrames loaded, LoadFrames(options.directory, LabelSource::kNone, options.num_frames));
  MapInfo info;
  info.name = "bench";
  DHPMAP_RETURN_IF_ERROR(ApplyPreset(loaded.dataset->preset(), info.config));
  info.config.voxel_size_m = kVoxelSize_m;
  info.config.truncation_m = 2 * kVoxelSize_m;
  DHPMAP_ASSIGN_OR_RETURN(LabelSet label_set, LabelSet::Create(loaded.dataset->label_classes()));
  info.label_set = std::make_shared<LabelSet>(std::move(label_set));
  MapBuilder builder(info, options.num_threads);
  for (const PanopticFrame& frame : loaded.frames) DHPMAP_RETURN_IF_ERROR(builder.Integrate(frame).status());

  std::vector<CrfPoint> points;
  for (const auto& submap : builder.map().submaps()) {
    for (const BlockEntry& entry : submap->blocks().entries()) {
      for (int i = 0; i < kBlockVoxels; ++i) {
        if (!entry.tsdf->IsObserved(i) || std::abs(entry.tsdf->distance_m[i]) >= kVoxelSize_m) continue;
        points.push_back({VoxelCentre(VoxelIn(entry.index, i), kVoxelSize_m).cast<float>(), entry.tsdf->color[i]});
      }
    }
  }
  if (points.empty()) return NotFound("no surface in the frames of " + options.directory);
  return points;
}

/// The walls, floor and ceiling of a room of 5 m x 4 m x 2.4 m, two voxels thick, with stripes and grain.
std::vector<CrfPoint> SyntheticRoom() {
  const Eigen::Vector3i size(125, 100, 60);
  std::mt19937 random(1);
  std::uniform_real_distribution<float> grain(-12.0f, 12.0f);
  const auto shade = [&](float level) {
    return static_cast<std::uint8_t>(std::clamp(level + grain(random), 0.0f, 255.0f));
  };
  std::vector<CrfPoint> points;
  for (int x = 0; x < size.x(); ++x) {
    for (int y = 0; y < size.y(); ++y) {
      for (int z = 0; z < size.z(); ++z) {
        const int to_wall = std::min({x, y, z, size.x() - 1 - x, size.y() - 1 - y, size.z() - 1 - z});
        if (to_wall > 1) continue;
        const float stripe = 40.0f * std::sin(0.15f * static_cast<float>(x + 2 * y + 3 * z));
        const Eigen::Vector3f position_m = VoxelCentre({x, y, z}, kVoxelSize_m).cast<float>();
        points.push_back(
            {position_m, {shade(140 + stripe), shade(120 - stripe), shade(100.0f + static_cast<float>(z))}});
      }
    }
  }
  return points;
}

/// Copies side by side until there are `num_points`.
std::vector<CrfPoint> Tiled(const std::vector<CrfPoint>& tile, std::size_t num_points) {
  Eigen::AlignedBox3f bounds;
  for (const CrfPoint& point : tile) bounds.extend(point.position_m);
  const Eigen::Vector3f pitch_m = bounds.sizes().array() + static_cast<float>(kVoxelSize_m);
  std::vector<CrfPoint> points;
  points.reserve(num_points);
  for (std::size_t i = 0; i < num_points; ++i) {
    const std::size_t copy = i / tile.size(), row = copy / 8, column = copy % 8;
    CrfPoint point = tile[i % tile.size()];
    point.position_m.x() += static_cast<float>(column) * pitch_m.x();
    point.position_m.y() += static_cast<float>(row) * pitch_m.y();
    points.push_back(point);
  }
  return points;
}

/// Every cube of 0.8 m has a label; three voxels of ten saw another one.
std::vector<float> NoisyUnaries(const std::vector<CrfPoint>& points, std::size_t num_labels) {
  constexpr float kSure = 0.6f;
  const float other = -std::log((1 - kSure) / static_cast<float>(std::max<std::size_t>(1, num_labels - 1)));
  std::mt19937 random(2);
  std::vector<float> unaries(points.size() * num_labels, other);
  for (std::size_t p = 0; p < points.size(); ++p) {
    const VoxelIndex cube = VoxelAt(points[p].position_m.cast<double>(), 0.8);
    std::size_t label = BlockIndexHash{}({cube.x, cube.y, cube.z}) % num_labels;
    if (random() % 10 < 3) label = random() % num_labels;
    unaries[p * num_labels + label] = -std::log(kSure);
  }
  return unaries;
}

std::vector<std::uint16_t> ArgMax(const std::vector<float>& values, std::size_t num_labels, ThreadPool& pool) {
  constexpr std::size_t kPiece = 8192;
  std::vector<std::uint16_t> best(values.size() / num_labels);
  pool.ParallelFor((best.size() + kPiece - 1) / kPiece, [&](std::size_t piece) {
    for (std::size_t p = piece * kPiece; p < std::min(best.size(), (piece + 1) * kPiece); ++p) {
      const float* row = values.data() + p * num_labels;
      best[p] = static_cast<std::uint16_t>(std::max_element(row, row + num_labels) - row);
    }
  });
  return best;
}

/// Forgets the peak of what came before.
void ResetPeakMemory() {
  malloc_trim(0);
  std::ofstream("/proc/self/clear_refs") << "5";
}

double PeakMemoryMb() {
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);) {
    if (line.starts_with("VmHWM:")) return std::stod(line.substr(6)) / 1e3;
  }
  return 0;
}

}  // namespace

Status RunCrfBench(const CrfBenchOptions& options) {
  if (options.num_labels < 1 || options.num_labels > 65535) return InvalidArgument("--labels must be 1 to 65535");
  std::vector<CrfPoint> tile;
  if (options.directory.empty()) {
    tile = SyntheticRoom();
  } else {
    DHPMAP_ASSIGN_OR_RETURN(tile, SurfaceOf(options));
  }
  mallopt(M_MMAP_THRESHOLD, 1 << 20);  // what is freed goes back: the peak shows what is in use, not holes in the heap
  const auto num_labels = static_cast<std::size_t>(options.num_labels);
  const CrfKernel smoothness{.position_m = options.smoothness_position_m,
                             .weight = options.smoothness_position_m > 0 ? 1.0 : 0.0};
  const CrfKernel appearance{.position_m = options.appearance_position_m,
                             .color = options.appearance_color,
                             .weight = options.appearance_position_m > 0 ? 1.0 : 0.0};
  std::printf(
      "%zu points (tiles of %zu), %d labels, %d iterations, kernels %g m and %g m with %g of 255, %d thread(s)\n",
      options.num_points, tile.size(), options.num_labels, options.iterations, smoothness.position_m,
      appearance.position_m, appearance.color, options.num_threads);
  std::printf(
      "        sort   smoothness (vertices)  appearance (vertices)   infer  argmax | total s   CPU s  peak MB\n");
  ThreadPool pool(options.num_threads);
  for (int repetition = 0; repetition < options.repetitions; ++repetition) {
    std::vector<CrfPoint> points = Tiled(tile, options.num_points);
    std::vector<float> values = NoisyUnaries(points, num_labels);
    ResetPeakMemory();
    const double cpu_before_s = ProcessCpu_s();
    const auto start = std::chrono::steady_clock::now();
    DenseCrf crf(pool);
    const CrfBuildReport report = crf.SetPoints(points, smoothness, appearance);
    std::vector<CrfPoint>().swap(points);  // a caller needs them no longer
    const auto built = std::chrono::steady_clock::now();
    crf.Infer({{options.num_labels}}, options.iterations, values);
    const auto inferred = std::chrono::steady_clock::now();
    const std::vector<std::uint16_t> best = ArgMax(values, num_labels, pool);
    const auto end = std::chrono::steady_clock::now();
    const auto seconds = [](auto from, auto to) { return std::chrono::duration<double>(to - from).count(); };
    std::printf("run %d  %5.3f  %10.3f (%8zu)  %10.3f (%8zu)  %6.3f  %6.3f | %7.3f  %6.3f  %7.0f\n", repetition + 1,
                report.sort_s, report.smoothness_s, report.num_smoothness_vertices, report.appearance_s,
                report.num_appearance_vertices, seconds(built, inferred), seconds(inferred, end), seconds(start, end),
                ProcessCpu_s() - cpu_before_s, PeakMemoryMb());
  }
  return Status::Ok();
}

}  // namespace dhpmap::bench

// SPDX-License-Identifier: BSD-3-Clause
#include "server/app/queries/slice_export.h"

#include <cmath>
#include <utility>

#include "mapping/io/occupancy_image.h"

namespace dhpmap {
namespace {

/// A few nanoseconds each.
constexpr std::int64_t kMostPoints = 400'000'000;

Status TooLarge(const std::string& field, const std::string& what) {
  return InvalidArgument("the slice is too large").WithReason("BAD_POINTS").WithViolation(field, what);
}

/// Extends the area to multiples of the resolution: at the voxel size in the map frame, cells are columns of voxels.
Eigen::AlignedBox2d OnMultiples(const Eigen::AlignedBox2d& area_m, double resolution_m) {
  constexpr double kRounding = 1e-6;
  const auto snap = [&](double value_m, double sign) {
    return sign * std::ceil(sign * value_m / resolution_m - kRounding) * resolution_m;
  };
  return {Eigen::Vector2d(snap(area_m.min().x(), -1), snap(area_m.min().y(), -1)),
          Eigen::Vector2d(snap(area_m.max().x(), 1), snap(area_m.max().y(), 1))};
}

/// Sets the corner and the size.
Status Place(const Eigen::AlignedBox2d& area_m, double voxel_size_m, SliceOptions& options) {
  const auto num_cells = [&](double length_m) {
    return std::max(1.0, std::ceil(length_m / options.resolution_m - 1e-6));
  };
  const double width = num_cells(area_m.sizes().x()), height = num_cells(area_m.sizes().y());
  if (!(width * height <= static_cast<double>(kMostSliceCells))) {
    return TooLarge("area", "has more than 4,000,000 cells: ask for fewer or coarser ones");
  }
  const std::int64_t points = PointsACell(options, voxel_size_m);
  if (static_cast<double>(points) * width * height > static_cast<double>(kMostPoints)) {
    return TooLarge("max_z_m", "area and band hold more than 400,000,000 voxels: ask for a part");
  }
  options.min_m = area_m.min();
  options.width = static_cast<int>(width);
  options.height = static_cast<int>(height);
  return Status::Ok();
}

Status Draw(const MapInfo& map, const SliceRequest& request, SliceAnswer& answer) {
  const SliceOptions& options = answer.options;
  if (request.format == SliceFormat::kCells) return Status::Ok();
  const bool is_png = request.format == SliceFormat::kPng;
  const std::string image = request.image.empty() ? map.name + (is_png ? ".png" : ".pgm") : request.image;
  answer.yaml = MapYaml(image, options.resolution_m, options.min_m);
  if (request.format == SliceFormat::kPgm) answer.picture = PgmOf(answer.cells, options.width, options.height);
  if (is_png) {
    DHPMAP_ASSIGN_OR_RETURN(answer.picture, PngOf(answer.cells, options.width, options.height));
  }
  return Status::Ok();
}

}  // namespace

Result<SliceAnswer> ExportSlice(const MapView& view, SurfaceCache& cache, const SliceRequest& request,
                                const std::stop_token& stop) {
  const double voxel_size_m = view.snapshot().info().config.voxel_size_m;
  const auto surfaces = cache.Of(view.shared_snapshot(), request.options.scope.with_absent);
  SliceAnswer answer{.options = request.options};
  SliceOptions& options = answer.options;
  if (options.resolution_m == 0) options.resolution_m = voxel_size_m;
  std::optional<Eigen::AlignedBox2d> area_m = request.area_m;
  if (!area_m) {
    area_m = KnownArea(*surfaces, options);
    if (!area_m) {
      return FailedPrecondition("nothing is known at these heights: name an area")
          .WithViolation("area", "is needed where nothing is known");
    }
    area_m = OnMultiples(*area_m, options.resolution_m);
  }
  DHPMAP_RETURN_IF_ERROR(Place(*area_m, voxel_size_m, options));
  const auto width = static_cast<std::size_t>(options.width),
             num_cells = width * static_cast<std::size_t>(options.height);
  if (request.format != SliceFormat::kYaml) {
    answer.cells.resize(num_cells);
    if (options.with_objects) answer.objects.resize(num_cells);
    OccupancySlice slice(surfaces, options);
    for (std::size_t y = 0; y < static_cast<std::size_t>(options.height); ++y) {
      const auto row = [&](auto& list) {
        return std::span(list).subspan(list.empty() ? 0 : y * width, list.empty() ? 0 : width);
      };
      slice.Row(static_cast<int>(y), row(answer.cells), row(answer.objects), stop);
      if (stop.stop_requested()) return Cancelled("the client went away");
    }
  }
  DHPMAP_RETURN_IF_ERROR(Draw(view.snapshot().info(), request, answer));
  return answer;
}

}  // namespace dhpmap

// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/space/lidar_bins.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "mapping/space/camera_kernel.h"
#include "mapping/space/lidar_kernel.h"

namespace dhpmap {
namespace {

constexpr auto kAround = static_cast<std::size_t>(kAzimuthBins);
const LookOptions kOptions{.voxel_size_m = 0.1, .margin_m = 0.6, .max_range_m = 30};

/// A scan of some rings, of azimuths between two.
LidarData Sector(double from_deg, double to_deg) {
  std::mt19937 random(4);
  std::uniform_real_distribution<double> range_m(0.2, 50);
  LidarData scan;
  for (int ring = 0; ring < 24; ++ring) {
    const double elevation = (-20 + 0.7 * ring) * M_PI / 180;
    for (double deg = from_deg; deg <= to_deg; deg += 0.35) {
      const double azimuth = deg * M_PI / 180, r = range_m(random);
      scan.points_m.emplace_back(static_cast<float>(r * std::cos(elevation) * std::cos(azimuth)),
                                 static_cast<float>(r * std::cos(elevation) * std::sin(azimuth)),
                                 static_cast<float>(r * std::sin(elevation)));
    }
  }
  scan.points_m.emplace_back(0, 0, 0);  // no return
  return scan;
}

/// Bins all around, of the rows of a window, point by point.
std::vector<float> AllAround(const LidarData& scan, const LidarWindow& window) {
  const auto height = static_cast<std::size_t>(window.height);
  std::vector<float> bins(kAround * height, kNoLimit);
  for (const Eigen::Vector3f& p : scan.points_m) {
    const double range = p.cast<double>().norm();
    if (range < 1e-3) continue;
    const Eigen::Vector3f ray = (p.cast<double>() / range).cast<float>();
    const Direction direction = DirectionOf(ray.x(), ray.y(), ray.z());
    const int column = std::clamp(static_cast<int>(direction.azimuth), 0, kAzimuthBins - 1);
    const int row = std::clamp(static_cast<int>(direction.elevation), 0, kElevationBins - 1) - window.first_row;
    EXPECT_TRUE(row >= 0 && row < window.height);
    float& limit = bins[static_cast<std::size_t>(row) * kAround + static_cast<std::size_t>(column)];
    const double before_m = std::clamp(range - kOptions.margin_m, 0.0, kOptions.max_range_m);
    limit = std::min(limit, static_cast<float>(before_m / kOptions.voxel_size_m));
  }
  BeamGaps gaps;
  gaps.FillColumns(kAround, height, bins);
  gaps.FillRows(kAround, height, kAround, bins);
  return bins;
}

/// Whether bins in the window are those all around, and there are none beyond it, nor at its edges.
void ExpectSameBins(const LidarData& scan, const LidarBins& bins) {
  const LidarWindow& window = bins.window();
  const std::vector<float> all = AllAround(scan, window);
  for (std::size_t i = 0; i < all.size(); ++i) {
    const int u = static_cast<int>(i % kAround) - window.first_column;
    const bool is_within = u >= 0 && u < window.width;
    const std::size_t there = i / kAround * static_cast<std::size_t>(window.width) + static_cast<std::size_t>(u);
    ASSERT_EQ(is_within ? bins.limits_vox()[there] : kNoLimit, all[i]);
    const bool is_edge = window.width < kAzimuthBins && (u == 0 || u + 1 == window.width);
    ASSERT_FALSE(is_edge && all[i] != kNoLimit);
  }
}

TEST(LidarBins, AWindowAroundThePointsHoldsWhatBinsAllAroundWould) {
  LidarBins bins;
  for (const auto& [from, to] : {std::pair{-40.0, 41.0}, {10.0, 11.0}, {-170.0, -20.0}, {95.0, 179.7}}) {
    const LidarData scan = Sector(from, to);
    bins.Build(scan, kOptions);
    EXPECT_LT(bins.window().width, (to - from) * 5 + 132);
    ExpectSameBins(scan, bins);
  }
}

TEST(LidarBins, PointsAllAroundOrAcrossTheSeamTakeAllColumns) {
  LidarBins bins;
  for (const auto& [from, to] : {std::pair{-180.0, 180.0}, {-177.0, 177.0}, {150.0, 200.0}}) {
    const LidarData scan = Sector(from, to);
    bins.Build(scan, kOptions);
    EXPECT_EQ(bins.window().width, kAzimuthBins);
    ExpectSameBins(scan, bins);
  }
}

TEST(LidarBins, AScanWithoutReturnsHasNoRows) {
  LidarBins bins;
  bins.Build(Sector(0, 10), kOptions);
  bins.Build({}, kOptions);
  EXPECT_EQ(bins.window().height, 0);
  EXPECT_TRUE(bins.limits_vox().empty());
}

}  // namespace
}  // namespace dhpmap

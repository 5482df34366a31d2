// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <filesystem>
#include <vector>

#include "mapping/base/result.h"

namespace dhpmap {

/// What calib.txt says of the left colour camera and the scanner.
struct KittiCalibration {
  Eigen::Matrix<double, 3, 4> P_image_cam0 = Eigen::Matrix<double, 3, 4>::Zero();  ///< P2
  Eigen::Matrix4d T_cam0_lidar = Eigen::Matrix4d::Identity();                      ///< Tr

  /// The world is the first scan's frame.
  [[nodiscard]] Eigen::Matrix4d WorldFromLidar(const Eigen::Matrix4d& T_cam0start_cam0) const;
};
Result<KittiCalibration> ReadKittiCalibration(const std::filesystem::path& path);

/// poses/NN.txt beside sequences/ (the odometry benchmark's ground truth) if it is there, else the sequence's
/// poses.txt: a line a scan, 12 numbers, T_cam0start_cam0.
Result<std::vector<Eigen::Matrix4d>> ReadKittiPoses(const std::filesystem::path& sequence);

/// times.txt: a line a scan, in seconds.
Result<std::vector<std::int64_t>> ReadKittiTimes(const std::filesystem::path& path);

}  // namespace dhpmap

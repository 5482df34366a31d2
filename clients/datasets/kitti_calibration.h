// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <filesystem>
#include <vector>

#include "mapping/base/result.h"

namespace dhpmap {

/// Calibration of the left colour camera and the scanner, from calib.txt.
struct KittiCalibration {
  Eigen::Matrix<double, 3, 4> P_image_cam0 = Eigen::Matrix<double, 3, 4>::Zero();  ///< P2
  Eigen::Matrix4d T_cam0_lidar = Eigen::Matrix4d::Identity();                      ///< Tr

  /// The world frame is that of the first scan.
  [[nodiscard]] Eigen::Matrix4d WorldFromLidar(const Eigen::Matrix4d& T_cam0start_cam0) const;
};
Result<KittiCalibration> ReadKittiCalibration(const std::filesystem::path& path);

/// Poses T_cam0start_cam0, a line of 12 numbers per scan: from poses/NN.txt next to sequences/ (ground truth of the
/// odometry benchmark) if it exists, else from the sequence's poses.txt.
Result<std::vector<Eigen::Matrix4d>> ReadKittiPoses(const std::filesystem::path& sequence);

/// times.txt: one line per scan, in seconds.
Result<std::vector<std::int64_t>> ReadKittiTimes(const std::filesystem::path& path);

}  // namespace dhpmap

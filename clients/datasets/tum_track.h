// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "mapping/base/result.h"

namespace dhpmap {

/// Largest time difference of records that belong together.
inline constexpr std::int64_t kTumMaxGap_ns = 20'000'000;

/// A line of rgb.txt or depth.txt.
struct TumImage {
  std::int64_t stamp_ns = 0;
  std::string file;  ///< relative to the recording
};
/// Sorted by time.
Result<std::vector<TumImage>> ReadTumImages(const std::filesystem::path& path);
/// The nearest image within kTumMaxGap_ns; null if there is none.
const TumImage* NearestImage(const std::vector<TumImage>& images, std::int64_t stamp_ns);

/// groundtruth.txt: the camera's pose over time.
class TumTrack {
 public:
  static Result<TumTrack> Read(const std::filesystem::path& path);
  /// Interpolated between neighbours that are within 0.1 s of each other, else the nearest pose within kTumMaxGap_ns,
  /// else nothing.
  [[nodiscard]] std::optional<Eigen::Matrix4d> PoseAt(std::int64_t stamp_ns) const;

 private:
  struct Sample {
    std::int64_t stamp_ns = 0;
    Eigen::Vector3d position_m = Eigen::Vector3d::Zero();
    Eigen::Quaterniond rotation = Eigen::Quaterniond::Identity();
  };
  static Eigen::Matrix4d MatrixOf(const Eigen::Vector3d& position_m, const Eigen::Quaterniond& rotation);
  std::vector<Sample> samples_;  // by time
};

}  // namespace dhpmap

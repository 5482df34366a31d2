// SPDX-License-Identifier: BSD-3-Clause
#include "clients/datasets/kitti_scan.h"

#include <algorithm>
#include <cstring>

#include "clients/datasets/file_reader.h"
#include "clients/datasets/semantic_kitti_classes.h"

namespace dhpmap {
namespace {

constexpr std::size_t kPointBytes = 4 * sizeof(float);

Status BadScan(const std::filesystem::path& path, const std::string& message) {
  return BadFile(path, message).WithReason("BAD_SCAN");
}

}  // namespace

Result<std::vector<Eigen::Vector3f>> ReadKittiPoints(const std::filesystem::path& path) {
  DHPMAP_ASSIGN_OR_RETURN(const std::vector<std::byte> bytes, ReadBytes(path));
  if (bytes.size() % kPointBytes != 0) {
    return BadScan(path, "is cut off: " + std::to_string(bytes.size()) + " bytes are not a whole number of points");
  }
  std::vector<Eigen::Vector3f> points_m(bytes.size() / kPointBytes);
  for (std::size_t i = 0; i < points_m.size(); ++i) {
    std::memcpy(points_m[i].data(), bytes.data() + i * kPointBytes, 3 * sizeof(float));
  }
  return points_m;
}

Result<std::vector<std::uint32_t>> ReadKittiLabels(const std::filesystem::path& path, std::size_t num_points) {
  DHPMAP_ASSIGN_OR_RETURN(const std::vector<std::byte> bytes, ReadBytes(path));
  if (bytes.size() != num_points * sizeof(std::uint32_t)) {
    return BadScan(path,
                   "has " + std::to_string(bytes.size()) + " bytes for " + std::to_string(num_points) + " points");
  }
  std::vector<std::uint32_t> words(num_points);
  if (!words.empty()) std::memcpy(words.data(), bytes.data(), bytes.size());
  return words;
}

void DropUnlabelledAndMoving(std::vector<Eigen::Vector3f>& points_m, std::vector<std::uint32_t>& words) {
  std::size_t kept = 0;
  for (std::size_t i = 0; i < words.size(); ++i) {
    const KittiLabel label(words[i]);
    if (!label.is_labelled() || label.is_moving()) continue;
    points_m[kept] = points_m[i];
    words[kept++] = words[i];
  }
  points_m.resize(kept);
  words.resize(kept);
}

void UnlabelMoving(std::vector<std::uint32_t>& words) {
  std::replace_if(
      words.begin(), words.end(), [](std::uint32_t word) { return KittiLabel(word).is_moving(); }, 0u);
}

}  // namespace dhpmap

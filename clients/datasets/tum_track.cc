// SPDX-License-Identifier: BSD-3-Clause
#include "clients/datasets/tum_track.h"

#include <algorithm>
#include <array>

#include "clients/datasets/file_reader.h"

namespace dhpmap {
namespace {

constexpr std::int64_t kMaxInterpolated_ns = 100'000'000;

Status BadLine(const std::filesystem::path& path, const TextRow& row, const std::string& message) {
  return BadFile(path, "line " + std::to_string(row.line) + ": " + message);
}

constexpr auto kByTime = [](const auto& a, const auto& b) { return a.stamp_ns < b.stamp_ns; };

}  // namespace

Result<std::vector<TumImage>> ReadTumImages(const std::filesystem::path& path) {
  DHPMAP_ASSIGN_OR_RETURN(const std::vector<TextRow> rows, ReadRows(path, ' '));
  std::vector<TumImage> images;
  for (const TextRow& row : rows) {
    if (row.cells.size() < 2) return BadLine(path, row, "needs `time file`");
    Result<std::int64_t> stamp = ParseSeconds(row.cells[0]);
    if (!stamp.ok()) return BadLine(path, row, stamp.status().message());
    images.push_back({*stamp, row.cells[1]});
  }
  std::stable_sort(images.begin(), images.end(), kByTime);
  return images;
}

const TumImage* NearestImage(const std::vector<TumImage>& images, std::int64_t stamp_ns) {
  const auto after = std::lower_bound(images.begin(), images.end(), TumImage{stamp_ns, {}}, kByTime);
  const TumImage* nearest = nullptr;
  std::int64_t nearest_gap_ns = kTumMaxGap_ns + 1;
  for (auto it = after == images.begin() ? after : after - 1; it != images.end() && it <= after; ++it) {
    const std::int64_t gap_ns = std::abs(it->stamp_ns - stamp_ns);
    if (gap_ns >= nearest_gap_ns) continue;
    nearest = &*it;
    nearest_gap_ns = gap_ns;
  }
  return nearest;
}

Result<TumTrack> TumTrack::Read(const std::filesystem::path& path) {
  DHPMAP_ASSIGN_OR_RETURN(const std::vector<TextRow> rows, ReadRows(path, ' '));
  TumTrack track;
  for (const TextRow& row : rows) {
    if (row.cells.size() < 8) return BadLine(path, row, "needs `time tx ty tz qx qy qz qw`");
    Result<std::int64_t> stamp = ParseSeconds(row.cells[0]);
    if (!stamp.ok()) return BadLine(path, row, stamp.status().message());
    std::array<double, 7> v{};
    for (std::size_t i = 0; i < v.size(); ++i) {
      Result<double> number = ParseNumber(row.cells[i + 1]);
      if (!number.ok()) return BadLine(path, row, number.status().message());
      v[i] = *number;
    }
    const Eigen::Quaterniond rotation(v[6], v[3], v[4], v[5]);
    if (!(rotation.norm() > 1e-6)) return BadLine(path, row, "the quaternion is zero");
    track.samples_.push_back({*stamp, {v[0], v[1], v[2]}, rotation.normalized()});
  }
  if (track.samples_.empty()) return BadFile(path, "holds no poses");
  std::stable_sort(track.samples_.begin(), track.samples_.end(), kByTime);
  return track;
}

Eigen::Matrix4d TumTrack::MatrixOf(const Eigen::Vector3d& position_m, const Eigen::Quaterniond& rotation) {
  Eigen::Matrix4d matrix = Eigen::Matrix4d::Identity();
  matrix.topLeftCorner<3, 3>() = rotation.toRotationMatrix();
  matrix.topRightCorner<3, 1>() = position_m;
  return matrix;
}

std::optional<Eigen::Matrix4d> TumTrack::PoseAt(std::int64_t stamp_ns) const {
  const auto after = std::lower_bound(samples_.begin(), samples_.end(), Sample{stamp_ns}, kByTime);
  const Sample* right = after == samples_.end() ? nullptr : &*after;
  const Sample* left = after == samples_.begin() ? right : &*(after - 1);
  if (right == nullptr) right = left;
  if (const std::int64_t span_ns = right->stamp_ns - left->stamp_ns; span_ns > 0 && span_ns <= kMaxInterpolated_ns) {
    const double t = static_cast<double>(stamp_ns - left->stamp_ns) / static_cast<double>(span_ns);
    return MatrixOf((1 - t) * left->position_m + t * right->position_m, left->rotation.slerp(t, right->rotation));
  }
  const std::int64_t left_gap_ns = std::abs(stamp_ns - left->stamp_ns);
  const std::int64_t right_gap_ns = std::abs(stamp_ns - right->stamp_ns);
  if (std::min(left_gap_ns, right_gap_ns) > kTumMaxGap_ns) return std::nullopt;
  const Sample& nearest = left_gap_ns <= right_gap_ns ? *left : *right;
  return MatrixOf(nearest.position_m, nearest.rotation);
}

}  // namespace dhpmap

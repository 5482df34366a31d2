// SPDX-License-Identifier: BSD-3-Clause
#include "clients/datasets/kitti_calibration.h"

#include <Eigen/LU>
#include <cmath>
#include <optional>

#include "clients/datasets/file_reader.h"

namespace dhpmap {
namespace {

using Matrix34 = Eigen::Matrix<double, 3, 4>;

/// Parses the 12 cells from `first` on; cells before may be a key.
Result<Matrix34> ParseMatrix(const TextRow& row, std::size_t first) {
  if (row.cells.size() != first + 12) return InvalidArgument("needs 12 numbers");
  Matrix34 matrix;
  for (int i = 0; i < 12; ++i) {
    DHPMAP_ASSIGN_OR_RETURN(matrix(i / 4, i % 4), ParseNumber(row.cells[first + i]));
  }
  return matrix;
}

Eigen::Matrix4d Rigid(const Matrix34& upper) {
  Eigen::Matrix4d matrix = Eigen::Matrix4d::Identity();
  matrix.topRows<3>() = upper;
  return matrix;
}

Status BadLine(const std::filesystem::path& path, const TextRow& row, const Status& status) {
  return BadFile(path, "line " + std::to_string(row.line) + ": " + status.message());
}

}  // namespace

Eigen::Matrix4d KittiCalibration::WorldFromLidar(const Eigen::Matrix4d& T_cam0start_cam0) const {
  return T_cam0_lidar.inverse() * T_cam0start_cam0 * T_cam0_lidar;
}

Result<KittiCalibration> ReadKittiCalibration(const std::filesystem::path& path) {
  DHPMAP_ASSIGN_OR_RETURN(const std::vector<TextRow> rows, ReadRows(path, ' '));
  std::optional<Matrix34> projection, lidar;
  for (const TextRow& row : rows) {
    const std::string& key = row.cells.front();
    if (key != "P2:" && key != "Tr:") continue;
    Result<Matrix34> matrix = ParseMatrix(row, 1);
    if (!matrix.ok()) return BadLine(path, row, matrix.status());
    (key == "P2:" ? projection : lidar) = *matrix;
  }
  if (!projection) return BadFile(path, "has no line 'P2:'");
  if (!lidar) return BadFile(path, "has no line 'Tr:'");
  if (!(std::abs(lidar->leftCols<3>().determinant() - 1.0) < 1e-2)) return BadFile(path, "'Tr:' is not rigid");
  return KittiCalibration{*projection, Rigid(*lidar)};
}

Result<std::vector<Eigen::Matrix4d>> ReadKittiPoses(const std::filesystem::path& sequence) {
  const std::filesystem::path benchmark =
      sequence.parent_path().parent_path() / "poses" / (sequence.filename().string() + ".txt");
  std::error_code ignored;
  const std::filesystem::path path = std::filesystem::exists(benchmark, ignored) ? benchmark : sequence / "poses.txt";
  DHPMAP_ASSIGN_OR_RETURN(const std::vector<TextRow> rows, ReadRows(path, ' '));
  std::vector<Eigen::Matrix4d> poses;
  for (const TextRow& row : rows) {
    Result<Matrix34> matrix = ParseMatrix(row, 0);
    if (!matrix.ok()) return BadLine(path, row, matrix.status());
    poses.push_back(Rigid(*matrix));
  }
  return poses;
}

Result<std::vector<std::int64_t>> ReadKittiTimes(const std::filesystem::path& path) {
  DHPMAP_ASSIGN_OR_RETURN(const std::vector<TextRow> rows, ReadRows(path, ' '));
  std::vector<std::int64_t> stamps_ns;
  for (const TextRow& row : rows) {
    Result<std::int64_t> stamp = ParseSeconds(row.cells.front());
    if (!stamp.ok()) return BadLine(path, row, stamp.status());
    stamps_ns.push_back(*stamp);
  }
  return stamps_ns;
}

}  // namespace dhpmap

// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <unordered_set>

#include "clients/datasets/camera_file.h"
#include "clients/datasets/file_reader.h"
#include "clients/datasets/kitti_calibration.h"
#include "clients/datasets/kitti_scan.h"
#include "clients/datasets/label_table.h"
#include "clients/datasets/layouts.h"
#include "clients/datasets/segment_table.h"
#include "clients/datasets/semantic_kitti_classes.h"

namespace dhpmap {
namespace {

namespace fs = std::filesystem;

bool IsFolder(const fs::path& path) {
  std::error_code ignored;
  return fs::is_directory(path, ignored);
}

fs::path FindKittiSequence(const fs::path& directory) {
  if (IsFolder(directory / "velodyne")) return directory;
  for (const fs::path& parent : {directory, directory / "sequences"}) {
    for (const fs::path& sequence : FoldersWithPrefix(parent, "")) {
      if (IsFolder(sequence / "velodyne")) return sequence;
    }
  }
  return {};
}

/// One segment for each persistent id in the scan.
std::vector<SegmentInfo> SegmentsOf(const std::vector<std::uint32_t>& ids) {
  std::unordered_set<std::uint32_t> seen{0};
  std::vector<SegmentInfo> segments;
  for (std::uint32_t id : ids) {
    if (seen.insert(id).second) segments.push_back({SegmentId(id), ClassId(KittiLabel(id).class_id), 1.0f});
  }
  return segments;
}

struct Sequence {
  fs::path folder;
  std::vector<std::string> ids;
  std::vector<Eigen::Matrix4d> poses;
  std::vector<std::int64_t> stamps_ns;
  KittiCalibration calibration;
  bool has_images = false;
  bool has_labels = false;
};

class KittiDataset : public Dataset {
 public:
  KittiDataset(Sequence sequence, LabelSource labels, LabelTable table, const DatasetOptions& options)
      : sequence_(std::move(sequence)), labels_(labels), table_(std::move(table)), options_(options) {}

  const std::vector<LabelClass>& label_classes() const override {
    return labels_ == LabelSource::kGroundTruth ? SemanticKittiClasses() : table_.classes();
  }
  std::string preset() const override { return "outdoor_lidar"; }
  bool has_persistent_ids() const override { return labels_ == LabelSource::kGroundTruth; }
  std::size_t num_frames() const override { return sequence_.ids.size(); }

  Result<DatasetFrame> Read(std::size_t index) override {
    if (index >= sequence_.ids.size()) return OutOfRange("there is no frame " + std::to_string(index));
    DatasetFrame frame;
    frame.id = sequence_.ids[index];
    DHPMAP_ASSIGN_OR_RETURN(const std::size_t row, RowOf(index));
    frame.stamp_ns = sequence_.stamps_ns[row];
    frame.T_map_sensor = sequence_.calibration.WorldFromLidar(sequence_.poses[row]);
    frame.lidar = DatasetFrame::Lidar{};
    DHPMAP_RETURN_IF_ERROR(ReadScan(frame));
    if (sequence_.has_images) DHPMAP_RETURN_IF_ERROR(ReadCamera(frame));
    return frame;
  }

 private:
  /// Index into poses.txt and times.txt: the scan's index if they have as many lines as there are scans, else its
  /// number.
  [[nodiscard]] Result<std::size_t> RowOf(std::size_t index) const {
    const std::size_t num_rows = std::min(sequence_.poses.size(), sequence_.stamps_ns.size());
    if (num_rows == sequence_.ids.size()) return index;
    const Result<std::int64_t> number = ParseInteger(sequence_.ids[index]);
    if (!number.ok() || *number < 0 || static_cast<std::size_t>(*number) >= num_rows) {
      return InvalidArgument("no pose or no time for scan " + sequence_.ids[index]).WithReason("NO_MATCH");
    }
    return static_cast<std::size_t>(*number);
  }

  Status ReadScan(DatasetFrame& frame) const {
    DHPMAP_ASSIGN_OR_RETURN(frame.lidar->points_m,
                            ReadKittiPoints(sequence_.folder / "velodyne" / (frame.id + ".bin")));
    const bool is_truth = labels_ == LabelSource::kGroundTruth;
    if (!is_truth && !(sequence_.has_labels && options_.drop_moving_points)) return Status::Ok();
    DHPMAP_ASSIGN_OR_RETURN(
        std::vector<std::uint32_t> words,
        ReadKittiLabels(sequence_.folder / "labels" / (frame.id + ".label"), frame.lidar->points_m.size()));
    if (options_.drop_moving_points) DropUnlabelledAndMoving(frame.lidar->points_m, words);
    if (!is_truth) return Status::Ok();
    if (options_.unlabel_moving_points) UnlabelMoving(words);
    std::transform(words.begin(), words.end(), words.begin(), PersistentId);
    frame.segments = SegmentsOf(words);
    frame.lidar->segments = std::move(words);
    return Status::Ok();
  }

  Status ReadCamera(DatasetFrame& frame) const {
    const fs::path images = sequence_.folder / "image_2";
    DatasetFrame::Lidar& lidar = *frame.lidar;
    DHPMAP_ASSIGN_OR_RETURN(lidar.color.bytes, ReadImageFile(images / (frame.id + ".png")));
    const auto size_px = PngSize(lidar.color.bytes);
    if (!size_px.ok()) {
      return BadFile(images / (frame.id + ".png"), size_px.status().message()).WithReason("BAD_IMAGE");
    }
    std::tie(lidar.image_width_px, lidar.image_height_px) = *size_px;
    lidar.P_image_lidar = sequence_.calibration.P_image_cam0 * sequence_.calibration.T_cam0_lidar;
    if (labels_ != LabelSource::kPredicted) return Status::Ok();
    Result<std::vector<std::byte>> ids = ReadImageFile(images / (frame.id + "_predicted2.png"));
    if (!ids.ok()) ids = ReadImageFile(images / (frame.id + "_predicted.png"));
    DHPMAP_ASSIGN_OR_RETURN(lidar.segment_image.bytes, std::move(ids));
    DHPMAP_ASSIGN_OR_RETURN(frame.segments, ReadSegmentTable(images / (frame.id + "_labels.json"), table_));
    return Status::Ok();
  }

  Sequence sequence_;
  LabelSource labels_;
  LabelTable table_;
  DatasetOptions options_;
};

Result<Sequence> ReadSequence(const fs::path& folder) {
  Sequence sequence;
  sequence.folder = folder;
  sequence.ids = StemsWithSuffix(folder / "velodyne", ".bin");
  if (sequence.ids.empty()) return NotFound("there are no .bin files in " + (folder / "velodyne").string());
  DHPMAP_ASSIGN_OR_RETURN(sequence.calibration, ReadKittiCalibration(folder / "calib.txt"));
  DHPMAP_ASSIGN_OR_RETURN(sequence.poses, ReadKittiPoses(folder));
  DHPMAP_ASSIGN_OR_RETURN(sequence.stamps_ns, ReadKittiTimes(folder / "times.txt"));
  sequence.has_images = IsFolder(folder / "image_2");
  sequence.has_labels = IsFolder(folder / "labels");
  return sequence;
}

Result<LabelTable> ReadTable(const Sequence& sequence, LabelSource labels) {
  const auto no_labels = [&sequence](const std::string& missing) {
    return FailedPrecondition("there is no " + missing + " in " + sequence.folder.string()).WithReason("NO_LABELS");
  };
  if (labels == LabelSource::kNone) return LabelTable();
  if (labels == LabelSource::kGroundTruth) {
    return sequence.has_labels ? Result<LabelTable>(LabelTable()) : no_labels("labels/ folder");
  }
  if (!sequence.has_images) return no_labels("image_2/ folder");
  fs::path folder = sequence.folder;
  for (int level = 0; level < 3; ++level, folder = folder.parent_path()) {  // the sequence, sequences/, the root
    std::error_code ignored;
    const fs::path path = folder / "detectron_labels.csv";
    if (fs::exists(path, ignored)) return LabelTable::Read(path, RowNames::kClasses);
  }
  return no_labels("detectron_labels.csv");
}

}  // namespace

bool LooksLikeKitti(const fs::path& directory) { return !FindKittiSequence(directory).empty(); }

Result<std::unique_ptr<Dataset>> OpenKitti(const fs::path& directory, LabelSource labels,
                                           const DatasetOptions& options) {
  const fs::path folder = FindKittiSequence(directory);
  if (folder.empty()) return NotFound("there is no velodyne/ folder in " + directory.string() + " or its sequences");
  DHPMAP_ASSIGN_OR_RETURN(Sequence sequence, ReadSequence(folder));
  DHPMAP_ASSIGN_OR_RETURN(LabelTable table, ReadTable(sequence, labels));
  return std::unique_ptr<Dataset>(
      std::make_unique<KittiDataset>(std::move(sequence), labels, std::move(table), options));
}

}  // namespace dhpmap

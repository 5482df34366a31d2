// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>

#include "clients/datasets/camera_file.h"
#include "clients/datasets/file_reader.h"
#include "clients/datasets/label_table.h"
#include "clients/datasets/layouts.h"
#include "clients/datasets/segment_table.h"

namespace dhpmap {
namespace {

namespace fs = std::filesystem;

constexpr PinholeCamera kFlatCamera{640, 480, 320.0, 320.0, 320.0, 240.0};
constexpr double kIntegerDepthScale_m = 0.001;  // for re-encoded depth; the original layout has metres as float

struct Entry {
  std::string id;
  std::int64_t stamp_ns = 0;
};

/// The recording in `directory` or below it; empty if there is none.
fs::path FindRun(const fs::path& directory) {
  std::error_code ignored;
  if (fs::exists(directory / "timestamps.csv", ignored)) return directory;
  for (const fs::path& run : FoldersWithPrefix(directory, "run")) {
    if (fs::exists(run / "timestamps.csv", ignored)) return run;
  }
  return {};
}

Result<std::vector<Entry>> ReadTimestamps(const fs::path& path) {
  DHPMAP_ASSIGN_OR_RETURN(const std::vector<TextRow> rows, ReadRows(path, ','));
  std::vector<Entry> entries;
  for (const TextRow& row : rows) {
    if (row.cells[0] == "ImageID") continue;
    const std::string where = "line " + std::to_string(row.line) + ": ";
    if (row.cells.size() < 2) return BadFile(path, where + "needs ImageID,TimeStamp");
    Result<std::int64_t> stamp = ParseInteger(row.cells[1]);
    if (!stamp.ok()) return BadFile(path, where + "time in ns: " + stamp.status().message());
    entries.push_back({row.cells[0], *stamp});
  }
  if (entries.empty()) return BadFile(path, "lists no frames");
  std::stable_sort(entries.begin(), entries.end(),
                   [](const Entry& a, const Entry& b) { return a.stamp_ns < b.stamp_ns; });
  return entries;
}

class FlatDataset : public Dataset {
 public:
  FlatDataset(fs::path run, LabelSource labels, LabelTable table, PinholeCamera camera, std::vector<Entry> entries)
      : run_(std::move(run)),
        labels_(labels),
        table_(std::move(table)),
        camera_(camera),
        entries_(std::move(entries)) {}

  const std::vector<LabelClass>& label_classes() const override { return table_.classes(); }
  std::string preset() const override { return "indoor"; }
  bool has_persistent_ids() const override { return labels_ == LabelSource::kGroundTruth; }
  std::size_t num_frames() const override { return entries_.size(); }

  Result<DatasetFrame> Read(std::size_t index) override {
    if (index >= entries_.size()) return OutOfRange("there is no frame " + std::to_string(index));
    DatasetFrame frame;
    frame.id = entries_[index].id;
    frame.stamp_ns = entries_[index].stamp_ns;
    DHPMAP_ASSIGN_OR_RETURN(frame.T_map_sensor, ReadPose(FileOf(frame, "_pose.txt")));
    DatasetFrame::DepthCamera& camera = frame.camera.emplace();
    camera.camera = camera_;
    DHPMAP_ASSIGN_OR_RETURN(camera.depth.bytes, ReadImageFile(FileOf(frame, "_depth.tiff")));
    camera.depth.scale_m = kIntegerDepthScale_m;
    DHPMAP_ASSIGN_OR_RETURN(camera.color.bytes, ReadImageFile(FileOf(frame, "_color.png")));
    DHPMAP_RETURN_IF_ERROR(ReadLabels(frame));
    return frame;
  }

 private:
  [[nodiscard]] fs::path FileOf(const DatasetFrame& frame, const char* ending) const {
    return run_ / (frame.id + ending);
  }

  Status ReadLabels(DatasetFrame& frame) const {
    if (labels_ == LabelSource::kNone) return Status::Ok();
    const bool is_predicted = labels_ == LabelSource::kPredicted;
    DHPMAP_ASSIGN_OR_RETURN(frame.camera->segments.bytes,
                            ReadImageFile(FileOf(frame, is_predicted ? "_predicted.png" : "_segmentation.png")));
    if (is_predicted) {
      DHPMAP_ASSIGN_OR_RETURN(frame.segments, ReadSegmentTable(FileOf(frame, "_labels.json"), table_));
    } else {
      frame.segments = table_.AllSegments();
    }
    return Status::Ok();
  }

  fs::path run_;
  LabelSource labels_;
  LabelTable table_;
  PinholeCamera camera_;
  std::vector<Entry> entries_;
};

/// The table is in the recording or next to it.
Result<LabelTable> ReadTable(const fs::path& run, LabelSource labels) {
  if (labels == LabelSource::kNone) return LabelTable();
  const bool is_predicted = labels == LabelSource::kPredicted;
  const char* name = is_predicted ? "detectron_labels.csv" : "groundtruth_labels.csv";
  for (const fs::path& folder : {run, run.parent_path()}) {
    std::error_code ignored;
    if (!fs::exists(folder / name, ignored)) continue;
    return LabelTable::Read(folder / name, is_predicted ? RowNames::kClasses : RowNames::kInstances);
  }
  return FailedPrecondition("there is no " + std::string(name) + " in " + run.string() + " or beside it")
      .WithReason("NO_LABELS");
}

}  // namespace

bool LooksFlat(const fs::path& directory) { return !FindRun(directory).empty(); }

Result<std::unique_ptr<Dataset>> OpenFlat(const fs::path& directory, LabelSource labels) {
  const fs::path run = FindRun(directory);
  if (run.empty())
    return NotFound("there is no timestamps.csv in " + directory.string() + " or a run* folder below it");
  DHPMAP_ASSIGN_OR_RETURN(std::vector<Entry> entries, ReadTimestamps(run / "timestamps.csv"));
  DHPMAP_ASSIGN_OR_RETURN(LabelTable table, ReadTable(run, labels));
  const std::array folders{run, run.parent_path()};
  DHPMAP_ASSIGN_OR_RETURN(const std::optional<PinholeCamera> camera, FindCameraFile(folders));
  return std::unique_ptr<Dataset>(
      std::make_unique<FlatDataset>(run, labels, std::move(table), camera.value_or(kFlatCamera), std::move(entries)));
}

}  // namespace dhpmap

// SPDX-License-Identifier: BSD-3-Clause
#include <array>
#include <charconv>

#include "clients/datasets/camera_file.h"
#include "clients/datasets/file_reader.h"
#include "clients/datasets/layouts.h"

namespace dhpmap {
namespace {

namespace fs = std::filesystem;

constexpr PinholeCamera kKinect{640, 480, 585.0, 585.0, 320.0, 240.0};
constexpr double kSevenScenesDepthScale_m = 0.001;
constexpr double kFramePeriod_ns = 1e9 / 30;  // the layout has no timestamps
constexpr std::int64_t kMaxFrameNumber = 1'000'000'000;
constexpr const char* kDepthEnding = ".depth.png";

fs::path FindScene(const fs::path& directory) {
  const auto has_frames = [](const fs::path& folder) {
    for (const std::string& stem : StemsWithSuffix(folder, kDepthEnding)) {
      if (stem.starts_with("frame-")) return true;
    }
    return false;
  };
  if (has_frames(directory)) return directory;
  for (const fs::path& sequence : FoldersWithPrefix(directory, "seq-")) {
    if (has_frames(sequence)) return sequence;
  }
  return {};
}

/// A 3x3 matrix K, which some releases include.
Result<std::optional<PinholeCamera>> FindIntrinsics(std::span<const fs::path> folders) {
  for (const fs::path& folder : folders) {
    const fs::path path = folder / "camera-intrinsics.txt";
    std::error_code ignored;
    if (!fs::exists(path, ignored)) continue;
    DHPMAP_ASSIGN_OR_RETURN(const std::vector<double> k, ReadNumbers(path));
    if (k.size() != 9) return BadFile(path, "must hold a 3x3 matrix");
    const PinholeCamera camera{kKinect.width_px, kKinect.height_px, k[0], k[4], k[2], k[5]};
    if (const Status status = camera.Validate(); !status.ok()) return BadFile(path, status.message());
    return std::optional(camera);
  }
  return std::optional<PinholeCamera>();
}

class SevenScenesDataset : public Dataset {
 public:
  SevenScenesDataset(fs::path folder, PinholeCamera camera, std::vector<std::string> ids)
      : folder_(std::move(folder)), camera_(camera), ids_(std::move(ids)) {}

  const std::vector<LabelClass>& label_classes() const override { return classes_; }
  std::string preset() const override { return "indoor"; }
  bool has_persistent_ids() const override { return false; }
  std::size_t num_frames() const override { return ids_.size(); }

  Result<DatasetFrame> Read(std::size_t index) override {
    if (index >= ids_.size()) return OutOfRange("there is no frame " + std::to_string(index));
    DatasetFrame frame;
    frame.id = ids_[index];
    const Result<std::int64_t> number = ParseInteger(frame.id.substr(frame.id.find('-') + 1));
    const bool is_numbered = number.ok() && *number >= 0 && *number <= kMaxFrameNumber;
    const double place = is_numbered ? static_cast<double>(*number) : static_cast<double>(index);
    frame.stamp_ns = static_cast<std::int64_t>(place * kFramePeriod_ns);
    DHPMAP_ASSIGN_OR_RETURN(frame.T_map_sensor, ReadPose(folder_ / (frame.id + ".pose.txt")));
    DatasetFrame::DepthCamera& camera = frame.camera.emplace();
    camera.camera = camera_;
    DHPMAP_ASSIGN_OR_RETURN(camera.depth.bytes, ReadImageFile(folder_ / (frame.id + kDepthEnding)));
    camera.depth.scale_m = kSevenScenesDepthScale_m;
    Result<std::vector<std::byte>> color = ReadImageFile(folder_ / (frame.id + ".color.png"));
    if (!color.ok()) color = ReadImageFile(folder_ / (frame.id + ".color.jpg"));
    DHPMAP_ASSIGN_OR_RETURN(camera.color.bytes, std::move(color));
    return frame;
  }

 private:
  fs::path folder_;
  PinholeCamera camera_;
  std::vector<std::string> ids_;
  std::vector<LabelClass> classes_;
};

}  // namespace

bool LooksLikeSevenScenes(const fs::path& directory) { return !FindScene(directory).empty(); }

Result<std::unique_ptr<Dataset>> OpenSevenScenes(const fs::path& directory, LabelSource labels) {
  if (labels != LabelSource::kNone) {
    return FailedPrecondition("the 7-Scenes layout has no labels").WithReason("NO_LABELS");
  }
  const fs::path folder = FindScene(directory);
  if (folder.empty())
    return NotFound("there are no frame-*.depth.png in " + directory.string() + " or a seq-* below it");
  const std::array folders{folder, folder.parent_path()};
  DHPMAP_ASSIGN_OR_RETURN(std::optional<PinholeCamera> camera, FindCameraFile(folders));
  if (!camera) {
    DHPMAP_ASSIGN_OR_RETURN(camera, FindIntrinsics(folders));
  }
  return std::unique_ptr<Dataset>(
      std::make_unique<SevenScenesDataset>(folder, camera.value_or(kKinect), StemsWithSuffix(folder, kDepthEnding)));
}

}  // namespace dhpmap

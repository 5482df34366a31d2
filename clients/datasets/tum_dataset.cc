// SPDX-License-Identifier: BSD-3-Clause
#include <array>

#include "clients/datasets/camera_file.h"
#include "clients/datasets/file_reader.h"
#include "clients/datasets/layouts.h"
#include "clients/datasets/tum_track.h"

namespace dhpmap {
namespace {

namespace fs = std::filesystem;

constexpr double kTumDepthScale_m = 1.0 / 5000.0;

/// The data set's colour intrinsics of each of its three Kinects; depth is registered to colour.
PinholeCamera CameraByName(const std::string& name) {
  if (name.find("freiburg1") != std::string::npos) return {640, 480, 517.3, 516.5, 318.6, 255.3};
  if (name.find("freiburg2") != std::string::npos) return {640, 480, 520.9, 521.0, 325.1, 249.7};
  if (name.find("freiburg3") != std::string::npos) return {640, 480, 535.4, 539.2, 320.1, 247.6};
  return {640, 480, 525.0, 525.0, 319.5, 239.5};
}

class TumDataset : public Dataset {
 public:
  TumDataset(fs::path folder, PinholeCamera camera, TumTrack track, std::vector<TumImage> depth,
             std::vector<TumImage> color)
      : folder_(std::move(folder)),
        camera_(camera),
        track_(std::move(track)),
        depth_(std::move(depth)),
        color_(std::move(color)) {}

  const std::vector<LabelClass>& label_classes() const override { return classes_; }
  std::string preset() const override { return "indoor"; }
  bool has_persistent_ids() const override { return false; }
  std::size_t num_frames() const override { return depth_.size(); }

  Result<DatasetFrame> Read(std::size_t index) override {
    if (index >= depth_.size()) return OutOfRange("there is no frame " + std::to_string(index));
    DatasetFrame frame;
    frame.id = fs::path(depth_[index].file).stem().string();
    frame.stamp_ns = depth_[index].stamp_ns;
    const auto no_match = [&frame](const char* what) {
      return NotFound("no " + std::string(what) + " within 20 ms of depth image " + frame.id).WithReason("NO_MATCH");
    };
    const std::optional<Eigen::Matrix4d> pose = track_.PoseAt(frame.stamp_ns);
    if (!pose) return no_match("pose");
    const TumImage* color = NearestImage(color_, frame.stamp_ns);
    if (color == nullptr) return no_match("colour image");
    frame.T_map_sensor = *pose;
    DatasetFrame::DepthCamera& camera = frame.camera.emplace();
    camera.camera = camera_;
    DHPMAP_ASSIGN_OR_RETURN(camera.depth.bytes, ReadImageFile(folder_ / depth_[index].file));
    camera.depth.scale_m = kTumDepthScale_m;
    DHPMAP_ASSIGN_OR_RETURN(camera.color.bytes, ReadImageFile(folder_ / color->file));
    return frame;
  }

 private:
  fs::path folder_;
  PinholeCamera camera_;
  TumTrack track_;
  std::vector<TumImage> depth_, color_;
  std::vector<LabelClass> classes_;
};

}  // namespace

bool LooksLikeTum(const fs::path& directory) {
  std::error_code ignored;
  return fs::exists(directory / "depth.txt", ignored) && fs::exists(directory / "rgb.txt", ignored);
}

Result<std::unique_ptr<Dataset>> OpenTum(const fs::path& directory, LabelSource labels) {
  if (labels != LabelSource::kNone) {
    return FailedPrecondition("the TUM RGB-D layout has no labels").WithReason("NO_LABELS");
  }
  DHPMAP_ASSIGN_OR_RETURN(std::vector<TumImage> depth, ReadTumImages(directory / "depth.txt"));
  if (depth.empty()) return BadFile(directory / "depth.txt", "lists no images");
  DHPMAP_ASSIGN_OR_RETURN(std::vector<TumImage> color, ReadTumImages(directory / "rgb.txt"));
  DHPMAP_ASSIGN_OR_RETURN(TumTrack track, TumTrack::Read(directory / "groundtruth.txt"));
  const std::array folders{directory, directory.parent_path()};
  DHPMAP_ASSIGN_OR_RETURN(const std::optional<PinholeCamera> camera, FindCameraFile(folders));
  return std::unique_ptr<Dataset>(
      std::make_unique<TumDataset>(directory, camera.value_or(CameraByName(directory.filename().string())),
                                   std::move(track), std::move(depth), std::move(color)));
}

}  // namespace dhpmap

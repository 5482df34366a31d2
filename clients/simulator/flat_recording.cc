// SPDX-License-Identifier: BSD-3-Clause
#include "clients/simulator/flat_recording.h"

#include <algorithm>
#include <cstdio>
#include <fstream>
#include <system_error>

#include "clients/simulator/apartment_change.h"
#include "clients/simulator/camera_path.h"
#include "clients/simulator/depth_noise.h"
#include "clients/simulator/image_files.h"
#include "clients/simulator/label_files.h"
#include "clients/simulator/panoptic_noise.h"
#include "clients/simulator/renderer.h"
#include "clients/simulator/truth_file.h"
#include "mapping/base/mutex.h"

namespace dhpmap::simulator {
namespace {

namespace fs = std::filesystem;

constexpr int kMaxFrames = 100'000, kMaxChanged = 100;
constexpr double kMaxNoiseLevel = 5;
constexpr int kMinSide_px = 16, kMaxSide_px = 4096;
constexpr std::int64_t kFirstStamp_ns = 1'600'000'000'000'000'000;
constexpr std::int64_t kFramePeriod_ns = 100'000'000;
constexpr std::int64_t kBetweenWalks_ns = 3'600'000'000'000;

Status WriteText(const fs::path& path, const std::string& text) {
  std::ofstream out(path, std::ios::binary);
  out << text;
  out.close();
  return out ? Status::Ok() : Unavailable("cannot write " + path.string());
}

std::string FrameId(int frame) {
  char id[16];
  std::snprintf(id, sizeof(id), "%06d", frame);
  return id;
}

std::string PoseText(const Transform& T) {
  std::string text;
  for (int row = 0; row < 4; ++row) {
    char line[128];
    std::snprintf(line, sizeof(line), "%.9f %.9f %.9f %.9f\n", T(row, 0), T(row, 1), T(row, 2), T(row, 3));
    text += line;
  }
  return text;
}

std::string CameraText(const PinholeCamera& camera) {
  char text[160];
  std::snprintf(text, sizeof(text), "# width height fx fy cx cy\n%d %d %.6f %.6f %.6f %.6f\n", camera.width_px,
                camera.height_px, camera.fx_px, camera.fy_px, camera.cx_px, camera.cy_px);
  return text;
}

std::string TimestampsCsv(const RecordingOptions& options) {
  std::string csv = "ImageID,TimeStamp\n";
  for (int i = options.first_frame; i < options.TotalFrames(); ++i) {
    const std::int64_t later_ns = i < options.num_frames ? 0 : kBetweenWalks_ns;
    csv += FrameId(i) + "," + std::to_string(kFirstStamp_ns + i * kFramePeriod_ns + later_ns) + "\n";
  }
  return csv;
}

Status MakeFolder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  return error ? Unavailable("cannot make " + folder.string() + ": " + error.message()) : Status::Ok();
}

/// Writes frames independently, so that threads may share it.
class FrameWriter {
 public:
  FrameWriter(const ApartmentScene& scene, const RecordingOptions& options)
      : scene_(scene), options_(options), renderer_(scene) {}

  [[nodiscard]] Result<std::vector<InstanceView>> Write(int frame_number) const {
    const RenderedFrame frame =
        renderer_.Render(FlatLayoutCamera(options_.width_px, options_.height_px),
                         path_.PoseOfFrame(frame_number % options_.num_frames, options_.num_frames));
    const auto number = static_cast<std::uint64_t>(frame_number);
    const std::string start = (options_.directory / options_.run / FrameId(frame_number)).string();
    DHPMAP_RETURN_IF_ERROR(WriteText(start + "_pose.txt", PoseText(frame.T_map_camera)));
    DHPMAP_RETURN_IF_ERROR(WriteColorPng(start + "_color.png", options_.width_px, frame.color));
    DHPMAP_RETURN_IF_ERROR(WriteDepthTiff(
        start + "_depth.tiff", options_.width_px,
        options_.has_depth_noise ? NoisyDepth(frame, options_.noise_level, options_.seed, number) : frame.depth_m));
    DHPMAP_RETURN_IF_ERROR(WriteIdPng(start + "_segmentation.png", options_.width_px, frame.instances));
    if (options_.has_predictions) {
      const PanopticNoise noise = PanopticNoise().Times(options_.noise_level);
      const Prediction predicted = PredictPanoptic(frame, scene_.instances(), noise, options_.seed, number);
      DHPMAP_RETURN_IF_ERROR(WriteIdPng(start + "_predicted.png", options_.width_px, predicted.ids));
      DHPMAP_RETURN_IF_ERROR(
          WriteText(start + "_labels.json", SegmentsJson(predicted.segments, options_.has_class_scores)));
    }
    return ViewsOfInstances(frame, scene_.instances().size());
  }

 private:
  const ApartmentScene& scene_;
  const RecordingOptions& options_;
  const Renderer renderer_;
  const CameraPath path_;
};

Status WriteTables(const ApartmentScene& scene, const RecordingOptions& options,
                   const std::vector<InstanceView>& views) {
  const fs::path& folder = options.directory;
  const PinholeCamera camera = FlatLayoutCamera(options.width_px, options.height_px);
  DHPMAP_RETURN_IF_ERROR(WriteText(folder / "camera.txt", CameraText(camera)));
  DHPMAP_RETURN_IF_ERROR(WriteText(folder / "groundtruth_labels.csv", GroundTruthTable(scene.instances())));
  if (options.has_predictions) DHPMAP_RETURN_IF_ERROR(WriteText(folder / "detectron_labels.csv", CategoryTable()));
  DHPMAP_RETURN_IF_ERROR(WriteText(folder / "truth.json", TruthJson(scene, views)));
  // Last, so that an interrupted recording is not mistaken for a complete one.
  return WriteText(folder / options.run / "timestamps.csv", TimestampsCsv(options));
}

/// The first error of any thread. Thread-safe.
class FirstError {
 public:
  void Offer(const Status& error) {
    const MutexLock lock(mutex_);
    if (error_.ok()) error_ = error;
  }
  [[nodiscard]] Status Get() {
    const MutexLock lock(mutex_);
    return error_;
  }

 private:
  Mutex mutex_;
  Status error_ DHPMAP_GUARDED_BY(mutex_);
};

/// Writes all frames, spread over the threads; returns their views. `after` writes those of a second walk.
Result<std::vector<std::vector<InstanceView>>> WriteFrames(const FrameWriter& before, const FrameWriter& after,
                                                           const RecordingOptions& options, ThreadPool& threads,
                                                           const std::function<void()>& on_frame_done) {
  std::vector<std::vector<InstanceView>> views_of_frames(
      static_cast<std::size_t>(options.TotalFrames() - options.first_frame));
  FirstError first_error;
  threads.ParallelFor(views_of_frames.size(), [&](std::size_t i) {
    if (!first_error.Get().ok()) return;
    const int frame = options.first_frame + static_cast<int>(i);
    Result<std::vector<InstanceView>> views = (frame < options.num_frames ? before : after).Write(frame);
    if (views.ok()) {
      views_of_frames[i] = std::move(*views);
      if (on_frame_done) on_frame_done();
      return;
    }
    first_error.Offer(views.status());
  });
  DHPMAP_RETURN_IF_ERROR(first_error.Get());
  return views_of_frames;
}

}  // namespace

Status RecordingOptions::Validate() const {
  Status status = InvalidArgument("the recording cannot be made");
  const auto check = [&status](const char* name, int value, int min, int max) {
    if (value >= min && value <= max) return;
    status.AddViolation(
        name, "must be " + std::to_string(min) + " to " + std::to_string(max) + ", not " + std::to_string(value));
  };
  check("frames", num_frames, 1, kMaxFrames);
  check("start", first_frame, 0, std::clamp(num_frames, 1, kMaxFrames) - 1);
  check("change", num_changed, 0, kMaxChanged);
  check("width", width_px, kMinSide_px, kMaxSide_px);
  check("height", height_px, kMinSide_px, kMaxSide_px);
  if (!(noise_level >= 0 && noise_level <= kMaxNoiseLevel)) {
    status.AddViolation("noise", "must be 0 to 5, not " + std::to_string(noise_level));
  }
  if (run.empty() || run.find('/') != std::string::npos || run == "." || run == "..") {
    status.AddViolation("run", "must be the name of a folder, not '" + run + "'");
  }
  return status.violations().empty() ? Status::Ok() : status;
}

Result<std::vector<InstanceView>> RecordApartment(const ApartmentScene& scene, const RecordingOptions& options,
                                                  ThreadPool& threads, const std::function<void()>& on_frame_done) {
  DHPMAP_RETURN_IF_ERROR(options.Validate());
  DHPMAP_RETURN_IF_ERROR(MakeFolder(options.directory / options.run));
  DHPMAP_ASSIGN_OR_RETURN(const std::vector<Change> changes, ChooseChanges(scene, options.num_changed, options.seed));
  const ApartmentScene scene_after = Changed(scene, changes);
  const FrameWriter before(scene, options), after(scene_after, options);
  DHPMAP_ASSIGN_OR_RETURN(const auto views_of_frames, WriteFrames(before, after, options, threads, on_frame_done));
  std::vector<InstanceView> views(scene.instances().size());
  const std::size_t first =
      options.num_changed > 0 ? views_of_frames.size() - static_cast<std::size_t>(options.num_frames) : 0;
  for (std::size_t frame = first; frame < views_of_frames.size(); ++frame) {
    for (std::size_t id = 0; id < views.size(); ++id) views[id].Join(views_of_frames[frame][id]);
  }
  if (options.num_changed > 0) {
    DHPMAP_RETURN_IF_ERROR(
        WriteText(options.directory / "changes.json", ChangesJson(scene, changes, options.num_frames)));
  }
  DHPMAP_RETURN_IF_ERROR(WriteTables(scene_after, options, views));
  return views;
}

}  // namespace dhpmap::simulator

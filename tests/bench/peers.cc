// SPDX-License-Identifier: BSD-3-Clause
// Runs other systems, as Debian packages them, on the frames of `dhpmap-bench fusion`: the ratio, in one run, on one
// machine. Open3D's volume projects and OctoMap keeps occupancy only, so both do less than ray-traced fusion with
// labels.
#include <octomap/octomap.h>
#include <open3d/camera/PinholeCameraIntrinsic.h>
#include <open3d/geometry/Image.h>
#include <open3d/geometry/RGBDImage.h>
#include <open3d/pipelines/integration/ScalableTSDFVolume.h>
#include <stdlib.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <chrono>
#include <cstdio>
#include <cstring>

#include "tests/bench/frames.h"

namespace dhpmap::bench {
namespace {

struct PeerOptions {
  std::string directory;
  double voxel_size_m = 0.04;
  double truncation_m = 0.08;
  double max_range_m = 5.0;
  std::size_t num_frames = 0;
};

template <typename Integrate>
void Time(const char* name, const std::vector<PanopticFrame>& frames, Integrate&& integrate) {
  std::vector<double> times_ms;
  for (const PanopticFrame& frame : frames) {
    if (!frame.camera) continue;
    times_ms.push_back(integrate(frame));
  }
  const Summary summary = Summarize(times_ms);
  std::printf("%-34s mean %7.2f  median %7.2f  p95 %7.2f ms a frame\n", name, summary.mean, summary.median,
              summary.p95);
}

double MillisecondsSince(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

void RunOpen3d(const PeerOptions& options, const std::vector<PanopticFrame>& frames, int depth_stride) {
  using open3d::pipelines::integration::ScalableTSDFVolume;
  ScalableTSDFVolume volume(options.voxel_size_m, options.truncation_m,
                            open3d::pipelines::integration::TSDFVolumeColorType::RGB8, 16, depth_stride);
  const std::string name = "Open3D ScalableTSDF, stride " + std::to_string(depth_stride);
  Time(name.c_str(), frames, [&](const PanopticFrame& frame) {
    const DepthCameraData& data = *frame.camera;
    const PinholeCamera& c = data.camera;
    open3d::geometry::RGBDImage image;
    image.depth_.Prepare(c.width_px, c.height_px, 1, 4);
    image.color_.Prepare(c.width_px, c.height_px, 3, 1);
    auto* depth = reinterpret_cast<float*>(image.depth_.data_.data());
    for (std::size_t i = 0; i < data.depth_m.size(); ++i) {
      depth[i] = data.depth_m[i] <= options.max_range_m ? data.depth_m[i] : 0.0f;
    }
    std::memcpy(image.color_.data_.data(), data.color.data(), data.color.size() * sizeof(Color));
    const open3d::camera::PinholeCameraIntrinsic intrinsic(c.width_px, c.height_px, c.fx_px, c.fy_px, c.cx_px, c.cy_px);
    const Eigen::Matrix4d T_camera_map = frame.T_map_sensor.inverse().matrix();
    const auto start = std::chrono::steady_clock::now();
    volume.Integrate(image, intrinsic, T_camera_map);
    return MillisecondsSince(start);
  });
}

void RunOctomap(const PeerOptions& options, const std::vector<PanopticFrame>& frames) {
  octomap::OcTree tree(options.voxel_size_m);
  Time("OctoMap insertPointCloud, discrete", frames, [&](const PanopticFrame& frame) {
    const DepthCameraData& data = *frame.camera;
    const PinholeCamera& c = data.camera;
    octomap::Pointcloud cloud;
    for (int v = 0; v < c.height_px; ++v) {
      for (int u = 0; u < c.width_px; ++u) {
        const double depth = data.depth_m[static_cast<std::size_t>(v) * static_cast<std::size_t>(c.width_px) +
                                          static_cast<std::size_t>(u)];
        if (!(depth > 0)) continue;
        const Eigen::Vector3d p = frame.T_map_sensor * Eigen::Vector3d((u - c.cx_px) / c.fx_px * depth,
                                                                       (v - c.cy_px) / c.fy_px * depth, depth);
        cloud.push_back(static_cast<float>(p.x()), static_cast<float>(p.y()), static_cast<float>(p.z()));
      }
    }
    const Eigen::Vector3f o = frame.T_map_sensor.translation().cast<float>();
    const auto start = std::chrono::steady_clock::now();
    tree.insertPointCloud(cloud, octomap::point3d(o.x(), o.y(), o.z()), options.max_range_m, true, true);
    return MillisecondsSince(start);
  });
}

}  // namespace
}  // namespace dhpmap::bench

int main(int argc, char** argv) {
  // Open3D takes its thread count from the environment, before main.
  if (getenv("OMP_NUM_THREADS") == nullptr) {
    setenv("OMP_NUM_THREADS", "1", 1);
    execv("/proc/self/exe", argv);
  }
  dhpmap::bench::PeerOptions options;
  CLI::App app{"Times other systems on the frames of `dhpmap-bench fusion`, on one thread"};
  app.add_option("directory", options.directory, "Data set with depth images")->required();
  app.add_option("--voxel", options.voxel_size_m, "Voxel size in m")->capture_default_str();
  app.add_option("--truncation", options.truncation_m, "Truncation in m")->capture_default_str();
  app.add_option("--max-range", options.max_range_m, "Range limit in m")->capture_default_str();
  app.add_option("--frames", options.num_frames, "Frames, 0 = all");
  CLI11_PARSE(app, argc, argv);
  const auto loaded = dhpmap::bench::LoadFrames(options.directory, dhpmap::LabelSource::kNone, options.num_frames);
  if (!loaded.ok()) {
    std::fprintf(stderr, "dhpmap-bench-peers: %s\n", loaded.status().ToString().c_str());
    return 1;
  }
  dhpmap::bench::RunOpen3d(options, loaded->frames, 4);
  dhpmap::bench::RunOpen3d(options, loaded->frames, 1);
  dhpmap::bench::RunOctomap(options, loaded->frames);
  return 0;
}

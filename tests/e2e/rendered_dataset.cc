// SPDX-License-Identifier: BSD-3-Clause
#include "tests/e2e/rendered_dataset.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <fstream>
#include <iomanip>
#include <opencv2/imgcodecs.hpp>
#include <sstream>
#include <string>
#include <utility>

#include "tests/support/scenes.h"

namespace dhpmap::testing {
namespace {

Scene Room() {
  using Shape = Solid::Shape;
  return {{{Shape::kHalfSpace, {0, 0, 0}, {0, 0, 1}, 1, {120, 90, 60}},
           {Shape::kHalfSpace, {2.5, 0, 0}, {-1, 0, 0}, 2, {200, 200, 190}},
           {Shape::kSphere, {1.5, -0.5, 0.35}, {0.35, 0, 0}, 3, {220, 30, 30}},
           {Shape::kBox, {1.6, 0.6, 0.3}, {0.25, 0.3, 0.3}, 4, {30, 60, 210}}}};
}

/// A number that means nothing across frames.
int FramewiseId(int segment, int index) { return 1 + (segment * 5 + index * 3) % 7; }

std::string IdOf(int index) {
  const std::string number = std::to_string(index);
  return std::string(6 - number.size(), '0') + number;
}

void WriteFrame(const std::filesystem::path& run, const std::string& id, const PanopticFrame& frame, int index) {
  const DepthCameraData& data = *frame.camera;
  const int rows = data.camera.height_px, columns = data.camera.width_px;
  cv::Mat depth(rows, columns, CV_32FC1), color(rows, columns, CV_8UC3), truth(rows, columns, CV_8UC1),
      predicted(rows, columns, CV_8UC1);
  for (int i = 0; i < rows * columns; ++i) {
    const auto pixel = static_cast<std::size_t>(i);
    const int v = i / columns, u = i % columns, segment = static_cast<int>(data.segments[pixel]);
    depth.at<float>(v, u) = data.depth_m[pixel];
    color.at<cv::Vec3b>(v, u) = {data.color[pixel].b, data.color[pixel].g, data.color[pixel].r};
    truth.at<unsigned char>(v, u) = static_cast<unsigned char>(segment);
    predicted.at<unsigned char>(v, u) = static_cast<unsigned char>(segment == 0 ? 0 : FramewiseId(segment, index));
  }
  cv::imwrite((run / (id + "_depth.tiff")).string(), depth);
  cv::imwrite((run / (id + "_color.png")).string(), color);
  cv::imwrite((run / (id + "_segmentation.png")).string(), truth);
  cv::imwrite((run / (id + "_predicted.png")).string(), predicted);
  std::ofstream(run / (id + "_pose.txt")) << std::setprecision(12) << frame.T_map_sensor.matrix() << "\n";
  std::ofstream labels(run / (id + "_labels.json"));
  for (int segment = 1; segment <= 4; ++segment) {
    labels << (segment == 1 ? "[" : ",") << R"({"id":)" << FramewiseId(segment, index) << R"(,"category_id":)"
           << segment << R"(,"score":0.9})";
  }
  labels << "]\n";
}

}  // namespace

void WriteRenderedDataset(const std::filesystem::path& root, int num_frames) {
  const std::filesystem::path run = root / "run1";
  std::filesystem::create_directories(run);
  const PinholeCamera camera = SmallCamera();
  std::ofstream(run / "camera.txt") << camera.width_px << " " << camera.height_px << " " << camera.fx_px << " "
                                    << camera.fy_px << " " << camera.cx_px << " " << camera.cy_px << "\n";
  std::ofstream(root / "groundtruth_labels.csv")
      << "InstanceID,ClassID,PanopticID,R,G,B,Name,Size\n1,1,0,9,9,9,Floor,L\n2,2,0,99,99,99,Wall,L\n"
         "3,3,1,200,0,0,Ball_01_001,S\n4,4,1,0,0,200,Box_01_001,S\n";
  std::ofstream(root / "detectron_labels.csv") << "InstanceID,ClassID,PanopticID,Name,Size\n0,0,0,unknown,M\n1,1,0,"
                                                  "floor,L\n2,2,0,wall,L\n3,3,1,ball,S\n4,4,1,box,S\n";
  std::ofstream timestamps(run / "timestamps.csv");
  timestamps << "ImageID,TimeStamp\n";
  const Scene scene = Room();
  for (int i = 0; i < num_frames; ++i) {
    const Transform T_map_camera = LookAt({-0.3, -0.8 + 1.6 * i / num_frames, 1.1}, {1.6, 0, 0.4});
    const std::string id = IdOf(i);
    timestamps << id << "," << 1'000'000'000 + 100'000'000LL * i << "\n";
    WriteFrame(run, id, Render(scene, camera, T_map_camera), i);
  }
}

HeldFrame::HeldFrame(const std::filesystem::path& root, int index)
    : file_(root / "run1" / (IdOf(index) + "_pose.txt")) {
  std::ostringstream text;
  text << std::ifstream(file_).rdbuf();
  content_ = text.str();
  std::filesystem::remove(file_);
  EXPECT_EQ(::mkfifo(file_.c_str(), 0600), 0) << file_;
  pipe_ = ::open(file_.c_str(), O_RDWR | O_CLOEXEC);
  EXPECT_GE(pipe_, 0) << file_;
}

/// What has begun to read gets it through the pipe, what comes later from the file.
void HeldFrame::Release() {
  if (pipe_ < 0) return;
  const std::filesystem::path whole = file_.string() + ".whole";
  std::ofstream(whole) << content_;
  std::filesystem::rename(whole, file_);  // there is a file or the pipe at any moment
  EXPECT_EQ(::write(pipe_, content_.data(), content_.size()), static_cast<ssize_t>(content_.size()));
  ::close(std::exchange(pipe_, -1));
}

}  // namespace dhpmap::testing

// SPDX-License-Identifier: BSD-3-Clause
// Draws a PLY file that the server wrote, to look at: a plain z-buffer with diffuse light, at twice the size and then
// averaged, so that edges are smooth.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <iterator>
#include <limits>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <string>
#include <vector>

#include "mapping/base/transform.h"

namespace dhpmap::bench {
namespace {

struct Vertex {
  Eigen::Vector3d p;
  Eigen::Vector3d n;
  Eigen::Vector3d rgb;
};
struct Soup {
  std::vector<Vertex> vertices;
  std::vector<std::array<std::uint32_t, 3>> triangles;
};

template <typename T>
T Take(const char*& at) {
  T value;
  std::memcpy(&value, at, sizeof(T));
  at += sizeof(T);
  return value;
}

/// The layout of WritePly: x y z nx ny nz (float), red green blue (uchar), class (ushort), instance (uint).
Soup ReadPly(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  const std::string file((std::istreambuf_iterator<char>(in)), {});
  const std::size_t header_end = file.find("end_header\n");
  if (header_end == std::string::npos) return {};
  const auto count_of = [&](const std::string& element) {
    const std::size_t at = file.find("element " + element + " ");
    return at == std::string::npos || at > header_end ? 0ul : std::stoul(file.substr(at + element.size() + 9));
  };
  const char* at = file.data() + header_end + 11;
  Soup soup;
  soup.vertices.resize(count_of("vertex"));
  for (Vertex& v : soup.vertices) {
    for (int i = 0; i < 3; ++i) v.p[i] = Take<float>(at);
    for (int i = 0; i < 3; ++i) v.n[i] = Take<float>(at);
    for (int i = 0; i < 3; ++i) v.rgb[i] = Take<std::uint8_t>(at);
    at += sizeof(std::uint16_t) + sizeof(std::uint32_t);
  }
  soup.triangles.resize(count_of("face"));
  for (auto& triangle : soup.triangles) {
    at += 1;
    for (std::uint32_t& corner : triangle) corner = static_cast<std::uint32_t>(Take<std::int32_t>(at));
  }
  return soup;
}

struct View {
  Transform T_camera_map;
  int width_px, height_px;
  double focal_px;
  bool hides_back_faces;
};

void Draw(const Soup& soup, const View& view, cv::Mat& image) {
  image = cv::Mat(view.height_px, view.width_px, CV_8UC3, cv::Scalar(232, 232, 232));
  std::vector<double> depth(static_cast<std::size_t>(view.width_px * view.height_px),
                            std::numeric_limits<double>::infinity());
  for (const auto& triangle : soup.triangles) {
    Eigen::Vector3d c[3], s[3];
    bool in_front = true;
    for (int i = 0; i < 3; ++i) {
      c[i] = view.T_camera_map * soup.vertices[triangle[static_cast<std::size_t>(i)]].p;
      in_front = in_front && c[i].z() > 0.05;
      s[i] = {view.focal_px * c[i].x() / c[i].z() + view.width_px / 2.0,
              view.focal_px * c[i].y() / c[i].z() + view.height_px / 2.0, c[i].z()};
    }
    if (!in_front) continue;
    const Eigen::Vector3d face = (c[1] - c[0]).cross(c[2] - c[0]);
    if (view.hides_back_faces && face.dot(c[0]) > 0) continue;
    const double light = 0.35 + 0.65 * std::abs(face.normalized().dot(Eigen::Vector3d(0.3, -0.6, -0.74).normalized()));
    const double area = (s[1].x() - s[0].x()) * (s[2].y() - s[0].y()) - (s[2].x() - s[0].x()) * (s[1].y() - s[0].y());
    if (std::abs(area) < 1e-12) continue;
    const auto bound = [&](int axis, bool low, int limit) {
      const double value = low ? std::floor(std::min({s[0][axis], s[1][axis], s[2][axis]}))
                               : std::ceil(std::max({s[0][axis], s[1][axis], s[2][axis]}));
      return std::clamp(static_cast<int>(std::clamp(value, -1.0, 1e5)), 0, limit - 1);
    };
    for (int y = bound(1, true, view.height_px); y <= bound(1, false, view.height_px); ++y) {
      for (int x = bound(0, true, view.width_px); x <= bound(0, false, view.width_px); ++x) {
        const double w1 = ((x - s[0].x()) * (s[2].y() - s[0].y()) - (s[2].x() - s[0].x()) * (y - s[0].y())) / area;
        const double w2 = ((s[1].x() - s[0].x()) * (y - s[0].y()) - (x - s[0].x()) * (s[1].y() - s[0].y())) / area;
        if (w1 < 0 || w2 < 0 || w1 + w2 > 1) continue;
        const double z = (1 - w1 - w2) * s[0].z() + w1 * s[1].z() + w2 * s[2].z();
        double& nearest = depth[static_cast<std::size_t>(y * view.width_px + x)];
        if (z >= nearest) continue;
        nearest = z;
        const Eigen::Vector3d rgb = light * ((1 - w1 - w2) * soup.vertices[triangle[0]].rgb +
                                             w1 * soup.vertices[triangle[1]].rgb + w2 * soup.vertices[triangle[2]].rgb);
        image.at<cv::Vec3b>(y, x) = {static_cast<std::uint8_t>(rgb.z()), static_cast<std::uint8_t>(rgb.y()),
                                     static_cast<std::uint8_t>(rgb.x())};
      }
    }
  }
}

cv::Mat DrawSmooth(const Soup& soup, View view) {
  constexpr int kTimes = 2;
  const cv::Size size(view.width_px, view.height_px);
  view.width_px *= kTimes, view.height_px *= kTimes, view.focal_px *= kTimes;
  cv::Mat large, image;
  Draw(soup, view, large);
  cv::resize(large, image, size, 0, 0, cv::INTER_AREA);
  return image;
}

/// `left`, at the height of `right`, beside it.
cv::Mat SideBySide(const cv::Mat& left, const cv::Mat& right) {
  cv::Mat scaled, both;
  cv::resize(left, scaled, cv::Size(left.cols * right.rows / left.rows, right.rows), 0, 0, cv::INTER_AREA);
  cv::hconcat(scaled, right, both);
  return both;
}

}  // namespace
}  // namespace dhpmap::bench

int main(int argc, char** argv) {
  std::string ply, out, beside;
  std::vector<double> eye = {0, 0, 10}, target = {0, 0, 0};
  dhpmap::bench::View view{dhpmap::Transform::Identity(), 1200, 800, 900, true};
  CLI::App app{"Draws a PLY file of the map server as a PNG or JPEG"};
  app.add_option("ply", ply)->required();
  app.add_option("out", out)->required();
  app.add_option("--beside", beside, "A picture to put on the left")->check(CLI::ExistingFile);
  app.add_option("--eye", eye, "Camera position in m")->expected(3);
  app.add_option("--target", target, "Point in the middle of the picture, in m")->expected(3);
  app.add_option("--width", view.width_px);
  app.add_option("--height", view.height_px);
  app.add_option("--focal", view.focal_px, "Focal length in pixels");
  bool shows_back_faces = false;
  app.add_flag("--back-faces", shows_back_faces, "Draw surfaces seen from behind too (ceilings, from above)");
  CLI11_PARSE(app, argc, argv);
  view.hides_back_faces = !shows_back_faces;

  const Eigen::Vector3d from(eye[0], eye[1], eye[2]), to(target[0], target[1], target[2]);
  const Eigen::Vector3d forward = (to - from).normalized();
  Eigen::Vector3d right = forward.cross(Eigen::Vector3d::UnitZ());
  if (right.norm() < 1e-6) right = Eigen::Vector3d::UnitX();
  right.normalize();
  dhpmap::Transform T_map_camera = dhpmap::Transform::Identity();
  T_map_camera.linear().col(0) = right;
  T_map_camera.linear().col(1) = forward.cross(right);
  T_map_camera.linear().col(2) = forward;
  T_map_camera.translation() = from;
  view.T_camera_map = T_map_camera.inverse();

  const dhpmap::bench::Soup soup = dhpmap::bench::ReadPly(ply);
  if (soup.triangles.empty()) {
    std::fprintf(stderr, "render-ply: no triangles in %s\n", ply.c_str());
    return 1;
  }
  cv::Mat image = dhpmap::bench::DrawSmooth(soup, view);
  if (!beside.empty()) {
    const cv::Mat left = cv::imread(beside);
    if (left.empty()) {
      std::fprintf(stderr, "render-ply: %s is no picture\n", beside.c_str());
      return 1;
    }
    image = dhpmap::bench::SideBySide(left, image);
  }
  return cv::imwrite(out, image) ? 0 : 1;
}

// SPDX-License-Identifier: BSD-3-Clause
#include "clients/evaluator/pictures.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>

namespace dhpmap::evaluator {
namespace {

constexpr double kLongSide_px = 1600;
constexpr double kCutAboveFloor_m = 2.0;
constexpr float kFloorShare = 0.02f;  // of the samples lie below the floor: noise
constexpr Color kBackground{255, 255, 255}, kNotJudged{225, 225, 225};
constexpr Color kRight{150, 150, 150}, kWrongClass{214, 39, 40}, kWrongInstance{255, 150, 30}, kMissing{31, 80, 200};

Color LabelColor(const ElementLabel& label) {
  if (label.class_index == ClassMap::kNone) return kNotJudged;
  constexpr std::uint32_t kStuffColors = 100'003;  // away from the ids of instances
  return ColorOfId(label.instance != 0 ? label.instance : kStuffColors + static_cast<std::uint32_t>(label.class_index));
}

Color ErrorColor(const ElementLabel& truth, const ElementLabel& predicted, const PanopticScore& panoptics) {
  if (truth.class_index == ClassMap::kNone) return kNotJudged;
  if (predicted.class_index == ClassMap::kNone) return kMissing;
  if (predicted.class_index != truth.class_index) return kWrongClass;
  return panoptics.matches.contains({truth, predicted}) ? kRight : kWrongInstance;
}

/// Looks along -z of `R_view_map`, without perspective.
class Picture {
 public:
  Picture(const std::vector<Eigen::Vector3f>& points_m, const Eigen::Matrix3f& R_view_map, double spacing_m)
      : R_view_map_(R_view_map) {
    Eigen::Vector3f low = Eigen::Vector3f::Constant(std::numeric_limits<float>::max()), high = -low;
    for (const auto& p : points_m) {
      const Eigen::Vector3f q = R_view_map * p;
      low = low.cwiseMin(q);
      high = high.cwiseMax(q);
    }
    if (points_m.empty()) low.setZero(), high.setZero();
    origin_ = low;
    const float long_side_m = std::max({high.x() - low.x(), high.y() - low.y(), 0.1f});
    px_per_m_ = static_cast<float>(std::min(kLongSide_px / long_side_m, 1.0 / spacing_m));
    width_ = static_cast<int>((high.x() - low.x()) * px_per_m_) + 2;
    height_ = static_cast<int>((high.y() - low.y()) * px_per_m_) + 2;
    image_ = cv::Mat(height_, width_, CV_8UC3, cv::Scalar(kBackground.b, kBackground.g, kBackground.r));
    nearness_.assign(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_),
                     -std::numeric_limits<float>::infinity());
  }

  void Draw(const Eigen::Vector3f& p_m, Color color) {
    const Eigen::Vector3f q = R_view_map_ * p_m;
    const int u = static_cast<int>((q.x() - origin_.x()) * px_per_m_);
    const int v = height_ - 1 - static_cast<int>((q.y() - origin_.y()) * px_per_m_);
    for (const auto& [x, y] : {std::pair{u, v}, {u + 1, v}, {u, v - 1}, {u + 1, v - 1}}) {
      if (x < 0 || y < 0 || x >= width_ || y >= height_) continue;
      float& nearness =
          nearness_[static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x)];
      if (q.z() <= nearness) continue;
      nearness = q.z();
      image_.at<cv::Vec3b>(y, x) = {color.b, color.g, color.r};
    }
  }

  [[nodiscard]] const cv::Mat& image() const { return image_; }

 private:
  Eigen::Matrix3f R_view_map_;
  Eigen::Vector3f origin_;
  float px_per_m_ = 1;
  int width_ = 0, height_ = 0;
  cv::Mat image_;
  std::vector<float> nearness_;
};

Eigen::Matrix3f FromAbove() { return Eigen::Matrix3f::Identity(); }

/// From the south-west, 35 degrees above the horizon.
Eigen::Matrix3f FromCorner() {
  const Eigen::Vector3f right = Eigen::Vector3f(1, -1, 0).normalized();
  const Eigen::Vector3f back = Eigen::Vector3f(-1, -1, 1).normalized();
  Eigen::Matrix3f R;
  R << right.transpose(), back.cross(right).transpose(), back.transpose();
  return R;
}

/// Samples under the ceiling; outdoors there is none.
std::vector<std::uint32_t> Shown(const Truth& truth) {
  std::vector<float> heights;
  for (const auto& p : truth.samples().positions_m) heights.push_back(p.z());
  float cut_m = std::numeric_limits<float>::max();
  constexpr double kIndoorSpacing_m = 0.04;
  if (!heights.empty() && truth.protocol().spacing_m < kIndoorSpacing_m) {
    const auto floor = heights.begin() + static_cast<std::ptrdiff_t>(kFloorShare * static_cast<float>(heights.size()));
    std::nth_element(heights.begin(), floor, heights.end());
    cut_m = *floor + static_cast<float>(kCutAboveFloor_m);
  }
  std::vector<std::uint32_t> shown;
  for (std::size_t i = 0; i < truth.samples().size(); ++i) {
    if (truth.samples().positions_m[i].z() <= cut_m) shown.push_back(static_cast<std::uint32_t>(i));
  }
  return shown;
}

cv::Mat Below(const cv::Mat& top, const cv::Mat& bottom) {
  cv::Mat both(top.rows + bottom.rows, std::max(top.cols, bottom.cols), CV_8UC3, cv::Scalar(255, 255, 255));
  top.copyTo(both(cv::Rect(0, 0, top.cols, top.rows)));
  bottom.copyTo(both(cv::Rect(0, top.rows, bottom.cols, bottom.rows)));
  return both;
}

template <typename ColorOf>
Status Write(const Truth& truth, const std::vector<std::uint32_t>& shown, const std::string& path,
             const ColorOf& color_of) {
  const auto& all = truth.samples().positions_m;
  std::vector<Eigen::Vector3f> points_m;
  for (const std::uint32_t i : shown) points_m.push_back(all[i]);
  Picture above(points_m, FromAbove(), truth.protocol().spacing_m);
  Picture corner(points_m, FromCorner(), truth.protocol().spacing_m);
  for (const std::uint32_t i : shown) {
    above.Draw(all[i], color_of(i));
    corner.Draw(all[i], color_of(i));
  }
  try {
    if (cv::imwrite(path, Below(above.image(), corner.image()))) return Status::Ok();
  } catch (const cv::Exception&) {  // a folder that is none
  }
  return Unavailable("cannot write " + path);
}

}  // namespace

Status DrawPictures(const Truth& truth, const Scores& scores, const std::vector<ElementLabel>& labels,
                    const std::string& folder) {
  std::error_code ignored;
  std::filesystem::create_directories(folder, ignored);
  const std::vector<std::uint32_t> shown = Shown(truth);
  DHPMAP_RETURN_IF_ERROR(Write(truth, shown, folder + "/truth_labels.png",
                               [&](std::uint32_t i) { return LabelColor(truth.labels()[i]); }));
  DHPMAP_RETURN_IF_ERROR(Write(truth, shown, folder + "/" + scores.system + "_labels.png",
                               [&](std::uint32_t i) { return LabelColor(labels[i]); }));
  return Write(truth, shown, folder + "/" + scores.system + "_errors.png",
               [&](std::uint32_t i) { return ErrorColor(truth.labels()[i], labels[i], scores.panoptics); });
}

}  // namespace dhpmap::evaluator

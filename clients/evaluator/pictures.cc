// SPDX-License-Identifier: BSD-3-Clause
#include "clients/evaluator/pictures.h"

#include <filesystem>
#include <map>

#include "clients/evaluator/output.h"

namespace dhpmap::evaluator {
namespace {

using namespace error_colors;

/// Outdoors there are no ceilings to remove, and a scan sees walls from one side only.
Sides SidesOf(const Truth& truth) {
  constexpr double kIndoorSpacing_m = 0.04;
  return truth.protocol().spacing_m < kIndoorSpacing_m ? Sides::kFront : Sides::kBoth;
}

Eigen::Matrix3f FromAbove() { return Eigen::Matrix3f::Identity(); }

/// From the south-west, 35 degrees above the horizon.
Eigen::Matrix3f FromCorner() {
  const Eigen::Vector3f right = Eigen::Vector3f(1, -1, 0).normalized();
  const Eigen::Vector3f back = Eigen::Vector3f(-1, -1, 1).normalized();
  Eigen::Matrix3f R;
  R << right.transpose(), back.cross(right).transpose(), back.transpose();
  return R;
}

std::uint8_t Pale(std::uint8_t channel) {
  constexpr int kPaper = 238;
  return static_cast<std::uint8_t>((2 * channel + 3 * kPaper) / 5);
}

Color LabelColor(const ElementLabel& label) {
  if (label.class_index == ClassMap::kNone) return kNotJudged;
  if (label.instance != 0) return ColorOfId(label.instance);
  constexpr std::uint32_t kStuffColors = 100'003;  // distinct from the ids of instances
  const Color color = ColorOfId(kStuffColors + static_cast<std::uint32_t>(label.class_index));
  return {Pale(color.r), Pale(color.g), Pale(color.b)};
}

Color ErrorColor(const ElementLabel& truth, const ElementLabel& predicted, const PanopticScore& panoptics) {
  if (truth.class_index == ClassMap::kNone) return kNotJudged;
  if (predicted.class_index == ClassMap::kNone) return kMissing;
  if (predicted.class_index != truth.class_index) return kWrongClass;
  return panoptics.matches.contains({truth, predicted}) ? kRight : kWrongInstance;
}

std::vector<std::uint32_t> SampleOfTriangle(const Truth& truth) {
  std::vector<std::uint32_t> samples(truth.mesh().triangles.size(), Neighbour::kNone);
  const SurfaceSamples& all = truth.samples();
  for (std::size_t i = all.size(); i-- > 0;) samples[all.triangles[i]] = static_cast<std::uint32_t>(i);
  for (std::size_t t = 0; t < samples.size(); ++t) {
    if (samples[t] != Neighbour::kNone) continue;
    const auto& [a, b, c] = truth.mesh().triangles[t];
    const auto& vertices_m = truth.mesh().vertices_m;
    const Eigen::Vector3f middle_m = (vertices_m[a] + vertices_m[b] + vertices_m[c]) / 3;
    samples[t] = truth.nearest().Find(middle_m, truth.protocol().d_match_m).index;
  }
  return samples;
}

}  // namespace

TruthPictures::TruthPictures(const Truth& truth, int long_side_px)
    : truth_(truth),
      corner_(truth.mesh(), FromCorner(), SidesOf(truth), long_side_px),
      above_(truth.mesh(), FromAbove(), SidesOf(truth), long_side_px),
      sample_of_triangle_(SampleOfTriangle(truth)) {}

PicturePair TruthPictures::Paint(const std::function<Color(std::uint32_t sample)>& color_of) const {
  const auto of_triangle = [&](std::uint32_t triangle) {
    const std::uint32_t sample = sample_of_triangle_[triangle];
    return sample == Neighbour::kNone ? kNotJudged : color_of(sample);
  };
  return {.corner = corner_.Paint(of_triangle), .above = above_.Paint(of_triangle)};
}

PicturePair TruthPictures::Seen() const {
  const Mesh& mesh = truth_.mesh();
  const auto of_triangle = [&mesh](std::uint32_t triangle) { return mesh.colors[mesh.triangles[triangle][0]]; };
  return {.corner = corner_.Paint(of_triangle), .above = above_.Paint(of_triangle)};
}

PicturePair TruthPictures::TruthLabels() const {
  return Paint([this](std::uint32_t i) { return LabelColor(truth_.labels()[i]); });
}

PicturePair TruthPictures::Labels(const Scores& scores, const std::vector<ElementLabel>& labels) const {
  std::map<ElementLabel, ElementLabel> truth_of;
  for (const auto& [truth, predicted] : scores.panoptics.matches) truth_of[predicted] = truth;
  return Paint([&](std::uint32_t i) {
    const auto match = truth_of.find(labels[i]);
    return LabelColor(match == truth_of.end() ? labels[i] : match->second);
  });
}

PicturePair TruthPictures::Errors(const Scores& scores, const std::vector<ElementLabel>& labels) const {
  return Paint([&](std::uint32_t i) { return ErrorColor(truth_.labels()[i], labels[i], scores.panoptics); });
}

Status WritePictures(const TruthPictures& pictures, const Scores& scores, const std::vector<ElementLabel>& labels,
                     const std::string& folder) {
  std::error_code ignored;
  std::filesystem::create_directories(folder, ignored);
  const auto write = [&folder](const std::string& name, const PicturePair& pair) {
    return WriteText(folder + "/" + name + ".png", Encode(Below(pair.above, pair.corner), PictureFormat::kPng));
  };
  DHPMAP_RETURN_IF_ERROR(write("truth_labels", pictures.TruthLabels()));
  DHPMAP_RETURN_IF_ERROR(write(scores.system + "_labels", pictures.Labels(scores, labels)));
  return write(scores.system + "_errors", pictures.Errors(scores, labels));
}

}  // namespace dhpmap::evaluator

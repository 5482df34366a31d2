// SPDX-License-Identifier: BSD-3-Clause
#include "clients/simulator/panoptic_noise.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>
#include <utility>

#include "clients/simulator/random.h"

namespace dhpmap::simulator {
namespace {

constexpr int kMinSharedBorder_px = 4;
constexpr float kSharedBorder_m = 0.3f;
constexpr std::size_t kNumIds = 256;
constexpr double kTruthIsSecondShare = 0.7;  // of misclassified things
constexpr double kSecondShare = 0.8;         // share of the remaining score that the second class gets

/// A smooth random displacement with the given RMS, interpolated between knots.
class ShiftField {
 public:
  ShiftField(int width_px, int height_px, double wave_px, double rms_px, Random& random)
      : step_px_(std::max(2.0, wave_px / 2)), columns_(static_cast<int>(width_px / step_px_) + 2) {
    // Interpolation between independent knots reduces the spread to this share (13/35 is the mean squared weight).
    constexpr double kKept = 2.0 * 13.0 / 35.0;
    const int rows = static_cast<int>(height_px / step_px_) + 2;
    knots_.resize(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows));
    for (double& knot : knots_) knot = random.Gaussian() * rms_px / kKept;
  }

  [[nodiscard]] double At(int u, int v) const {
    const double x = u / step_px_, y = v / step_px_;
    const int ix = static_cast<int>(x), iy = static_cast<int>(y);
    const double fx = Smooth(x - ix), fy = Smooth(y - iy);
    const double low = std::lerp(Knot(ix, iy), Knot(ix + 1, iy), fx);
    const double high = std::lerp(Knot(ix, iy + 1), Knot(ix + 1, iy + 1), fx);
    return std::lerp(low, high, fy);
  }

 private:
  static double Smooth(double t) { return t * t * (3 - 2 * t); }
  [[nodiscard]] double Knot(int x, int y) const { return knots_[static_cast<std::size_t>(y * columns_ + x)]; }

  double step_px_;
  int columns_;
  std::vector<double> knots_;
};

/// Groups of ground-truth ids that the network merges.
class Groups {
 public:
  Groups() { std::iota(parent_.begin(), parent_.end(), std::uint8_t{0}); }
  [[nodiscard]] std::uint8_t Of(std::uint8_t id) const {
    while (parent_[id] != id) id = parent_[id];
    return id;
  }
  void Join(std::uint8_t a, std::uint8_t b) {
    const auto [low, high] = std::minmax({Of(a), Of(b)});
    parent_[high] = low;
  }

 private:
  std::array<std::uint8_t, kNumIds> parent_{};
};

/// A line through an image; one side of it is the second part of a split thing.
struct Cut {
  bool is_set = false;
  double u = 0, v = 0, normal_u = 0, normal_v = 0;
  [[nodiscard]] bool IsBehind(int x, int y) const { return is_set && (x - u) * normal_u + (y - v) * normal_v > 0; }
};

class Predictor {
 public:
  Predictor(const RenderedFrame& frame, std::span<const Instance> instances, const PanopticNoise& noise, Random random,
            Random score_random)
      : frame_(frame),
        instances_(instances),
        noise_(noise),
        random_(random),
        score_random_(score_random),
        width_(frame.camera.width_px),
        height_(frame.camera.height_px),
        scale_(width_ / 640.0) {}

  Prediction Run() {
    MergeStuff();
    MergeTouchingThings();
    Measure();
    DecideFates();
    DrawIds();
    PunchHoles();
    ShuffleIds();
    return std::move(prediction_);
  }

 private:
  [[nodiscard]] std::size_t At(int u, int v) const {
    return static_cast<std::size_t>(v) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(u);
  }
  [[nodiscard]] const ObjectClassInfo& ClassOf(std::uint8_t id) const { return InfoOf(instances_[id].object_class); }
  [[nodiscard]] bool IsThing(std::uint8_t id) const { return ClassOf(id).is_thing; }

  void MergeStuff() {
    for (std::size_t a = 1; a < instances_.size(); ++a) {
      for (std::size_t b = a + 1; b < instances_.size(); ++b) {
        if (!InfoOf(instances_[a].object_class).is_thing && instances_[a].object_class == instances_[b].object_class) {
          groups_.Join(static_cast<std::uint8_t>(a), static_cast<std::uint8_t>(b));
        }
      }
    }
  }

  void MergeTouchingThings() {
    std::vector<int> shared_px(kNumIds * kNumIds, 0);
    const auto visit = [&](std::size_t i, std::size_t j) {
      const auto [a, b] = std::minmax(frame_.instances[i], frame_.instances[j]);
      if (a == b || a == 0 || instances_[a].object_class != instances_[b].object_class || !IsThing(a)) return;
      if (std::abs(frame_.depth_m[i] - frame_.depth_m[j]) < kSharedBorder_m) ++shared_px[a * kNumIds + b];
    };
    for (int v = 0; v + 1 < height_; ++v) {
      for (int u = 0; u + 1 < width_; ++u) {
        visit(At(u, v), At(u + 1, v));
        visit(At(u, v), At(u, v + 1));
      }
    }
    for (std::size_t pair = 0; pair < shared_px.size(); ++pair) {
      if (shared_px[pair] < kMinSharedBorder_px || !random_.Chance(noise_.merged_share)) continue;
      groups_.Join(static_cast<std::uint8_t>(pair / kNumIds), static_cast<std::uint8_t>(pair % kNumIds));
      ++prediction_.errors.num_merged;
    }
  }

  void Measure() {
    std::array<double, kNumIds> own_area{};
    for (int v = 0; v < height_; ++v) {
      for (int u = 0; u < width_; ++u) {
        const std::uint8_t id = frame_.instances[At(u, v)], group = groups_.Of(id);
        ++own_area[id];
        ++area_[group];
        sum_u_[group] += u;
        sum_v_[group] += v;
        if (own_area[id] > own_area[largest_[group]]) largest_[group] = id;
      }
    }
  }

  void DecideFates() {
    const double least_px = noise_.min_area_px * scale_ * scale_;
    for (std::size_t i = 1; i < instances_.size(); ++i) {
      const auto group = static_cast<std::uint8_t>(i);
      if (groups_.Of(group) != group || area_[group] == 0) continue;
      if (!IsThing(group)) {
        first_part_[group] = second_part_[group] = AddSegment(group, instances_[group].object_class, 0);
      } else if (area_[group] >= least_px) {
        DecideThing(group);
      }
    }
  }

  void DecideThing(std::uint8_t group) {
    ++prediction_.errors.num_things;
    if (random_.Chance(noise_.missed_share)) {
      ++prediction_.errors.num_missed;
      return;
    }
    const bool is_wrong = random_.Chance(noise_.wrong_class_share);
    if (is_wrong) ++prediction_.errors.num_wrong_class;
    const ObjectClass said = is_wrong ? ClassOf(group).mistaken_for : instances_[group].object_class;
    first_part_[group] = second_part_[group] = AddSegment(group, said, Score(is_wrong));
    const bool is_large = area_[group] > noise_.large_area_share * width_ * height_;
    if (!is_large) return;
    ++prediction_.errors.num_large;
    if (!random_.Chance(noise_.split_share)) return;
    ++prediction_.errors.num_split;
    second_part_[group] = AddSegment(group, said, Score(is_wrong));
    const double angle = random_.Uniform(0, 2 * std::numbers::pi), spread = 0.15 * std::sqrt(area_[group]);
    cuts_[group] = {true, sum_u_[group] / area_[group] + spread * random_.Gaussian(),
                    sum_v_[group] / area_[group] + spread * random_.Gaussian(), std::cos(angle), std::sin(angle)};
  }

  float Score(bool is_wrong) {
    const double score = is_wrong ? random_.Uniform(0.5, 0.85) : 0.99 - 0.4 * std::pow(random_.Uniform(), 2);
    return Rounded(score);
  }

  /// Rounded as in files.
  static float Rounded(double score) { return static_cast<float>(std::round(score * 1000) / 1000); }

  std::uint8_t AddSegment(std::uint8_t group, ObjectClass object_class, float score) {
    const auto id = static_cast<std::uint8_t>(prediction_.segments.size() + 1);
    PredictedSegment segment{.id = id, .object_class = object_class, .score = score, .truth = largest_[group]};
    if (InfoOf(object_class).is_thing) {
      const ObjectClass truth = instances_[group].object_class;
      const bool knows_better = score_random_.Chance(kTruthIsSecondShare);
      segment.second_class = object_class != truth && knows_better ? truth : InfoOf(object_class).mistaken_for;
      segment.second_score = Rounded(kSecondShare * (1 - static_cast<double>(score)));
    }
    prediction_.segments.push_back(segment);
    return id;
  }

  /// Labels each pixel with the segment seen at a displaced pixel.
  void DrawIds() {
    const double rms_px = noise_.border_rms_px * scale_, wave_px = noise_.border_wave_px * scale_;
    const ShiftField shift_u(width_, height_, wave_px, rms_px, random_);
    const ShiftField shift_v(width_, height_, wave_px, rms_px, random_);
    prediction_.ids.assign(frame_.instances.size(), 0);
    for (int v = 0; v < height_; ++v) {
      for (int u = 0; u < width_; ++u) {
        const int x = std::clamp(static_cast<int>(std::lround(u + shift_u.At(u, v))), 0, width_ - 1);
        const int y = std::clamp(static_cast<int>(std::lround(v + shift_v.At(u, v))), 0, height_ - 1);
        const std::uint8_t group = groups_.Of(frame_.instances[At(x, y)]);
        prediction_.ids[At(u, v)] = cuts_[group].IsBehind(x, y) ? second_part_[group] : first_part_[group];
      }
    }
  }

  void PunchHoles() {
    const auto count = random_.Below(static_cast<std::uint32_t>(noise_.max_holes) + 1);
    for (std::uint32_t i = 0; i < count; ++i) {
      const double u0 = random_.Uniform(0, width_), v0 = random_.Uniform(0, height_);
      const double ru = random_.Uniform(0.25, 1) * noise_.max_hole_radius_px * scale_,
                   rv = ru * random_.Uniform(0.6, 1);
      const int last_u = std::min(width_ - 1, static_cast<int>(u0 + ru)),
                last_v = std::min(height_ - 1, static_cast<int>(v0 + rv));
      for (int v = std::max(0, static_cast<int>(v0 - rv)); v <= last_v; ++v) {
        for (int u = std::max(0, static_cast<int>(u0 - ru)); u <= last_u; ++u) {
          if (std::hypot((u - u0) / ru, (v - v0) / rv) < 1) prediction_.ids[At(u, v)] = 0;
        }
      }
    }
  }

  /// Assigns new ids in random order; drops segments without pixels.
  void ShuffleIds() {
    std::array<bool, kNumIds> is_seen{};
    for (std::uint8_t id : prediction_.ids) is_seen[id] = true;
    std::vector<PredictedSegment>& segments = prediction_.segments;
    std::erase_if(segments, [&](const PredictedSegment& segment) { return !is_seen[segment.id]; });
    for (std::size_t i = segments.size(); i > 1; --i) {
      std::swap(segments[i - 1], segments[random_.Below(static_cast<std::uint32_t>(i))]);
    }
    std::array<std::uint8_t, kNumIds> renamed{};
    for (std::size_t i = 0; i < segments.size(); ++i) {
      const auto id = static_cast<std::uint8_t>(i + 1);
      renamed[segments[i].id] = id;
      segments[i].id = id;
    }
    for (std::uint8_t& id : prediction_.ids) id = renamed[id];
  }

  const RenderedFrame& frame_;
  std::span<const Instance> instances_;
  const PanopticNoise& noise_;
  Random random_, score_random_;
  const int width_, height_;
  const double scale_;

  Groups groups_;
  // Indexed by group.
  std::array<double, kNumIds> area_{}, sum_u_{}, sum_v_{};
  std::array<std::uint8_t, kNumIds> largest_{}, first_part_{}, second_part_{};
  std::array<Cut, kNumIds> cuts_{};
  Prediction prediction_;
};

}  // namespace

PanopticNoise PanopticNoise::Times(double level) const {
  PanopticNoise noise = *this;
  for (double* share : {&noise.missed_share, &noise.wrong_class_share, &noise.merged_share, &noise.split_share}) {
    *share = std::min(0.9, level * *share);
  }
  noise.border_rms_px *= level;
  noise.max_holes = static_cast<int>(std::lround(level * max_holes));
  return noise;
}

Prediction PredictPanoptic(const RenderedFrame& frame, std::span<const Instance> instances, const PanopticNoise& noise,
                           std::uint64_t seed, std::uint64_t frame_number) {
  return Predictor(frame, instances, noise, Random(seed, frame_number, kPredictionStream),
                   Random(seed, frame_number, kScoreStream))
      .Run();
}

}  // namespace dhpmap::simulator

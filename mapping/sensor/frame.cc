// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/sensor/frame.h"

#include <algorithm>
#include <bitset>
#include <span>
#include <string>

namespace dhpmap {
namespace {

/// Two stamps within can be subtracted from each other, and no store takes others from a file.
constexpr std::int64_t kBeyondStamps_ns = std::int64_t{1} << 62;

constexpr std::size_t kMaxIdsNamed = 20;  // of ids without a row: a wrong table may miss thousands

constexpr float kMostInSum = 1.001f;  // of what a softmax in single precision may add up to

void CheckClassScores(const SegmentInfo& segment, const std::string& segment_field, const LabelSet& label_set,
                      Status& bad) {
  if (segment.class_scores.empty()) return;
  const std::string field = segment_field + ".class_scores";
  if (segment.class_scores.size() > kMostClassScores) {
    bad.AddViolation(field, "has " + std::to_string(segment.class_scores.size()) + " classes, more than " +
                                std::to_string(kMostClassScores));
    return;
  }
  float sum = 0;
  std::vector<ClassId> classes;
  classes.reserve(segment.class_scores.size());
  for (const ClassScore& entry : segment.class_scores) {
    if (!(entry.score >= 0.0f && entry.score <= 1.0f))
      bad.AddViolation(field, "of class " + std::to_string(entry.class_id.value) + " is not within 0 and 1");
    if (label_set.Find(entry.class_id) == nullptr)
      bad.AddViolation(field, "class " + std::to_string(entry.class_id.value) + " is not in the label set");
    sum += entry.score;
    classes.push_back(entry.class_id);
  }
  if (sum > kMostInSum) bad.AddViolation(field, "add up to " + std::to_string(sum) + ", more than 1");
  std::sort(classes.begin(), classes.end());
  if (std::adjacent_find(classes.begin(), classes.end()) != classes.end()) bad.AddViolation(field, "has a class twice");
}

void CheckSegmentTable(const PanopticFrame& frame, const LabelSet& label_set, Status& bad) {
  std::vector<std::uint32_t> ids;
  for (std::size_t i = 0; i < frame.segments.size(); ++i) {
    const SegmentInfo& segment = frame.segments[i];
    const std::string field = "segments[" + std::to_string(i) + "]";
    if (segment.id == kNoSegment) bad.AddViolation(field + ".id", "is 0, which means no segment");
    if (segment.class_id && label_set.Find(*segment.class_id) == nullptr) {
      bad.AddViolation(field + ".class_id", std::to_string(segment.class_id->value) + " is not in the label set");
    }
    if (segment.score && !(*segment.score >= 0.0f && *segment.score <= 1.0f)) {
      bad.AddViolation(field + ".score", std::to_string(*segment.score) + " is not within 0 and 1");
    }
    CheckClassScores(segment, field, label_set, bad);
    ids.push_back(segment.id.value);
  }
  std::sort(ids.begin(), ids.end());
  for (auto it = ids.begin(); (it = std::adjacent_find(it, ids.end())) != ids.end();) {
    bad.AddViolation("segments", "id " + std::to_string(*it) + " is given twice");
    it = std::upper_bound(it, ids.end(), *it);
  }
}

/// The ids that a frame's pixels or points may have. Small ids, which is nearly all, are one bit test.
class ListedIds {
 public:
  explicit ListedIds(std::span<const SegmentInfo> segments) {
    small_.set(kNoSegment.value);
    for (const SegmentInfo& segment : segments) {
      if (segment.id.value < small_.size()) small_.set(segment.id.value);
      else large_.push_back(segment.id.value);
    }
    std::sort(large_.begin(), large_.end());
  }
  [[nodiscard]] bool Has(std::uint32_t id) const {
    return id < small_.size() ? small_.test(id) : std::binary_search(large_.begin(), large_.end(), id);
  }

 private:
  std::bitset<8192> small_;
  std::vector<std::uint32_t> large_;
};

void CheckIdsHaveRows(const PanopticFrame& frame, std::span<const std::uint32_t> ids, const char* field, Status& bad) {
  if (frame.unlisted_ids_are_unknown) return;
  const ListedIds listed(frame.segments);
  std::vector<std::uint32_t> missing;
  std::uint32_t last = kNoSegment.value;  // ids come in runs
  for (const std::uint32_t id : ids) {
    if (id == last) continue;
    last = id;
    if (listed.Has(id) || missing.size() > kMaxIdsNamed) continue;
    if (std::find(missing.begin(), missing.end(), id) == missing.end()) missing.push_back(id);
  }
  std::sort(missing.begin(), missing.end());
  for (std::size_t i = 0; i < std::min(missing.size(), kMaxIdsNamed); ++i) {
    bad.AddViolation(field, "id " + std::to_string(missing[i]) + " has no row in the segment table");
  }
  if (missing.size() > kMaxIdsNamed) bad.AddViolation(field, "and more ids without a row");
}

void CheckCount(std::size_t count, std::size_t wanted, bool may_be_empty, const std::string& field, Status& bad) {
  if (count == wanted || (count == 0 && may_be_empty)) return;
  bad.AddViolation(field, "has " + std::to_string(count) + " values, not " + std::to_string(wanted));
}

void CheckCamera(const PanopticFrame& frame, const DepthCameraData& data, Status& bad) {
  const Status camera = data.camera.Validate();
  for (const FieldViolation& violation : camera.violations()) {
    bad.AddViolation("camera.camera." + violation.field, violation.description);
  }
  if (!camera.ok()) return;
  const auto num_pixels = static_cast<std::size_t>(data.camera.num_pixels());
  CheckCount(data.depth_m.size(), num_pixels, false, "camera.depth_m", bad);
  CheckCount(data.color.size(), num_pixels, true, "camera.color", bad);
  CheckCount(data.segments.size(), num_pixels, true, "camera.segments", bad);
  CheckIdsHaveRows(frame, data.segments, "camera.segments", bad);
}

void CheckLidar(const PanopticFrame& frame, const LidarData& data, Status& bad) {
  const std::size_t num_points = data.points_m.size();
  CheckCount(data.color.size(), num_points, true, "lidar.color", bad);
  CheckCount(data.segments.size(), num_points, true, "lidar.segments", bad);
  CheckCount(data.is_hidden.size(), num_points, true, "lidar.is_hidden", bad);
  const auto first_bad =
      std::find_if(data.points_m.begin(), data.points_m.end(), [](const Eigen::Vector3f& p) { return !p.allFinite(); });
  if (first_bad != data.points_m.end()) {
    bad.AddViolation("lidar.points_m", "point " + std::to_string(first_bad - data.points_m.begin()) + " is not finite");
  }
  CheckIdsHaveRows(frame, data.segments, "lidar.segments", bad);
}

}  // namespace

std::optional<float> SegmentInfo::Sureness() const {
  if (score) return score;
  if (class_scores.empty() || !class_id) return std::nullopt;
  const auto own = std::find_if(class_scores.begin(), class_scores.end(),
                                [this](const ClassScore& entry) { return entry.class_id == *class_id; });
  return own != class_scores.end() ? own->score : 0.0f;
}

bool SegmentInfo::IsDoubtful(double min_score) const {
  const std::optional<float> sureness = Sureness();
  return sureness && static_cast<double>(*sureness) < min_score;
}

std::optional<ClassId> LikeliestClass(std::span<const ClassScore> scores) {
  const auto most = std::max_element(scores.begin(), scores.end(), [](const ClassScore& a, const ClassScore& b) {
    return a.score != b.score ? a.score < b.score : a.class_id > b.class_id;
  });
  if (most == scores.end() || !(most->score > 0)) return std::nullopt;
  return most->class_id;
}

Status ValidateFrame(const PanopticFrame& frame, const LabelSet& label_set) {
  Status bad = InvalidArgument("the frame is not usable").WithReason("BAD_FRAME");
  if (frame.stamp_ns <= -kBeyondStamps_ns || frame.stamp_ns >= kBeyondStamps_ns) {
    bad.AddViolation("stamp_ns", "is beyond +-2^62");
  }
  if (!IsFinite(frame.T_map_sensor)) bad.AddViolation("T_map_sensor", "has a NaN or infinite entry");
  if (frame.camera.has_value() == frame.lidar.has_value()) {
    bad.AddViolation("sensor", frame.camera ? "has both a camera and a LiDAR" : "has neither a camera nor a LiDAR");
  }
  CheckSegmentTable(frame, label_set, bad);
  if (frame.camera) CheckCamera(frame, *frame.camera, bad);
  if (frame.lidar) CheckLidar(frame, *frame.lidar, bad);
  return bad.violations().empty() ? Status::Ok() : bad;
}

}  // namespace dhpmap

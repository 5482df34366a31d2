// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/tracking/segment_votes.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "mapping/tracking/find_stuff.h"

namespace dhpmap {
namespace {

/// More of them would cost every voxel memory for what is next to nothing.
constexpr std::size_t kMostClasses = 4;
constexpr float kLeastScore = 0.05f;
constexpr float kLeastShareNamed =
    0.25f;  // of the likeliest: less hardly ever decides, and each costs its voxels memory

float MeanScore(const std::vector<SegmentInfo>& segments) {
  double sum = 0;
  int num_scored = 0;
  for (const SegmentInfo& segment : segments) {
    const std::optional<float> sureness = segment.Sureness();
    if (!sureness) continue;
    sum += static_cast<double>(*sureness);
    ++num_scored;
  }
  return num_scored == 0 ? 1.0f : static_cast<float>(sum / num_scored);
}

std::uint32_t Weight(float score, std::uint32_t unit) {
  return static_cast<std::uint32_t>(std::lround(score * static_cast<float>(unit)));
}

template <typename Id>
void AddTo(std::vector<SeenCount<Id>>& counts, Id id, std::uint32_t count) {
  counts = SumCounts(counts, std::vector<SeenCount<Id>>{{id, count}});
}

/// The likeliest few of a kind; of equals, those of smaller ids.
std::vector<ClassScore> Likeliest(const std::vector<ClassScore>& all, Panoptic kind, const LabelSet& label_set) {
  std::vector<ClassScore> scores;
  for (const ClassScore& entry : all) {
    const LabelClass* label_class = label_set.Find(entry.class_id);
    if (entry.score >= kLeastScore && label_class != nullptr && label_class->panoptic == kind) scores.push_back(entry);
  }
  std::sort(scores.begin(), scores.end(), [](const ClassScore& a, const ClassScore& b) {
    return a.score != b.score ? a.score > b.score : a.class_id < b.class_id;
  });
  if (scores.size() > kMostClasses) scores.resize(kMostClasses);
  return scores;
}

/// Whether `id` has no count, or one that another, which has most of the others, has, too.
template <typename Id>
bool NeedsOne(const std::vector<SeenCount<Id>>& counts, Id id) {
  std::uint32_t own = 0, most = 0;
  for (const SeenCount<Id>& entry : counts) {
    if (entry.id == id) own = entry.count;
    else most = std::max(most, entry.count);
  }
  return own == 0 || own == most;
}

/// What the segment is said to be decides ties, and says something where its scores do not.
void CountAssignment(ClassId class_id, LabelHistograms& votes) {
  if (!NeedsOne(votes.classes, std::uint32_t{class_id.value}) && !NeedsOne(votes.instances, kOwnInstance)) return;
  AddTo(votes.classes, std::uint32_t{class_id.value}, 1u);
  AddTo(votes.instances, kOwnInstance, 1u);
}

}  // namespace

FrameVotes::FrameVotes(const PanopticFrame& frame, const Map& map) : map_(map), unscored_(MeanScore(frame.segments)) {}

SeenInstance FrameVotes::InstanceOf(ClassId class_id, const SubmapInfo& holder) {
  const auto [known, is_new] = backgrounds_.try_emplace(class_id, kUnknownSubmap);
  if (is_new) {
    const Submap* background = FindStuff(map_, class_id);
    const bool takes = background != nullptr && !IsEdited(background->info()) && !background->info().is_locked;
    if (takes) known->second = background->id();
  }
  return known->second == kUnknownSubmap ? kOwnInstance : SeenInstance::Of(known->second, holder.id);
}

LabelHistograms FrameVotes::ByClassScores(const SegmentInfo& segment, const SubmapInfo& holder) {
  const MapInfo& map = map_.info();
  const bool is_shared = holder.panoptic == Panoptic::kStuff && !IsEdited(holder);
  LabelHistograms votes;
  const std::vector<ClassScore> likeliest = Likeliest(segment.class_scores, holder.panoptic, *map.label_set);
  for (const ClassScore& entry : likeliest) {
    const std::uint32_t count = Weight(entry.score, map.config.tracking.SightingUnit());
    const bool is_named = is_shared && entry.score >= kLeastShareNamed * likeliest.front().score;
    AddTo(votes.classes, std::uint32_t{entry.class_id.value}, count);
    AddTo(votes.instances, is_named ? InstanceOf(entry.class_id, holder) : kOwnInstance, count);
  }
  CountAssignment(*segment.class_id, votes);
  return votes;
}

LabelHistograms FrameVotes::Of(const SegmentInfo& segment, const Submap& holder) {
  if (!segment.class_id || holder.id() == kUnknownSubmap) return {};
  const TrackingConfig& config = map_.info().config.tracking;
  if (!config.weigh_scores) return LabelHistograms::OfClass(*segment.class_id);
  if (!segment.class_scores.empty()) return ByClassScores(segment, holder.info());
  const float score = segment.score.value_or(unscored_);
  return LabelHistograms::OfClass(*segment.class_id, std::max(1u, Weight(score, config.SightingUnit())));
}

}  // namespace dhpmap

// SPDX-License-Identifier: BSD-3-Clause
#include "clients/evaluator/recording.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "clients/datasets/open_dataset.h"
#include "mapping/sensor/hidden_things.h"

namespace dhpmap::evaluator {
namespace {

template <typename T>
std::size_t BytesOf(const std::vector<T>& values) {
  return values.size() * sizeof(T);
}

std::size_t BytesOf(const PanopticFrame& frame) {
  std::size_t bytes = sizeof(frame) + BytesOf(frame.segments);
  for (const SegmentInfo& segment : frame.segments) bytes += BytesOf(segment.class_scores);
  if (frame.camera)
    bytes += BytesOf(frame.camera->depth_m) + BytesOf(frame.camera->color) + BytesOf(frame.camera->segments);
  if (frame.lidar)
    bytes += BytesOf(frame.lidar->points_m) + BytesOf(frame.lidar->color) + BytesOf(frame.lidar->segments) +
             BytesOf(frame.lidar->is_hidden);
  return bytes;
}

}  // namespace

Result<Recording> Recording::Open(const std::string& directory, const std::string& format, LabelSource labels,
                                  std::size_t num_frames, std::size_t cache_bytes) {
  // Only the map of the true labels omits moving points: systems do not know what moves.
  return Open(directory, format, labels, {.drop_moving_points = labels == LabelSource::kGroundTruth}, num_frames,
              cache_bytes);
}

Result<Recording> Recording::OpenMeasured(const std::string& directory, const std::string& format,
                                          std::size_t num_frames) {
  return Open(directory, format, LabelSource::kGroundTruth,
              {.drop_moving_points = false, .unlabel_moving_points = true}, num_frames, 0);
}

Result<Recording> Recording::Open(const std::string& directory, const std::string& format, LabelSource labels,
                                  const DatasetOptions& options, std::size_t num_frames, std::size_t cache_bytes) {
  DHPMAP_ASSIGN_OR_RETURN(std::unique_ptr<Dataset> dataset, OpenDataset(directory, format, labels, options));
  DHPMAP_ASSIGN_OR_RETURN(LabelSet label_set, LabelSet::Create(dataset->label_classes()));
  const std::size_t available = dataset->num_frames();
  return Recording(std::move(dataset), std::move(label_set),
                   num_frames == 0 ? available : std::min(num_frames, available), cache_bytes);
}

Result<PanopticFrame> Recording::Decode(std::size_t index) {
  DHPMAP_ASSIGN_OR_RETURN(const DatasetFrame raw, dataset_->Read(index));
  DHPMAP_ASSIGN_OR_RETURN(PanopticFrame frame, DecodeFrame(raw, dataset_->has_persistent_ids()));
  std::optional<PanopticFrame> changed = WithoutHiddenThings(frame, label_set_);
  if (changed) frame = *std::move(changed);
  for (SegmentInfo& segment : frame.segments) {
    if (segment.IsDoubtful(min_score_)) segment.class_id.reset();
  }
  return frame;
}

Status Recording::ForEach(const std::function<Status(const PanopticFrame&)>& use) {
  num_skipped_ = num_cached_indices_ - cached_.size();
  std::size_t num_used = 0;
  for (const PanopticFrame& frame : cached_) {
    DHPMAP_RETURN_IF_ERROR(use(frame));
    ++num_used;
  }
  for (std::size_t i = num_cached_indices_; i < num_frames_; ++i) {
    Result<PanopticFrame> frame = Decode(i);
    if (!frame.ok()) {
      if (num_skipped_++ == 0) first_error_ = frame.status().ToString();
      if (!is_full_) num_cached_indices_ = i + 1;
      continue;
    }
    DHPMAP_RETURN_IF_ERROR(use(*frame));
    ++num_used;
    cached_bytes_ += BytesOf(*frame);
    is_full_ = is_full_ || cached_bytes_ > cache_bytes_;
    if (is_full_) continue;
    cached_.push_back(std::move(frame).value());
    num_cached_indices_ = i + 1;
  }
  if (num_used > 0) return Status::Ok();
  return NotFound("no frame can be read" + (first_error_.empty() ? "" : ": " + first_error_));
}

}  // namespace dhpmap::evaluator

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "clients/datasets/dataset.h"

namespace dhpmap::evaluator {

/// The frames of a data set, decoded. Keeps what fits into the cache for the next system and decodes the rest
/// again. Frames that cannot be read are left out, the same ones for every system. What MapBuilder forgets of hidden
/// points (see WithoutHiddenThings) and of segments of a small score is forgotten here, so that every system has it.
/// Thread-compatible.
class Recording {
 public:
  /// The first `num_frames` frames (0 = all), of which up to `cache_bytes` are kept decoded.
  static Result<Recording> Open(const std::string& directory, const std::string& format, LabelSource labels,
                                std::size_t num_frames, std::size_t cache_bytes);

  /// All that the sensor measured, with the ground truth's labels: points of scans that move or that nobody has
  /// labelled are there, and have no label.
  static Result<Recording> OpenMeasured(const std::string& directory, const std::string& format,
                                        std::size_t num_frames);

  /// TrackingConfig::min_score; before the first ForEach.
  void set_min_score(double min_score) { min_score_ = min_score; }
  [[nodiscard]] const std::vector<LabelClass>& label_classes() const { return dataset_->label_classes(); }
  [[nodiscard]] std::string preset() const { return dataset_->preset(); }
  [[nodiscard]] std::size_t num_frames() const { return num_frames_; }
  /// Of those asked for so far.
  [[nodiscard]] std::size_t num_skipped() const { return num_skipped_; }
  [[nodiscard]] const std::string& first_error() const { return first_error_; }

  /// Calls use(frame) for each readable frame in order; stops at the first error that it answers. NOT_FOUND if no frame
  /// can be read.
  Status ForEach(const std::function<Status(const PanopticFrame&)>& use);

 private:
  Recording(std::unique_ptr<Dataset> dataset, LabelSet label_set, std::size_t num_frames, std::size_t cache_bytes)
      : dataset_(std::move(dataset)),
        label_set_(std::move(label_set)),
        num_frames_(num_frames),
        cache_bytes_(cache_bytes) {}
  static Result<Recording> Open(const std::string& directory, const std::string& format, LabelSource labels,
                                const DatasetOptions& options, std::size_t num_frames, std::size_t cache_bytes);
  Result<PanopticFrame> Decode(std::size_t index);

  std::unique_ptr<Dataset> dataset_;
  LabelSet label_set_;
  double min_score_ = 0;
  std::size_t num_frames_ = 0, cache_bytes_ = 0;
  std::vector<PanopticFrame> cached_;   ///< the first readable frames
  std::size_t num_cached_indices_ = 0;  ///< of the data set, that they cover
  std::size_t cached_bytes_ = 0;
  bool is_full_ = false;
  std::size_t num_skipped_ = 0;
  std::string first_error_;
};

}  // namespace dhpmap::evaluator

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

/// The decoded frames of a data set. Keeps those that fit into the cache for the next system, and decodes the rest
/// again. Skips unreadable frames, the same ones for every system. Points of hidden things (see WithoutHiddenThings)
/// and segments with a small score, which MapBuilder ignores, are removed here, for every system alike.
/// Thread-compatible.
class Recording {
 public:
  /// Opens the first `num_frames` frames (0: all); up to `cache_bytes` stay decoded.
  static Result<Recording> Open(const std::string& directory, const std::string& format, LabelSource labels,
                                std::size_t num_frames, std::size_t cache_bytes);

  /// All measurements with the ground truth's labels: moving and unlabelled points of scans are included, without
  /// label.
  static Result<Recording> OpenMeasured(const std::string& directory, const std::string& format,
                                        std::size_t num_frames);

  /// Sets TrackingConfig::min_score; call before the first ForEach.
  void set_min_score(double min_score) { min_score_ = min_score; }
  [[nodiscard]] const std::vector<LabelClass>& label_classes() const { return dataset_->label_classes(); }
  [[nodiscard]] std::string preset() const { return dataset_->preset(); }
  [[nodiscard]] std::size_t num_frames() const { return num_frames_; }
  /// Among the frames read so far.
  [[nodiscard]] std::size_t num_skipped() const { return num_skipped_; }
  [[nodiscard]] const std::string& first_error() const { return first_error_; }

  /// Calls use(frame) for each readable frame in order; stops at the first error that it returns. NOT_FOUND if no frame
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
  std::size_t num_cached_indices_ = 0;  ///< number of the data set's frames that they cover
  std::size_t cached_bytes_ = 0;
  bool is_full_ = false;
  std::size_t num_skipped_ = 0;
  std::string first_error_;
};

}  // namespace dhpmap::evaluator

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <memory>

#include "clients/datasets/dataset.h"

namespace dhpmap {

// One reader for each layout. Each finds its recording below `directory` (see OpenDataset) and reads frames lazily.

/// run1/timestamps.csv and NNNNNN_{color.png,depth.tiff,pose.txt,...}; label tables next to run1 or in it.
bool LooksFlat(const std::filesystem::path& directory);
Result<std::unique_ptr<Dataset>> OpenFlat(const std::filesystem::path& directory, LabelSource labels);

/// SemanticKITTI: sequences/NN with velodyne/, calib.txt, times.txt, poses and, optionally, image_2/ and labels/.
bool LooksLikeKitti(const std::filesystem::path& directory);
Result<std::unique_ptr<Dataset>> OpenKitti(const std::filesystem::path& directory, LabelSource labels,
                                           const DatasetOptions& options);

/// 7-Scenes: seq-NN/frame-NNNNNN.{color.png,depth.png,pose.txt}. No labels.
bool LooksLikeSevenScenes(const std::filesystem::path& directory);
Result<std::unique_ptr<Dataset>> OpenSevenScenes(const std::filesystem::path& directory, LabelSource labels);

/// TUM RGB-D: rgb.txt, depth.txt, groundtruth.txt. No labels.
bool LooksLikeTum(const std::filesystem::path& directory);
Result<std::unique_ptr<Dataset>> OpenTum(const std::filesystem::path& directory, LabelSource labels);

}  // namespace dhpmap

// SPDX-License-Identifier: BSD-3-Clause
#include "clients/datasets/dataset.h"

#include <filesystem>

#include "clients/datasets/layouts.h"

namespace dhpmap {
namespace {

namespace fs = std::filesystem;

Result<DatasetFormat> DetectFormat(const fs::path& directory) {
  if (LooksFlat(directory)) return DatasetFormat::kFlat;
  if (LooksLikeKitti(directory)) return DatasetFormat::kKitti;
  if (LooksLikeSevenScenes(directory)) return DatasetFormat::kSevenScenes;
  if (LooksLikeTum(directory)) return DatasetFormat::kTum;
  return InvalidArgument(
      directory.string() +
      " is no data set that we know: there is neither timestamps.csv (flat; here or in run1/), nor "
      "velodyne/ (SemanticKITTI; here or in sequences/NN/), nor frame-*.depth.png (7-Scenes; here or "
      "in seq-01/), nor depth.txt and rgb.txt (TUM RGB-D)");
}

}  // namespace

Result<DatasetFormat> ParseDatasetFormat(const std::string& name) {
  if (name == "auto") return DatasetFormat::kAuto;
  if (name == "flat") return DatasetFormat::kFlat;
  if (name == "kitti") return DatasetFormat::kKitti;
  if (name == "sevenscenes") return DatasetFormat::kSevenScenes;
  if (name == "tum") return DatasetFormat::kTum;
  return InvalidArgument("data set format '" + name + "' is not auto, flat, kitti, sevenscenes or tum");
}

Result<LabelSource> ParseLabelSource(const std::string& name) {
  if (name == "predicted") return LabelSource::kPredicted;
  if (name == "groundtruth") return LabelSource::kGroundTruth;
  if (name == "none") return LabelSource::kNone;
  return InvalidArgument("label source '" + name + "' is not predicted, groundtruth or none");
}

Result<std::unique_ptr<Dataset>> OpenDataset(const std::string& directory, DatasetFormat format, LabelSource labels,
                                             const DatasetOptions& options) {
  fs::path path = fs::path(directory).lexically_normal();
  if (!path.has_filename()) path = path.parent_path();  // "house/" -> "house", so that its parent is above it
  std::error_code error;
  if (!fs::is_directory(path, error)) return NotFound("there is no folder " + directory);
  if (format == DatasetFormat::kAuto) {
    DHPMAP_ASSIGN_OR_RETURN(format, DetectFormat(path));
  }
  switch (format) {
    case DatasetFormat::kFlat: return OpenFlat(path, labels);
    case DatasetFormat::kKitti: return OpenKitti(path, labels, options);
    case DatasetFormat::kSevenScenes: return OpenSevenScenes(path, labels);
    case DatasetFormat::kTum: return OpenTum(path, labels);
    case DatasetFormat::kAuto: break;
  }
  return Internal("no reader for this format");
}

}  // namespace dhpmap

// SPDX-License-Identifier: BSD-3-Clause
#include "clients/datasets/open_dataset.h"

#include <array>
#include <filesystem>
#include <utility>

#include "clients/datasets/layouts.h"

namespace dhpmap {
namespace {

namespace fs = std::filesystem;

/// A layout of data sets on disk.
struct Layout {
  const char* name;
  const char* mark;  // description of the file that identifies it
  bool (*is_here)(const fs::path& directory);
  Result<std::unique_ptr<Dataset>> (*open)(const fs::path& directory, LabelSource labels, const DatasetOptions&);
};

template <Result<std::unique_ptr<Dataset>> (*Open)(const fs::path&, LabelSource)>
Result<std::unique_ptr<Dataset>> WithoutOptions(const fs::path& directory, LabelSource labels, const DatasetOptions&) {
  return Open(directory, labels);
}

/// Tried in this order.
constexpr std::array kLayouts = {
    Layout{"flat", "timestamps.csv (here or in run1/)", LooksFlat, WithoutOptions<OpenFlat>},
    Layout{"kitti", "velodyne/ (SemanticKITTI; here or in sequences/NN/)", LooksLikeKitti, OpenKitti},
    Layout{"sevenscenes", "frame-*.depth.png (7-Scenes; here or in seq-01/)", LooksLikeSevenScenes,
           WithoutOptions<OpenSevenScenes>},
    Layout{"tum", "depth.txt and rgb.txt (TUM RGB-D)", LooksLikeTum, WithoutOptions<OpenTum>},
};

Result<const Layout*> FindLayout(const std::string& name, const fs::path& directory) {
  const bool is_any = name == kAnyFormat;
  std::string names = kAnyFormat, marks;
  for (const Layout& layout : kLayouts) {
    if (is_any ? layout.is_here(directory) : layout.name == name) return &layout;
    names += std::string(", ") + layout.name;
    marks += (marks.empty() ? "" : ", nor ") + std::string(layout.mark);
  }
  if (is_any) {
    return InvalidArgument(directory.string() + " is no data set that we know: there is neither " + marks);
  }
  return InvalidArgument("data set format '" + name + "' is none of " + names);
}

}  // namespace

std::vector<std::string> DatasetFormats() {
  std::vector<std::string> names = {kAnyFormat};
  for (const Layout& layout : kLayouts) names.emplace_back(layout.name);
  return names;
}

Result<std::unique_ptr<Dataset>> OpenDataset(const std::string& directory, const std::string& format,
                                             LabelSource labels, const DatasetOptions& options) {
  fs::path path = fs::path(directory).lexically_normal();
  if (!path.has_filename()) path = path.parent_path();  // "house/" -> "house": its parent is above it
  std::error_code error;
  if (!fs::is_directory(path, error)) return NotFound("there is no folder " + directory);
  DHPMAP_ASSIGN_OR_RETURN(const Layout* layout, FindLayout(format, path));
  return layout->open(path, labels, options);
}

}  // namespace dhpmap

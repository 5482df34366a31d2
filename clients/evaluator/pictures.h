// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "clients/evaluator/evaluation.h"
#include "clients/evaluator/surface_view.h"

namespace dhpmap::evaluator {

/// The same surface from a corner, at half height, and from above.
struct PicturePair {
  Picture corner, above;
};

/// Colours of error pictures, for legends.
namespace error_colors {
inline constexpr Color kRight{222, 225, 229}, kWrongClass{214, 39, 40}, kWrongInstance{255, 150, 30},
    kMissing{31, 80, 200}, kNotJudged{243, 240, 232};
}  // namespace error_colors

/// Pictures of a ground truth that is a surface; walls are hidden so that rooms are visible (see Sides). The truth must
/// outlive this.
class TruthPictures {
 public:
  explicit TruthPictures(const Truth& truth, int long_side_px = 1000);

  /// In the colours of the camera.
  [[nodiscard]] PicturePair Seen() const;
  /// Things by instance in strong colours, background classes in pale ones.
  [[nodiscard]] PicturePair TruthLabels() const;
  /// The system's labels of the truth's samples; a segment that matches one of the truth has its colour.
  [[nodiscard]] PicturePair Labels(const Scores& scores, const std::vector<ElementLabel>& labels) const;
  /// In error_colors: right; wrong class; right class but not the matched segment; missing; not judged.
  [[nodiscard]] PicturePair Errors(const Scores& scores, const std::vector<ElementLabel>& labels) const;

 private:
  [[nodiscard]] PicturePair Paint(const std::function<Color(std::uint32_t sample)>& color_of) const;

  const Truth& truth_;
  SurfaceView corner_, above_;
  std::vector<std::uint32_t> sample_of_triangle_;  ///< a sample on the triangle, or the nearest; Neighbour::kNone: none
};

/// Writes `<folder>/<system>_labels.png`, `<system>_errors.png` and `truth_labels.png`: each with the view from above
/// and, below it, from the corner. Creates the folder. UNAVAILABLE if a file cannot be written.
Status WritePictures(const TruthPictures& pictures, const Scores& scores, const std::vector<ElementLabel>& labels,
                     const std::string& folder);

}  // namespace dhpmap::evaluator

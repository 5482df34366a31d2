// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "clients/simulator/renderer.h"

namespace dhpmap::simulator {

/// Error model of a simulated panoptic network. Lengths are for images 640 pixels wide, and scale with the width.
struct PanopticNoise {
  double border_rms_px = 3.0;       ///< along each axis
  double border_wave_px = 24.0;     ///< period of the waves along borders
  double missed_share = 0.06;       ///< of things: left unlabelled
  double wrong_class_share = 0.10;  ///< of detected things
  double merged_share = 0.5;        ///< of touching pairs of things of one class
  double split_share = 0.15;        ///< of large things: split into two segments
  double large_area_share = 0.03;   ///< of the image: minimum of a large thing
  int max_holes = 5;                ///< maximum number of unlabelled patches in a frame
  double max_hole_radius_px = 18.0;
  double min_area_px = 80.0;  ///< smaller things are not detected

  /// Scales the number of errors and the waves of borders by `level` >= 0; shares are limited to 0.9.
  [[nodiscard]] PanopticNoise Times(double level) const;
};

struct PredictedSegment {
  std::uint8_t id = 0;  ///< pixel value in this frame; ids are not related between frames
  ObjectClass object_class = ObjectClass::kUnknown;
  float score = 0;  ///< 0..1; 0 for stuff
  /// For things, the network's second choice: if object_class is wrong, mostly the true class, else a likely confusion;
  /// it gets most of the remaining score.
  ObjectClass second_class = ObjectClass::kUnknown;
  float second_score = 0;
  std::uint8_t truth = 0;  ///< ground-truth id of its largest thing; for stuff, of an instance of that class
};

/// Errors in a frame, over the things that were large enough to be detected.
struct PredictionErrors {
  int num_things = 0;  ///< after merging
  int num_missed = 0, num_wrong_class = 0, num_merged = 0, num_large = 0, num_split = 0;
};

struct Prediction {
  std::vector<std::uint8_t> ids;           ///< row-major; 0: no label
  std::vector<PredictedSegment> segments;  ///< by id, each with at least one pixel
  PredictionErrors errors;
};

/// Simulates the prediction for a frame, independently of other frames. `instances`: those of the scene, by id.
Prediction PredictPanoptic(const RenderedFrame& frame, std::span<const Instance> instances, const PanopticNoise& noise,
                           std::uint64_t seed, std::uint64_t frame_number);

}  // namespace dhpmap::simulator

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "clients/simulator/renderer.h"

namespace dhpmap::simulator {

/// How a simulated panoptic network errs. Lengths are for images 640 pixels wide and scale with the width.
struct PanopticNoise {
  double border_rms_px = 3.0;       ///< along each axis
  double border_wave_px = 24.0;     ///< period of the waves in the borders
  double missed_share = 0.06;       ///< of things: left without label
  double wrong_class_share = 0.10;  ///< of things that were found
  double merged_share = 0.5;        ///< of touching pairs of things of a class
  double split_share = 0.15;        ///< of large things: two segments
  double large_area_share = 0.03;   ///< of the image: what counts as large
  int max_holes = 5;                ///< patches without label in a frame, from 0
  double max_hole_radius_px = 18.0;
  double min_area_px = 80.0;  ///< smaller things are not found

  /// So many times as many errors, and borders that wave as much more; no share above nine tenths. `level` >= 0.
  [[nodiscard]] PanopticNoise Times(double level) const;
};

struct PredictedSegment {
  std::uint8_t id = 0;  ///< pixel value in this frame; means nothing in others
  ObjectClass object_class = ObjectClass::kUnknown;
  float score = 0;  ///< 0..1; 0 for stuff, which has none
  /// Of a thing, the class that the network thinks of next: if object_class is wrong, mostly what it is, else what it
  /// is easily mistaken for; with most of what the score leaves.
  ObjectClass second_class = ObjectClass::kUnknown;
  float second_score = 0;
  std::uint8_t truth = 0;  ///< ground-truth id of the largest thing in it; for stuff, of one of that class
};

/// What happened to the things of a frame that were large enough to be found.
struct PredictionErrors {
  int num_things = 0;  ///< after merging
  int num_missed = 0, num_wrong_class = 0, num_merged = 0, num_large = 0, num_split = 0;
};

struct Prediction {
  std::vector<std::uint8_t> ids;           ///< row-major; 0 = no label
  std::vector<PredictedSegment> segments;  ///< by id, each with pixels
  PredictionErrors errors;
};

/// Simulates the prediction for a frame; those of a recording are independent. `instances` are the scene's, by id.
Prediction PredictPanoptic(const RenderedFrame& frame, std::span<const Instance> instances, const PanopticNoise& noise,
                           std::uint64_t seed, std::uint64_t frame_number);

}  // namespace dhpmap::simulator

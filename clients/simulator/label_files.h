// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <string>

#include "clients/simulator/panoptic_noise.h"
#include "clients/simulator/scene_builder.h"

// Content of the flat layout's label files.
namespace dhpmap::simulator {

/// groundtruth_labels.csv: one row for each instance.
std::string GroundTruthTable(std::span<const Instance> instances);
/// detectron_labels.csv: one row for each class.
std::string CategoryTable();
/// NNNNNN_labels.json; `has_class_scores` adds the scores of likely classes.
std::string SegmentsJson(std::span<const PredictedSegment> segments, bool has_class_scores);

}  // namespace dhpmap::simulator

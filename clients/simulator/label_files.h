// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <string>

#include "clients/simulator/panoptic_noise.h"
#include "clients/simulator/scene_builder.h"

// Texts of the flat layout's label files.
namespace dhpmap::simulator {

/// groundtruth_labels.csv: a row an instance.
std::string GroundTruthTable(std::span<const Instance> instances);
/// detectron_labels.csv: a row a class.
std::string CategoryTable();
/// NNNNNN_labels.json; with the classes that the network thinks of, if that is wanted.
std::string SegmentsJson(std::span<const PredictedSegment> segments, bool has_class_scores);

}  // namespace dhpmap::simulator

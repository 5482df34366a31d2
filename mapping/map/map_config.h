// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "mapping/base/status.h"

namespace dhpmap {

/// How much a measured point counts in the TSDF average.
enum class Weighting { kConstant = 0, kInverseDepthSquared = 1, kInverseRangeSquared = 2 };

/// How points become TSDF values (paper II-C; algorithm after Curless and Levoy 1996).
struct IntegrationConfig {
  double min_range_m = 0.1;  ///< nearer points are dropped
  double max_range_m = 5.0;  ///< farther points are dropped
  Weighting weighting = Weighting::kInverseDepthSquared;
  double max_weight = 10000.0;  ///< lower it to follow changes faster
  bool weight_dropoff = true;   ///< fade the weight behind the surface, from one voxel to the truncation
  bool anti_grazing = true;     ///< a ray skips voxels in which another ray of its segment ends
};

struct TrackingConfig {
  double iou_threshold = 0.12;        ///< a segment joins a submap only above this IoU
  double depth_tolerance_vox = 1.0;   ///< a point hits a submap where |distance| is below this
  bool match_requires_class = false;  ///< things only match submaps of their own class
  double min_score = 0;               ///< segments with a lower SegmentInfo::Sureness are fused as geometry only
  int split_gap_vox = 5;        ///< parts of a thing's segment that lie farther apart are matched separately; 0 = never
  int min_points_stuff = 1000;  ///< points that a new background submap needs in one frame
  int min_points_small = 60;    ///< likewise for things, by the size of their class
  int min_points_medium = 60;
  int min_points_large = 1000;
};

struct ActivityConfig {
  int required_reobservations = 3;  ///< of a new thing, to confirm it; 0 = confirmed at once
  int deactivate_after_missed = 3;  ///< consecutive frames without a matching segment
};

/// One Gaussian kernel of the CRF (paper II-E): range and strength of the influence of a voxel's label on others.
struct CrfKernelConfig {
  double position_m = 0;  ///< standard deviation in space
  double color = 0;       ///< standard deviation of each of r, g and b, in 0..255; not used by the smoothness kernel
  double weight = 0;      ///< relative to the voxel's own observations; 0 disables the kernel
};

/// Refinement of labels (paper II-D and II-E). The paper's two parts can be switched off one by one.
struct RefinementConfig {
  int every_frames = 85;   ///< frames between refinements of inactive objects; 0 = only at FinishMapping
  bool management = true;  ///< each position goes to one submap
  bool crf = true;         ///< labels agree with their surroundings; needs management
  bool drop_voxel_labels =
      false;  ///< at FinishMapping, when positions are exclusive, drop voxel labels and keep those of submaps
  int crf_iterations = 3;        ///< iterations of mean field
  double evidence_radius_m = 0;  ///< a voxel uses labels of surface voxels within this radius; 0 = only its own
  int least_apart_voxels =
      0;  ///< at FinishMapping, separate parts of a thing with this many voxels become things; 0 = never
  CrfKernelConfig smoothness{.position_m = 0.04, .color = 0, .weight = 1.0};
  CrfKernelConfig appearance{.position_m = 0.12, .color = 8.0, .weight = 5.0};
};

/// Layers that record what sensors have looked through.
struct SpaceConfig {
  bool free = true;  ///< store free voxels, up to integration.max_range_m: tells free from unknown
  bool gone = true;  ///< store surfaces that were looked through, and leave those that are gone out of answers
};

/// Everything that decides how a map is built. Fixed when the map is created and stored with it.
struct MapConfig {
  double voxel_size_m = 0.04;
  double truncation_m = 0.08;  ///< half width of the band around a surface that is stored
  IntegrationConfig integration;
  TrackingConfig tracking;
  ActivityConfig activity;
  RefinementConfig refinement;
  SpaceConfig space;
  /// "key = value" of retired settings with which a stored map was built, and which are now ignored (RetiredField). Not
  /// a key.
  std::vector<std::string> left_out;

  /// INVALID_ARGUMENT naming every key that is out of range, at once.
  [[nodiscard]] Status Validate() const;
};

/// Defaults for indoor RGB-D (the paper's flat setting) and for outdoor LiDAR with a camera (its KITTI setting).
MapConfig IndoorConfig();
MapConfig OutdoorLidarConfig();

/// "indoor" or "outdoor_lidar"; INVALID_ARGUMENT otherwise.
Status ApplyPreset(std::string_view preset, MapConfig& config);

/// Calls visit(key, member, least, most, help) for every field; key is dotted, such as "tracking.iou_threshold".
/// The one list of keys: file, environment, API, store and documentation all go through it.
template <typename Config, typename Visitor>
void VisitFields(Config& c, Visitor&& visit) {
  visit("voxel_size_m", c.voxel_size_m, 1e-3, 10.0, "edge of a voxel");
  visit("truncation_m", c.truncation_m, 1e-3, 100.0, "half width of the stored band, 1 to 8 voxels");
  visit("integration.min_range_m", c.integration.min_range_m, 0.0, 1e4, "nearer points are dropped");
  visit("integration.max_range_m", c.integration.max_range_m, 1e-3, 1e4, "farther points are dropped");
  visit("integration.weighting", c.integration.weighting, 0.0, 2.0,
        "of a point: CONSTANT, INVERSE_DEPTH_SQUARED or INVERSE_RANGE_SQUARED");
  visit("integration.max_weight", c.integration.max_weight, 1e-3, 1e9, "cap of a voxel's weight");
  visit("integration.weight_dropoff", c.integration.weight_dropoff, 0.0, 1.0, "fade the weight behind the surface");
  visit("integration.anti_grazing", c.integration.anti_grazing, 0.0, 1.0,
        "rays skip voxels in which other rays of their segment end");
  visit("tracking.iou_threshold", c.tracking.iou_threshold, 0.0, 1.0, "a segment joins a submap only above this IoU");
  visit("tracking.depth_tolerance_vox", c.tracking.depth_tolerance_vox, 0.0, 100.0,
        "a point hits a submap where |distance| is below this");
  visit("tracking.match_requires_class", c.tracking.match_requires_class, 0.0, 1.0,
        "things only match submaps of their own class");
  visit("tracking.min_score", c.tracking.min_score, 0.0, 1.0,
        "segments below this score are fused as geometry without a label; no score counts as 1");
  visit("tracking.split_gap_vox", c.tracking.split_gap_vox, 0.0, 1000.0,
        "parts of a thing's segment farther apart are matched separately; 0 = never");
  visit("tracking.min_points_stuff", c.tracking.min_points_stuff, 1.0, 1e9,
        "points that a new background submap needs");
  visit("tracking.min_points_small", c.tracking.min_points_small, 1.0, 1e9, "points that a new small thing needs");
  visit("tracking.min_points_medium", c.tracking.min_points_medium, 1.0, 1e9, "points that a new medium thing needs");
  visit("tracking.min_points_large", c.tracking.min_points_large, 1.0, 1e9, "points that a new large thing needs");
  visit("activity.required_reobservations", c.activity.required_reobservations, 0.0, 1e6,
        "observations that confirm a new thing");
  visit("activity.deactivate_after_missed", c.activity.deactivate_after_missed, 1.0, 1e6,
        "consecutive frames without a matching segment until a submap is inactive");
  visit("refinement.every_frames", c.refinement.every_frames, 0.0, 1e6,
        "frames between refinements of inactive submaps; 0 = only at FinishMapping");
  visit("refinement.management", c.refinement.management, 0.0, 1.0,
        "label management: each voxel position goes to one submap");
  visit("refinement.crf", c.refinement.crf, 0.0, 1.0, "run the CRF: labels follow shape and colour");
  visit("refinement.drop_voxel_labels", c.refinement.drop_voxel_labels, 0.0, 1.0,
        "FinishMapping drops the labels of voxels and keeps those of submaps");
  visit("refinement.crf_iterations", c.refinement.crf_iterations, 1.0, 100.0, "iterations of mean field");
  visit("refinement.evidence_radius_m", c.refinement.evidence_radius_m, 0.0, 1e3,
        "a voxel uses labels of surface voxels within this radius, 8 voxels at most; 0 = its own");
  visit("refinement.least_apart_voxels", c.refinement.least_apart_voxels, 0.0, 1e9,
        "surface voxels that make a separate part of a thing its own thing at the end; 0 = never");
  visit("refinement.smoothness.position_m", c.refinement.smoothness.position_m, 1e-3, 1e3,
        "standard deviation of the smoothness kernel");
  visit("refinement.smoothness.weight", c.refinement.smoothness.weight, 0.0, 1e3,
        "how strongly near voxels should agree");
  visit("refinement.appearance.position_m", c.refinement.appearance.position_m, 1e-3, 1e3,
        "standard deviation of the appearance kernel in space");
  visit("refinement.appearance.color", c.refinement.appearance.color, 0.1, 1e3,
        "standard deviation of the appearance kernel in red, green and blue of 0 to 255");
  visit("refinement.appearance.weight", c.refinement.appearance.weight, 0.0, 1e3,
        "how strongly voxels of similar colour should agree");
  visit("space.free", c.space.free, 0.0, 1.0, "store which voxels sensors looked through, to tell free from unknown");
  visit("space.gone", c.space.gone, 0.0, 1.0, "leave out surfaces that sensors have looked through since");
}

/// Every key with its value as text, in the order of VisitFields. SetField undoes it exactly.
std::vector<std::pair<std::string, std::string>> ConfigToText(const MapConfig& config);

/// A key of older versions. Files and stored maps may still have it, at the value that was its default.
struct RetiredField {
  std::string_view key;
  std::string_view default_text;
  /// Maps stored with another value are loaded without its effect; otherwise they are refused.
  bool is_left_out = false;
};
std::span<const RetiredField> RetiredFields();
/// Null if it is none.
const RetiredField* FindRetiredField(std::string_view key);

/// Sets one field from text; INVALID_ARGUMENT for an unknown key or a value that does not parse. Ignores a retired key
/// at its default; INVALID_ARGUMENT at any other value. Does not check ranges.
Status SetField(MapConfig& config, std::string_view key, std::string_view text);

std::string_view WeightingName(Weighting weighting);

}  // namespace dhpmap

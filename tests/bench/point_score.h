// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <unordered_map>
#include <vector>

#include "mapping/labels/label_set.h"
#include "tests/bench/class_match.h"
#include "tests/bench/point_samples.h"

namespace dhpmap {

/// What the map answered for a sample.
struct PointAnswer {
  bool observed = false;
  Panoptic kind = Panoptic::kUnknown;
  std::uint32_t instance = 0;
  std::uint32_t class_id = 0;
};

/// An object of the ground truth.
struct TruthObject {
  std::uint32_t class_id = 0;
  Panoptic kind = Panoptic::kUnknown;
};

/// How the answers compare with the truth. A thing's right instance is the submap that most of its samples answer, one
/// to one (largest counts first); stuff's is a stuff submap of a right class.
struct PointScore {
  /// Where samples with a wrong answer went, in this order of precedence.
  struct Wrong {
    std::int64_t unobserved = 0, out_of_range = 0, unknown_object = 0, at_edge = 0, other = 0;
    void Count(const PointSample& sample, const PointAnswer& answer, double max_range_m);
  };
  struct Thing {
    std::uint32_t segment = 0, class_id = 0;
    std::int64_t num_samples = 0, num_right = 0, num_voxels = 0;
    std::vector<std::uint32_t> submaps;  ///< thing submaps of which most samples are of this thing
  };
  std::int64_t num_samples = 0, num_observed = 0, num_right_class = 0, num_right_instance = 0;
  Wrong wrong_class, wrong_instance;
  std::vector<Thing> things;  ///< by segment
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::int64_t>
      confusions;  ///< (truth, answered class) away from edges
};

/// `max_range_m`: points farther from the sensor were not fused. Samples of objects that are not in `objects`, or whose
/// class is not judged, must have been left out.
PointScore Score(const std::vector<PointSample>& samples, const std::vector<PointAnswer>& answers,
                 const std::unordered_map<std::uint32_t, TruthObject>& objects, const ClassMatch& match,
                 double max_range_m);

}  // namespace dhpmap

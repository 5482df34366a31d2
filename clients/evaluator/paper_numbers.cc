// SPDX-License-Identifier: BSD-3-Clause
#include "clients/evaluator/paper_numbers.h"

#include <algorithm>
#include <iterator>

namespace dhpmap::evaluator {
namespace {

constexpr std::string_view kFlat = "indoor", kKitti = "outdoor_lidar";

constexpr PaperRow kRows[] = {
    {kKitti, "panmap", 0.246, 0.534, 0.804, 0.271, 0.679, {0.546, 0.541, 0.532}, 0.0688, 0.3119, 0.1904, 9.16},
    {kKitti, "dhp_no_refine", 0.297, 0.533, 0.678, 0.240, 0.678, {0.765, 0.761, 0.752}, {}, {}, {}, {}},
    {kKitti, "dhp", 0.340, 0.568, 0.701, 0.263, 0.713, {0.769, 0.765, 0.758}, 0.0506, 0.0584, 0.0549, 56.34},
    {kKitti, "kimera", {}, {}, {}, 0.338, 0.770, {}, 0.0430, 0.1871, 0.1151, 55.54},
    {kFlat, "panmap", 0.274, 0.436, 0.506, 0.378, 0.659, {0.512, 0.512, 0.464}, 0.0086, 0.0763, 0.0424, 88.11},
    {kFlat, "dhp_no_refine", 0.357, 0.660, 0.660, 0.382, 0.631, {0.690, 0.667, 0.667}, {}, {}, {}, {}},
    {kFlat, "dhp", 0.702, 0.708, 0.787, 0.629, 0.854, {0.690, 0.690, 0.690}, 0.0073, 0.0658, 0.0365, 89.75},
    {kFlat, "kimera", {}, {}, {}, 0.670, 0.852, {}, 0.0076, 0.0648, 0.0362, 89.99},
};

}  // namespace

const PaperRow* FindPaperRow(std::string_view preset, std::string_view system) {
  const auto* it = std::find_if(std::begin(kRows), std::end(kRows),
                                [&](const PaperRow& row) { return row.preset == preset && row.system == system; });
  return it == std::end(kRows) ? nullptr : it;
}

std::string_view PaperDataset(std::string_view preset) {
  return preset == kFlat ? "flat" : preset == kKitti ? "SemanticKITTI" : preset;
}

}  // namespace dhpmap::evaluator

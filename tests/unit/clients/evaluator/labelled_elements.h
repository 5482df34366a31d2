// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "clients/evaluator/elements.h"

namespace dhpmap::evaluator::testing {

/// So many elements of one truth and one prediction; class kNone = not judged, or missing.
struct RunOf {
  int count = 0;
  ElementLabel truth, predicted;
};

inline std::vector<Element> Elements(const std::vector<RunOf>& runs) {
  std::vector<Element> elements;
  for (const RunOf& run : runs) elements.insert(elements.end(), run.count, Element{run.truth, run.predicted});
  return elements;
}

inline constexpr ElementLabel kMissing{};
inline constexpr ElementLabel kBallA{0, 10}, kBallB{0, 11}, kBoxA{1, 20}, kFloor{2, 0};

/// Things 0 and 1, stuff 2.
inline ClassMap ThreeClasses() {
  return *ClassMap::Create({{"ball", true, {1}, {1}}, {"box", true, {2}, {2}}, {"floor", false, {3}, {3}}});
}

}  // namespace dhpmap::evaluator::testing

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "mapping/base/ids.h"
#include "mapping/labels/seen_instance.h"

namespace dhpmap {

/// Number of observations of a class, of an instance as the voxel names it, or of a submap.
template <typename Id>
struct SeenCount {
  Id id{};
  std::uint32_t count = 0;
  constexpr bool operator==(const SeenCount&) const = default;
};
using LabelCount = SeenCount<std::uint32_t>;
using InstanceCount = SeenCount<SeenInstance>;
using SubmapCount = SeenCount<SubmapId>;

/// All label counts of a voxel, each list by ascending id.
struct LabelHistograms {
  std::vector<LabelCount> classes;
  std::vector<InstanceCount> instances;
  /// `count` observations of a class, and as many of the own instance.
  static LabelHistograms OfClass(ClassId c, std::uint32_t count = 1) {
    return {{{c.value, count}}, {{kOwnInstance, count}}};
  }
  bool operator==(const LabelHistograms&) const = default;
};

/// Sum of two counts, saturated at 2^32 - 1, so that the most frequent label stays so.
constexpr std::uint32_t SumOfCounts(std::uint32_t a, std::uint32_t b) { return a > ~b ? ~std::uint32_t{0} : a + b; }

/// Sums two lists that are sorted by id.
template <typename Id>
std::vector<SeenCount<Id>> SumCounts(const std::vector<SeenCount<Id>>& a, const std::vector<SeenCount<Id>>& b);

template <typename Id>
std::vector<SeenCount<Id>> SumCounts(const std::vector<SeenCount<Id>>& a, const std::vector<SeenCount<Id>>& b) {
  std::vector<SeenCount<Id>> sum;
  sum.reserve(a.size() + b.size());
  std::size_t i = 0, j = 0;
  while (i < a.size() || j < b.size()) {
    if (j == b.size() || (i < a.size() && a[i].id < b[j].id)) {
      sum.push_back(a[i++]);
    } else if (i == a.size() || b[j].id < a[i].id) {
      sum.push_back(b[j++]);
    } else {
      sum.push_back({a[i].id, SumOfCounts(a[i].count, b[j].count)});
      ++i, ++j;
    }
  }
  return sum;
}

}  // namespace dhpmap

// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/surfaces/unseen_inside.h"

#include <Eigen/Geometry>
#include <algorithm>

#include "mapping/surfaces/submap_surface.h"

namespace dhpmap {

SubmapId UnseenInside::WhoseAt(int linear) const {
  return std::upper_bound(whose.begin(), whose.end(), linear, [](int at, const Run& run) { return at < run.end; })
      ->whose;
}

bool UnseenInside::TellsOf(const FreeMask& unseen, double distance_m) const {
  bool tells_of_all = max_distance_m == distance_m;
  for (std::size_t word = 0; word < unseen.size(); ++word) tells_of_all &= (unseen[word] & ~asked[word]) == 0;
  return tells_of_all;
}

bool AreSame(std::span<const UnseenInside::Thing> then, std::span<const UnseenInside::Thing> now) {
  return std::equal(then.begin(), then.end(), now.begin(), now.end(), [](const auto& a, const auto& b) {
    if (a.id != b.id || a.T_submap_map.matrix() != b.T_submap_map.matrix()) return false;
    const auto was = a.surface.lock(), is = b.surface.lock();
    return was != nullptr && is != nullptr && (was == is || was->IsSameAs(*is));
  });
}

}  // namespace dhpmap

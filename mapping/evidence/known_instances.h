// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "mapping/base/ids.h"
#include "mapping/map/map.h"

namespace dhpmap {

/// The submaps that a refinement may give voxels to, and what a voxel has seen of them: an instance that is none of
/// them (absent, in view, placed by somebody, no longer there) cannot hold it. Immutable, thread-safe.
class KnownInstances {
 public:
  /// Those of `ids` that are in the map and share its grid (IsExclusive).
  KnownInstances(std::span<const SubmapId> ids, const Map& map);

  /// Ascending.
  [[nodiscard]] const std::vector<SubmapId>& ids() const { return ids_; }
  [[nodiscard]] bool Has(SubmapId id) const { return std::binary_search(ids_.begin(), ids_.end(), id); }

  /// Calls visit(SubmapCount) for those that the voxel has seen, by their ids.
  template <typename Visitor>
  void Visit(SubmapId holder, const LabelBlock& labels, int linear, Visitor&& visit) const {
    labels.VisitInstances(linear, [&](InstanceCount seen) {
      const SubmapId instance = seen.id.In(holder);
      if (seen.id.IsOwn() || Has(instance)) visit(SubmapCount{instance, seen.count});
    });
  }

  /// Where the voxel belongs by what it has seen alone: ties go to the smaller id. To who holds it if it has seen none.
  [[nodiscard]] SubmapId MostSeen(SubmapId holder, const LabelBlock& labels, int linear) const;

 private:
  std::vector<SubmapId> ids_;
};

}  // namespace dhpmap

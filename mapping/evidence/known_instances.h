// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "mapping/base/ids.h"
#include "mapping/map/map.h"

namespace dhpmap {

/// The submaps that a refinement may assign voxels to. Counts of other instances (absent, in view, placed by an edit,
/// removed) are ignored. Immutable, thread-safe.
class KnownInstances {
 public:
  /// The subset of `ids` that exists in the map and shares its grid (IsExclusive).
  KnownInstances(std::span<const SubmapId> ids, const Map& map);

  /// Ascending.
  [[nodiscard]] const std::vector<SubmapId>& ids() const { return ids_; }
  [[nodiscard]] bool Has(SubmapId id) const { return std::binary_search(ids_.begin(), ids_.end(), id); }

  /// Calls visit(SubmapCount), by ascending id, for each of them with counts in the voxel.
  template <typename Visitor>
  void Visit(SubmapId holder, const LabelBlock& labels, int linear, Visitor&& visit) const {
    labels.VisitInstances(linear, [&](InstanceCount seen) {
      const SubmapId instance = seen.id.In(holder);
      if (seen.id.IsOwn() || Has(instance)) visit(SubmapCount{instance, seen.count});
    });
  }

  /// The one with the most counts in the voxel (ties: the smaller id); the holder if there is none.
  [[nodiscard]] SubmapId MostSeen(SubmapId holder, const LabelBlock& labels, int linear) const;

 private:
  std::vector<SubmapId> ids_;
};

}  // namespace dhpmap

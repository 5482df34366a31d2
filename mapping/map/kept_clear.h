// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "mapping/base/result.h"
#include "mapping/map/region.h"

namespace dhpmap {

/// An ignored region, which mapping leaves empty.
struct KeptClearRegion {
  std::string name;  ///< [a-z0-9][a-z0-9._-]{0,62}, unique in its map
  Region region;

  friend bool operator==(const KeptClearRegion& a, const KeptClearRegion& b) {
    return a.name == b.name && IsSame(a.region, b.region);
  }
};

/// The ignored regions of a map: frames contribute no points in them and write no voxel with its centre in one.
/// Existing content stays, and edits may put objects there. Value type.
class KeptClear {
 public:
  static constexpr std::size_t kMost = 64;

  KeptClear() = default;
  /// DATA_LOSS unless Add would accept all of them.
  static Result<KeptClear> Create(std::vector<KeptClearRegion> regions);

  /// ALREADY_EXISTS, reason IGNORED_REGION_EXISTS, for a name in use; RESOURCE_EXHAUSTED, TOO_MANY_IGNORED_REGIONS,
  /// beyond kMost; INVALID_ARGUMENT, BAD_EDIT, for an invalid name, or a region that is empty or beyond 1e9 m.
  Status Add(KeptClearRegion region);
  /// Stops ignoring a region. Returns whether there was one of this name.
  bool Lift(std::string_view name);

  /// Null if there is none.
  [[nodiscard]] const KeptClearRegion* Find(std::string_view name) const;
  /// By ascending name.
  [[nodiscard]] const std::vector<KeptClearRegion>& list() const { return list_; }
  [[nodiscard]] bool empty() const { return list_.empty(); }
  friend bool operator==(const KeptClear&, const KeptClear&) = default;

 private:
  std::vector<KeptClearRegion> list_;
};

}  // namespace dhpmap

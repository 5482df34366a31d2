// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <compare>
#include <cstdint>

#include "mapping/base/ids.h"

namespace dhpmap {

/// An observed instance, relative to the voxel's holder: the holder's own instance, or another submap by its id. So a
/// submap can be cloned or renumbered without changing its voxels. Ordered: own first, then by id.
class SeenInstance {
 public:
  /// The own instance.
  constexpr SeenInstance() = default;
  /// A submap other than the holder; not the unknown one, which is no instance.
  constexpr explicit SeenInstance(SubmapId other) : code_(other.value) {}
  /// The instance of `submap`, relative to `holder`.
  static constexpr SeenInstance Of(SubmapId submap, SubmapId holder) {
    return submap == holder ? SeenInstance() : SeenInstance(submap);
  }

  [[nodiscard]] constexpr bool IsOwn() const { return code_ == 0; }
  /// The submap of this instance, if `holder` holds the voxel.
  [[nodiscard]] constexpr SubmapId In(SubmapId holder) const { return IsOwn() ? holder : SubmapId(code_); }

  /// As stored in blobs: 0 for the own instance, else the id of the other submap.
  [[nodiscard]] constexpr std::uint32_t code() const { return code_; }
  static constexpr SeenInstance FromCode(std::uint32_t code) { return SeenInstance(SubmapId(code)); }

  constexpr auto operator<=>(const SeenInstance&) const = default;

 private:
  std::uint32_t code_ = 0;
};
inline constexpr SeenInstance kOwnInstance{};

}  // namespace dhpmap

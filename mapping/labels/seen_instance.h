// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <compare>
#include <cstdint>

#include "mapping/base/ids.h"

namespace dhpmap {

/// The instance that a voxel has seen, as the voxel names it: its own, which is that of whichever submap holds the
/// voxel, or that of another submap, by its id. So a submap can be cloned or renumbered without touching its voxels.
/// They are ordered, its own first, then by id.
class SeenInstance {
 public:
  /// Its own.
  constexpr SeenInstance() = default;
  /// Of a submap that does not hold the voxel; not of the unknown one, which is no instance.
  constexpr explicit SeenInstance(SubmapId other) : code_(other.value) {}
  /// How a voxel that `holder` holds names the instance of `submap`.
  static constexpr SeenInstance Of(SubmapId submap, SubmapId holder) {
    return submap == holder ? SeenInstance() : SeenInstance(submap);
  }

  [[nodiscard]] constexpr bool IsOwn() const { return code_ == 0; }
  /// The submap whose instance it is, if `holder` holds the voxel.
  [[nodiscard]] constexpr SubmapId In(SubmapId holder) const { return IsOwn() ? holder : SubmapId(code_); }

  /// As a number, as blobs have it: 0 for its own, else the id of the other submap.
  [[nodiscard]] constexpr std::uint32_t code() const { return code_; }
  static constexpr SeenInstance FromCode(std::uint32_t code) { return SeenInstance(SubmapId(code)); }

  constexpr auto operator<=>(const SeenInstance&) const = default;

 private:
  std::uint32_t code_ = 0;
};
inline constexpr SeenInstance kOwnInstance{};

}  // namespace dhpmap

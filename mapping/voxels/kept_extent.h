// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <optional>
#include <utility>

namespace dhpmap {

/// A cache for the bounding sphere of the observed voxels of a block table, which every state of a map needs; computing
/// it for a wall takes a millisecond. A copied table keeps it until it is written to. Several readers of a table may
/// call Keep concurrently, because all have the same values. Only the writer calls Forget. Otherwise thread-compatible.
class KeptExtent {
 public:
  /// Centre (x, y, z) and squared radius of the sphere, in voxels; a negative radius: none is observed.
  using Values = std::array<double, 4>;

  KeptExtent() = default;
  KeptExtent(const KeptExtent& other) noexcept { *this = other; }
  KeptExtent& operator=(const KeptExtent& other) noexcept {
    const std::optional<Values> values = other.Find();
    Forget();
    if (values) Keep(*values);
    return *this;
  }

  KeptExtent(KeptExtent&& other) noexcept { *this = std::move(other); }
  KeptExtent& operator=(KeptExtent&& other) noexcept {
    *this = other;
    other.Forget();  // the other table has no blocks any more
    return *this;
  }

  [[nodiscard]] std::optional<Values> Find() const {
    if (!is_known_.load(std::memory_order_acquire)) return std::nullopt;
    Values values;
    for (std::size_t i = 0; i < values.size(); ++i) values[i] = values_[i].load(std::memory_order_relaxed);
    return values;
  }
  void Keep(const Values& values) const {
    for (std::size_t i = 0; i < values.size(); ++i) values_[i].store(values[i], std::memory_order_relaxed);
    is_known_.store(true, std::memory_order_release);
  }
  void Forget() { is_known_.store(false, std::memory_order_relaxed); }

 private:
  mutable std::array<std::atomic<double>, 4> values_{};
  mutable std::atomic<bool> is_known_ = false;
};

}  // namespace dhpmap

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <atomic>
#include <memory>
#include <optional>
#include <utility>

#include "mapping/base/mutex.h"
#include "mapping/base/transform.h"
#include "mapping/submap/outline.h"

namespace dhpmap {

/// The outline of a submap in its own frame, levelled (LevellingOf) for one vertical; invariant under upright moves.
struct LevelOutline {
  Eigen::Vector3d up = Eigen::Vector3d::UnitZ();        ///< the map's vertical in the submap's frame
  std::optional<SubmapOutline> outline = std::nullopt;  ///< nothing: it has no surface

  /// Whether the vertical is that of a submap at this pose, within 1e-9.
  [[nodiscard]] bool IsFor(const Transform& T_map_submap) const {
    constexpr double kRounding = 1e-9;
    return (up - T_map_submap.linear().row(2).transpose()).cwiseAbs().maxCoeff() < kRounding;
  }
};

/// Cache of a submap's outline, valid until its voxels are next written to; stored with the submap and shared by
/// copies. Thread-safe except Forget and assignment, which only the writer calls.
class KeptOutline {
 public:
  KeptOutline() = default;
  KeptOutline(const KeptOutline& other) { Set(other.Get()); }
  KeptOutline& operator=(const KeptOutline& other) {
    if (this != &other) Set(other.Get());
    return *this;
  }

  /// Null if not cached for this pose.
  [[nodiscard]] std::shared_ptr<const LevelOutline> Find(const Transform& T_map_submap) const {
    auto kept = Get();
    return kept != nullptr && kept->IsFor(T_map_submap) ? kept : nullptr;
  }
  /// Null: unknown.
  void Keep(std::shared_ptr<const LevelOutline> outline) const { Set(std::move(outline)); }
  /// Fusion calls it for each block that it writes to: a single load if nothing is cached.
  void Forget() {
    if (is_known_.load(std::memory_order_relaxed)) Set(nullptr);
  }

 private:
  [[nodiscard]] std::shared_ptr<const LevelOutline> Get() const DHPMAP_EXCLUDES(mutex_) {
    const MutexLock lock(mutex_);
    return kept_;
  }
  void Set(std::shared_ptr<const LevelOutline> kept) const DHPMAP_EXCLUDES(mutex_) {
    const MutexLock lock(mutex_);
    is_known_.store(kept != nullptr, std::memory_order_relaxed);
    kept_.swap(kept);
  }

  mutable std::atomic<bool> is_known_ = false;  ///< kept_ is not null
  mutable Mutex mutex_;
  mutable std::shared_ptr<const LevelOutline> kept_ DHPMAP_GUARDED_BY(mutex_);
};

}  // namespace dhpmap

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <memory>

#include "mapping/base/mutex.h"
#include "server/app/states/map_view.h"

namespace dhpmap {

/// The visible state of a map. A state made by frames may be prepared first, so that queries find warm caches; until
/// then, or until the next state, the previous one stays visible. States only get newer. Thread-safe.
class VisibleSnapshot : public std::enable_shared_from_this<VisibleSnapshot> {
 public:
  using State = std::shared_ptr<const MapSnapshot>;
  /// Prepares a state and then calls ready(), on any thread, unless a newer state came first. False: there is nothing
  /// to prepare. `ready` may be empty: the state is visible already.
  using Prepare = std::function<bool(const State&, std::function<void()> ready)>;

  /// `prepare` may be empty.
  VisibleSnapshot(std::shared_ptr<const MapView> first, Prepare prepare);

  [[nodiscard]] std::shared_ptr<const MapView> Get() const DHPMAP_EXCLUDES(mutex_);
  /// The visible state, or the one being prepared.
  [[nodiscard]] std::shared_ptr<const MapView> Newest() const DHPMAP_EXCLUDES(mutex_);
  /// Whether one is being prepared.
  [[nodiscard]] bool IsWaiting() const DHPMAP_EXCLUDES(mutex_);

  /// Makes `next` visible; it is no older than Newest().
  void Show(std::shared_ptr<const MapView> next) DHPMAP_EXCLUDES(mutex_);
  /// The same once it is prepared. A state that is being prepared already becomes visible now.
  void ShowPrepared(std::shared_ptr<const MapView> next) DHPMAP_EXCLUDES(mutex_);
  /// Makes the state being prepared visible now.
  void ShowNewest() DHPMAP_EXCLUDES(mutex_);

 private:
  void OnPrepared(const std::weak_ptr<const MapView>& view) DHPMAP_EXCLUDES(mutex_);

  const Prepare prepare_;
  mutable Mutex mutex_;  // nothing is freed while it is held
  std::shared_ptr<const MapView> shown_ DHPMAP_GUARDED_BY(mutex_);
  std::shared_ptr<const MapView> waiting_ DHPMAP_GUARDED_BY(mutex_);  ///< null: none
};

}  // namespace dhpmap

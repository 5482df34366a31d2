// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <memory>

#include "mapping/base/mutex.h"
#include "server/app/states/map_view.h"

namespace dhpmap {

/// Which state of a map is seen. One that frames have made may be prepared first, so that who asks then need not wait
/// for what all ask for: until it is, or the next one comes, the one before is seen. States only ever get newer.
/// Thread-safe.
class ShownView : public std::enable_shared_from_this<ShownView> {
 public:
  using State = std::shared_ptr<const MapSnapshot>;
  /// Takes a state to prepare it, and calls ready() once it is, on any thread, unless a newer one came before. False:
  /// it does not, as there is nothing to do. `ready` may be empty: it is seen already.
  using Prepare = std::function<bool(const State&, std::function<void()> ready)>;

  /// `prepare` may be empty.
  ShownView(std::shared_ptr<const MapView> first, Prepare prepare);

  [[nodiscard]] std::shared_ptr<const MapView> Get() const DHPMAP_EXCLUDES(mutex_);
  /// That which is seen, or will be next.
  [[nodiscard]] std::shared_ptr<const MapView> Newest() const DHPMAP_EXCLUDES(mutex_);
  /// Whether one is being prepared.
  [[nodiscard]] bool IsWaiting() const DHPMAP_EXCLUDES(mutex_);

  /// From now on `next` is seen, which is no older than Newest().
  void Show(std::shared_ptr<const MapView> next) DHPMAP_EXCLUDES(mutex_);
  /// The same once it is prepared. One that waits for that already is seen now.
  void ShowPrepared(std::shared_ptr<const MapView> next) DHPMAP_EXCLUDES(mutex_);
  /// One that waits is seen now.
  void ShowNewest() DHPMAP_EXCLUDES(mutex_);

 private:
  void OnPrepared(const std::weak_ptr<const MapView>& view) DHPMAP_EXCLUDES(mutex_);

  const Prepare prepare_;
  mutable Mutex mutex_;  // nothing is freed under it
  std::shared_ptr<const MapView> shown_ DHPMAP_GUARDED_BY(mutex_);
  std::shared_ptr<const MapView> waiting_ DHPMAP_GUARDED_BY(mutex_);  ///< null: none
};

}  // namespace dhpmap

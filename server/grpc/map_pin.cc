// SPDX-License-Identifier: BSD-3-Clause
#include "server/grpc/map_pin.h"

#include <grpcpp/alarm.h>

#include <utility>

#include "mapping/base/mutex.h"
#include "server/grpc/passing_time.h"

namespace dhpmap {

struct MapPin::Held {
  std::string map;
  grpc::Alarm alarm;
  Mutex mutex;
  std::shared_ptr<const MapView> view DHPMAP_GUARDED_BY(mutex);  ///< null: its time is over
};

MapPin::MapPin(std::chrono::milliseconds longest) : longest_(longest) {}

MapPin::~MapPin() { Release(); }

void MapPin::Hold(std::string map, std::shared_ptr<const MapView> view) {
  Release();
  held_ = std::make_shared<Held>();
  held_->map = std::move(map);
  {
    const MutexLock lock(held_->mutex);
    held_->view = std::move(view);
  }
  held_->alarm.Set(GrpcTimeIn(longest_), [held = std::weak_ptr(held_)](bool) {
    const auto still = held.lock();
    if (still == nullptr) return;
    std::shared_ptr<const MapView> last;  // freed after the mutex is released
    const MutexLock lock(still->mutex);
    last.swap(still->view);
  });
}

void MapPin::Release() { held_.reset(); }

Result<std::shared_ptr<const MapView>> MapPin::Of(const std::string& map) const {
  if (held_ == nullptr || held_->map != map) return std::shared_ptr<const MapView>();
  const MutexLock lock(held_->mutex);
  if (held_->view != nullptr) return held_->view;
  return FailedPrecondition("the state that was pinned is let go: its time was over")
      .WithViolation("pin", "is too old: pin again, or release it");
}

}  // namespace dhpmap

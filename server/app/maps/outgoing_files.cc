// SPDX-License-Identifier: BSD-3-Clause
#include "server/app/maps/outgoing_files.h"

#include <algorithm>
#include <string>
#include <utility>

namespace dhpmap {

class OutgoingFiles::File final : public StoreBackup {
 public:
  File(std::shared_ptr<Place> place, std::int64_t num_bytes) : place_(std::move(place)), num_bytes_(num_bytes) {}
  [[nodiscard]] std::int64_t size_bytes() const override { return num_bytes_; }

  Result<std::string> Read(std::size_t max_bytes) override {
    const MutexLock lock(place_->mutex);
    if (place_->file == nullptr) {
      return Aborted("the file was not read on, and another was wanted: begin again").WithReason("DOWNLOAD_EVICTED");
    }
    place_->read_last = Clock::now();
    return place_->file->Read(max_bytes);
  }

 private:
  const std::shared_ptr<Place> place_;
  const std::int64_t num_bytes_;
};

OutgoingFiles::Opened OutgoingFiles::Open(const std::function<Opened()>& open) {
  auto place = TakePlace();
  if (place == nullptr) {
    return ResourceExhausted("as many files go out as may at once: try again later").WithReason("TOO_BUSY");
  }
  DHPMAP_ASSIGN_OR_RETURN(std::unique_ptr<StoreBackup> file, open());
  const std::int64_t num_bytes = file->size_bytes();
  {
    const MutexLock lock(place->mutex);
    place->file = std::move(file);
    place->read_last = Clock::now();
  }
  return std::unique_ptr<StoreBackup>(std::make_unique<File>(std::move(place), num_bytes));
}

std::shared_ptr<OutgoingFiles::Place> OutgoingFiles::TakePlace() {
  const MutexLock lock(mutex_);
  std::erase_if(places_, [](const std::weak_ptr<Place>& place) { return place.expired(); });
  if (places_.size() >= max_) {
    const auto idle = std::find_if(places_.begin(), places_.end(), [this](const std::weak_ptr<Place>& weak) {
      const auto place = weak.lock();
      return place == nullptr || LetGoIfIdle(*place);
    });
    if (idle == places_.end()) return nullptr;
    places_.erase(idle);
  }
  auto place = std::make_shared<Place>();
  places_.push_back(place);
  return place;
}

bool OutgoingFiles::LetGoIfIdle(Place& place) const {
  const MutexLock lock(place.mutex);
  if (place.read_last > Clock::now() - idle_) return false;
  place.file.reset();
  return true;
}

}  // namespace dhpmap

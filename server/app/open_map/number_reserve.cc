// SPDX-License-Identifier: BSD-3-Clause
#include "server/app/open_map/number_reserve.h"

#include <algorithm>

namespace dhpmap {

bool NumberReserve::Covers(const MapInfo& info) const {
  const MutexLock lock(mutex_);
  return info.revision <= marks_.revision && info.next_submap_id <= marks_.next_submap_id;
}

Status NumberReserve::Cover(const MapInfo& info) {
  {
    const MutexLock lock(mutex_);
    used_ = {std::max(used_.revision, info.revision), std::max(used_.next_submap_id, info.next_submap_id)};
  }
  if (Covers(info)) return Status::Ok();
  const MutexLock store_lock(store_mutex_);
  return Covers(info) ? Status::Ok() : Reserve(info.name);  // another thread may have been faster
}

void NumberReserve::GoAhead(const std::string& map) {
  const MutexLock store_lock(store_mutex_);
  {
    const MutexLock lock(mutex_);
    const std::int64_t revisions_left = marks_.revision - used_.revision;
    const auto ids_left = std::int64_t{marks_.next_submap_id.value} - std::int64_t{used_.next_submap_id.value};
    const bool is_all_stored = revisions_left == 0 && ids_left == 0;
    if (is_all_stored || (revisions_left >= kRevisionsAStep / 2 && ids_left >= kIdsAStep / 2)) return;
  }
  (void)Reserve(map);
}

Status NumberReserve::Reserve(const std::string& map) {
  NumberMarks wanted;
  {
    const MutexLock lock(mutex_);
    wanted = {used_.revision + kRevisionsAStep, SubmapId(used_.next_submap_id.value + kIdsAStep)};
  }
  DHPMAP_RETURN_IF_ERROR(store_.Reserve(map, wanted));
  const MutexLock lock(mutex_);
  marks_ = wanted;
  return Status::Ok();
}

void NumberReserve::Release(const MapInfo& info) {
  const MutexLock store_lock(store_mutex_);
  {
    const MutexLock lock(mutex_);
    if (marks_.revision == info.revision && marks_.next_submap_id == info.next_submap_id) return;
  }
  const NumberMarks stored{info.revision, info.next_submap_id};
  if (!store_.Reserve(info.name, stored).ok()) return;  // a gap is harmless
  const MutexLock lock(mutex_);
  marks_ = stored;
}

}  // namespace dhpmap

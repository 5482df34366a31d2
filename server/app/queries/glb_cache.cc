// SPDX-License-Identifier: BSD-3-Clause
#include "server/app/queries/glb_cache.h"

namespace dhpmap {

std::shared_ptr<const GlbFile> GlbCache::Find(std::uint64_t name) {
  const MutexLock lock(mutex_);
  const auto found = by_name_.find(name);
  if (found == by_name_.end()) return nullptr;
  entries_.splice(entries_.begin(), entries_, found->second);
  return found->second->second;
}

void GlbCache::Put(std::uint64_t name, std::shared_ptr<const GlbFile> file) {
  if (file->bytes.size() > limit_bytes_ / 2) return;
  std::list<Entry> forgotten;  // destroyed after the mutex is released
  const MutexLock lock(mutex_);
  if (by_name_.contains(name)) return;  // another thread has added it
  bytes_ += file->bytes.size();
  entries_.emplace_front(name, std::move(file));
  by_name_[name] = entries_.begin();
  while (bytes_ > limit_bytes_) {
    const auto oldest = std::prev(entries_.end());
    bytes_ -= oldest->second->bytes.size();
    by_name_.erase(oldest->first);
    forgotten.splice(forgotten.begin(), entries_, oldest);
  }
  counted_.Set(bytes_);
}

std::size_t GlbCache::bytes() const {
  const MutexLock lock(mutex_);
  return bytes_;
}

}  // namespace dhpmap

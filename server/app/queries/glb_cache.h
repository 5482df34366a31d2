// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <list>
#include <memory>
#include <string>
#include <unordered_map>
#include <utility>

#include "mapping/base/memory_count.h"
#include "mapping/base/mutex.h"

namespace dhpmap {

/// A file of surfaces. Immutable.
struct GlbFile {
  std::string bytes;
  std::string content_tag;  ///< the same for the same bytes
};

/// A cache of GLB files by the name of their content (GlbPlan::name), so that repeated requests need no new file. Other
/// content has another name, so entries never become stale; the least recently used are evicted. Thread-safe.
class GlbCache {
 public:
  /// Limit for the size of all files. A file above half of it is not stored.
  explicit GlbCache(std::size_t limit_bytes) : limit_bytes_(limit_bytes) {}

  /// Null: not cached.
  std::shared_ptr<const GlbFile> Find(std::uint64_t name) DHPMAP_EXCLUDES(mutex_);
  /// `file`: not null.
  void Put(std::uint64_t name, std::shared_ptr<const GlbFile> file) DHPMAP_EXCLUDES(mutex_);
  [[nodiscard]] std::size_t bytes() const DHPMAP_EXCLUDES(mutex_);

 private:
  using Entry = std::pair<std::uint64_t, std::shared_ptr<const GlbFile>>;

  const std::size_t limit_bytes_;
  mutable Mutex mutex_;
  std::list<Entry> entries_ DHPMAP_GUARDED_BY(mutex_);  ///< the last used first
  std::unordered_map<std::uint64_t, std::list<Entry>::iterator> by_name_ DHPMAP_GUARDED_BY(mutex_);
  std::size_t bytes_ DHPMAP_GUARDED_BY(mutex_) = 0;
  CountedBytes counted_ DHPMAP_GUARDED_BY(mutex_){MemoryKind::kMeshing};
};

}  // namespace dhpmap

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

/// Files by the name of what they show (NameOfGlb), so that who asks again, or looks at the same, waits for nobody to
/// make it. A state that shows something else has another name: nothing is ever out of date, it is only not asked for
/// any more, and those not asked for longest go. Thread-safe.
class GlbCache {
 public:
  /// What the files may take in all. One that would take more than half of it is not kept.
  explicit GlbCache(std::size_t limit_bytes) : limit_bytes_(limit_bytes) {}

  /// Null: it is not there.
  std::shared_ptr<const GlbFile> Find(std::uint64_t name) DHPMAP_EXCLUDES(mutex_);
  /// `file`: not null.
  void Put(std::uint64_t name, std::shared_ptr<const GlbFile> file) DHPMAP_EXCLUDES(mutex_);
  [[nodiscard]] std::size_t bytes() const DHPMAP_EXCLUDES(mutex_);

 private:
  using Entry = std::pair<std::uint64_t, std::shared_ptr<const GlbFile>>;

  const std::size_t limit_bytes_;
  mutable Mutex mutex_;
  std::list<Entry> entries_ DHPMAP_GUARDED_BY(mutex_);  ///< that asked for last in front
  std::unordered_map<std::uint64_t, std::list<Entry>::iterator> by_name_ DHPMAP_GUARDED_BY(mutex_);
  std::size_t bytes_ DHPMAP_GUARDED_BY(mutex_) = 0;
  CountedBytes counted_ DHPMAP_GUARDED_BY(mutex_){MemoryKind::kMeshing};
};

}  // namespace dhpmap

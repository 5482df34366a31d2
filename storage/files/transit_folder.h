// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>

#include "mapping/base/mutex.h"
#include "mapping/base/result.h"

namespace dhpmap {

/// A folder of this process alone, for the files of maps that go in or out of a store which is no file itself. Made
/// when it is first asked for a place, removed with all that is in it by the destructor, or, after a kill, by the next
/// process that makes one beside it. Thread-safe.
class TransitFolder {
 public:
  /// `parent`: where it is made; empty: the system's folder for temporary files.
  explicit TransitFolder(std::string parent);
  ~TransitFolder();
  TransitFolder(const TransitFolder&) = delete;
  TransitFolder& operator=(const TransitFolder&) = delete;

  /// A path that nobody has used. UNAVAILABLE if the folder cannot be made.
  Result<std::string> NewPlace() DHPMAP_EXCLUDES(mutex_);

 private:
  Status Make() DHPMAP_REQUIRES(mutex_);

  const std::string parent_;
  Mutex mutex_;
  std::string path_ DHPMAP_GUARDED_BY(mutex_);     ///< empty: not made yet
  int descriptor_ DHPMAP_GUARDED_BY(mutex_) = -1;  ///< of the folder: holds a lock that tells that we live
  std::int64_t num_places_ DHPMAP_GUARDED_BY(mutex_) = 0;
};

}  // namespace dhpmap

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <string>

#include "mapping/base/mutex.h"
#include "storage/postgres/owned_map.h"
#include "storage/postgres/pool.h"

namespace dhpmap::postgres {

/// The maps that this process writes. A map is taken when it is first loaded or written. Thread-safe.
class MapOwnership {
 public:
  /// `pool` outlives it.
  MapOwnership(Pool& pool, PassingTime time);

  /// Takes it if it is not ours. Errors as TakeMap.
  Result<std::shared_ptr<OwnedMap>> Own(const std::string& name) DHPMAP_EXCLUDES(mutex_);
  /// Null if it is not ours.
  [[nodiscard]] std::shared_ptr<OwnedMap> Find(const std::string& name) DHPMAP_EXCLUDES(mutex_);
  /// A map that is going to be created.
  [[nodiscard]] std::shared_ptr<OwnedMap> New(const std::string& name) const;
  void Add(std::shared_ptr<OwnedMap> map) DHPMAP_EXCLUDES(mutex_);
  /// After a deletion, or when somebody else has taken it.
  void Drop(const OwnedMap& map) DHPMAP_EXCLUDES(mutex_);

  [[nodiscard]] std::int64_t server() const { return server_; }

 private:
  Pool& pool_;
  const PassingTime time_;
  const std::int64_t server_;  ///< random, so that no two processes have the same
  Mutex mutex_;
  std::map<std::string, std::shared_ptr<OwnedMap>> maps_ DHPMAP_GUARDED_BY(mutex_);
};

}  // namespace dhpmap::postgres

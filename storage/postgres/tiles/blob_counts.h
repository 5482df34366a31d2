// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <map>
#include <vector>

#include "storage/postgres/values.h"

namespace dhpmap::postgres {

/// By how much a commit changes the number of references to each blob.
class BlobCounts {
 public:
  void Add(std::int64_t blob_key, std::int64_t num) {
    if (blob_key != 0) changes_[blob_key] += num;
  }
  /// `now_ns`: the time from which blobs without references count as unused.
  void Write(std::int64_t map_key, std::int64_t now_ns, std::vector<Call>& calls) const;

 private:
  std::map<std::int64_t, std::int64_t> changes_;
};

}  // namespace dhpmap::postgres

// SPDX-License-Identifier: BSD-3-Clause
#include "storage/postgres/tiles/blob_counts.h"

#include <span>
#include <string>

namespace dhpmap::postgres {
namespace {

const std::string kCountBlobs =
    "INSERT INTO blob_counts AS c (map_key, blob_key, num_refs, since_ns) SELECT $1, d.blob_key, 1 + d.num, $4 FROM "
    "unnest($2, $3) AS d (blob_key, num) ON CONFLICT (map_key, blob_key) DO UPDATE SET num_refs = c.num_refs + "
    "excluded.num_refs - 1, since_ns = excluded.since_ns";

}  // namespace

void BlobCounts::Write(std::int64_t map_key, std::int64_t now_ns, std::vector<Call>& calls) const {
  std::vector<std::int64_t> keys, numbers;
  for (const auto& [key, number] : changes_) {
    if (number == 0) continue;
    keys.push_back(key);
    numbers.push_back(number);
  }
  if (keys.empty()) return;
  Call& call = calls.emplace_back(Call{&kCountBlobs});
  call.values.Add(map_key).Add(std::span<const std::int64_t>(keys)).Add(std::span<const std::int64_t>(numbers));
  call.values.Add(now_ns);
}

}  // namespace dhpmap::postgres

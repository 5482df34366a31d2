// SPDX-License-Identifier: BSD-3-Clause
#include "storage/commit_rules.h"

#include <string>

namespace dhpmap {

Status ValidateCommit(const MapInfo& before, const MapInfo& after) {
  if (before.name == after.name && before.create_time_ns == after.create_time_ns && before.revision <= after.revision) {
    return Status::Ok();
  }
  return InvalidArgument("map '" + after.name + "' at revision " + std::to_string(after.revision) +
                         " does not follow map '" + before.name + "' at revision " + std::to_string(before.revision));
}

Status ValidateBase(const MapInfo& before, std::int64_t stored_revision, std::int64_t stored_create_time_ns) {
  if (before.create_time_ns != stored_create_time_ns) {
    return FailedPrecondition("map '" + before.name + "' was deleted, and another one has its name now")
        .WithReason("STALE_REVISION");
  }
  if (before.revision == stored_revision) return Status::Ok();
  return FailedPrecondition("map '" + before.name + "' is stored at revision " + std::to_string(stored_revision) +
                            ", the commit starts from " + std::to_string(before.revision))
      .WithReason("STALE_REVISION");
}

}  // namespace dhpmap

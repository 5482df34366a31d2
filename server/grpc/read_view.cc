// SPDX-License-Identifier: BSD-3-Clause
#include "server/grpc/read_view.h"

namespace dhpmap {

Status CheckReadRevision(std::int64_t read_revision, std::int64_t min_revision) {
  if (read_revision <= 0 || min_revision <= read_revision) return Status::Ok();
  return InvalidArgument("what the query waits for is later than what it is to be answered from")
      .WithReason("BAD_REVISION")
      .WithViolation("options.min_revision", "is above read_revision");
}

Result<std::shared_ptr<const MapView>> ViewFor(const ServiceContext& context, const std::string& map,
                                               const WantedState& wanted, std::shared_ptr<const MapView> pinned) {
  const std::int64_t read_revision = wanted.read_revision;
  if (pinned != nullptr && (read_revision == 0 || read_revision == pinned->snapshot().revision())) return pinned;
  if (read_revision == 0 && wanted.is_eventual) return context.registry.EventualViewOf(map, wanted.at_least);
  if (read_revision == 0) return context.registry.ViewOf(map);
  return context.registry.ViewAt(map, read_revision, "read_revision");
}

}  // namespace dhpmap

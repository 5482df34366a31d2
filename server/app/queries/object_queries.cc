// SPDX-License-Identifier: BSD-3-Clause
#include "server/app/queries/object_queries.h"

namespace dhpmap {
namespace {

Status NobodyWaits() { return Cancelled("the client went away"); }

}  // namespace

Result<std::vector<SubmapMatch>> FindSubmaps(const MapView& view, SurfaceCache& cache, const SubmapQuestion& question,
                                             const std::stop_token& stop) {
  std::vector<SubmapMatch> matches =
      SearchSubmaps(*cache.Of(view.shared_snapshot(), question.scope.with_absent), question, stop);
  if (stop.stop_requested()) return NobodyWaits();
  return matches;
}

Result<std::vector<Relation>> ListRelations(const MapView& view, SurfaceCache& cache, const RelationQuestion& question,
                                            const std::stop_token& stop) {
  std::vector<Relation> relations =
      FindRelations(*cache.Of(view.shared_snapshot(), question.scope.with_absent), question, stop);
  if (stop.stop_requested()) return NobodyWaits();
  return relations;
}

}  // namespace dhpmap

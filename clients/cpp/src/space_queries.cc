// SPDX-License-Identifier: BSD-3-Clause
// Queries of regions: slices, grids, relations.
#include <algorithm>
#include <utility>

#include "clients/cpp/calls/error.h"
#include "clients/cpp/src/convert/geometry.h"
#include "clients/cpp/src/convert/options.h"
#include "clients/cpp/src/source.h"
#include "dhpmap/queries.h"

namespace dhpmap::client {
namespace {

constexpr v1::Relation::Kind kRelationKinds[] = {v1::Relation::ON, v1::Relation::IN, v1::Relation::NEXT_TO};

Status BadAnswer(const char* what) {
  return Error(StatusCode::kInternal, std::string("the server sent ") + what + " that are not as many as it says");
}

Result<Relation> RelationOf(const v1::Relation& told) {
  const auto* kind = std::find(std::begin(kRelationKinds), std::end(kRelationKinds), told.kind());
  if (kind == std::end(kRelationKinds)) return Error(StatusCode::kInternal, "the server sent a relation of no kind");
  return Relation{static_cast<Relation::Kind>(kind - std::begin(kRelationKinds)),
                  IdOfName(told.subject()),
                  IdOfName(told.object()),
                  told.subject_display_name(),
                  told.object_display_name(),
                  told.support(),
                  told.enclosure(),
                  told.gap_m()};
}

/// Appends the nodes of messages that arrive in order.
Status AppendNodes(const v1::QueryDistanceGridResponse& part, DistanceGrid& grid) {
  if (part.status_size() != part.distance_m_size() ||
      static_cast<std::size_t>(part.first_node()) != grid.distance_m.size()) {
    return BadAnswer("nodes");
  }
  if (part.first_node() == 0) {
    grid.revision = part.revision();
    grid.num_x = part.num_x();
    grid.num_y = part.num_y();
    grid.num_z = part.num_z();
  }
  grid.distance_m.insert(grid.distance_m.end(), part.distance_m().begin(), part.distance_m().end());
  for (const int status : part.status()) grid.is_known.push_back(status != v1::QueryStatus::UNKNOWN);
  return {};
}

}  // namespace

Result<Slice> Queries::Slice(const SliceOptions& options) const {
  v1::StreamQueriesRequest query;
  v1::QueryOccupancySliceRequest& request = *query.mutable_query_occupancy_slice();
  request.set_map(source()->map());
  request.set_min_z_m(options.min_z_m);
  request.set_max_z_m(options.max_z_m);
  if (options.area) {
    request.mutable_area()->set_min_x_m(options.area->min_m.x);
    request.mutable_area()->set_min_y_m(options.area->min_m.y);
    request.mutable_area()->set_max_x_m(options.area->max_m.x);
    request.mutable_area()->set_max_y_m(options.area->max_m.y);
  }
  if (options.resolution_m) request.set_resolution_m(*options.resolution_m);
  if (options.min_free_fraction) request.set_min_free_fraction(*options.min_free_fraction);
  *request.mutable_options() = ToProto(options.query, source()->map());
  request.set_read_revision(source()->read_revision());
  const auto response = source()->Answer(std::move(query), options.query.deadline_s);
  if (!response.ok()) return response.status();
  const v1::QueryOccupancySliceResponse& told = response->query_occupancy_slice();
  const auto num_cells = static_cast<std::int64_t>(told.width()) * told.height();
  if (static_cast<std::int64_t>(told.cells().size()) != num_cells) return BadAnswer("cells");
  return client::Slice{told.revision(),
                       told.width(),
                       told.height(),
                       told.resolution_m(),
                       FromProto(told.origin_m()),
                       {told.cells().begin(), told.cells().end()}};
}

Result<DistanceGrid> Queries::Grid(const Box& box, double resolution_m, const QueryOptions& options) const {
  v1::QueryDistanceGridRequest request;
  request.set_map(source()->map());
  *request.mutable_box() = ToProto(box);
  request.set_resolution_m(resolution_m);
  *request.mutable_options() = ToProto(options, source()->map());
  const auto parts = source()->AnswerGrid(std::move(request), options.deadline_s);
  DistanceGrid grid;
  grid.resolution_m = resolution_m;
  grid.origin_m = box.min_m;
  for (v1::QueryDistanceGridResponse part; parts->Next(part);) {
    if (Status status = AppendNodes(part, grid); !status.ok()) return status;
  }
  if (Status status = parts->Finish(); !status.ok()) return status;
  const auto num_nodes = static_cast<std::int64_t>(grid.num_x) * grid.num_y * grid.num_z;
  if (static_cast<std::int64_t>(grid.distance_m.size()) != num_nodes) return BadAnswer("nodes");
  return grid;
}

Result<std::vector<Relation>> Queries::Relations(const RelationOptions& options) const {
  v1::QueryRelationsRequest request;
  request.set_map(source()->map());
  if (options.of) request.set_submap(SubmapName(source()->map(), *options.of));
  for (const Relation::Kind kind : options.kinds) request.add_kinds(kRelationKinds[static_cast<int>(kind)]);
  if (options.max_gap_m) request.set_max_gap_m(*options.max_gap_m);
  if (options.min_support) request.set_min_support(*options.min_support);
  if (options.min_enclosure) request.set_min_enclosure(*options.min_enclosure);
  *request.mutable_options() = ToProto(options.query, source()->map());
  request.set_read_revision(source()->read_revision());
  std::vector<Relation> found;
  do {
    v1::StreamQueriesRequest query;
    *query.mutable_query_relations() = request;
    const auto response = source()->Answer(std::move(query), options.query.deadline_s);
    if (!response.ok()) return response.status();
    for (const v1::Relation& told : response->query_relations().relations()) {
      Result<Relation> relation = RelationOf(told);
      if (!relation.ok()) return relation.status();
      found.push_back(*std::move(relation));
    }
    request.set_page_token(response->query_relations().next_page_token());
  } while (!request.page_token().empty());
  return found;
}

}  // namespace dhpmap::client

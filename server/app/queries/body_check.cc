// SPDX-License-Identifier: BSD-3-Clause
#include "server/app/queries/body_check.h"

#include <algorithm>
#include <optional>
#include <utility>
#include <variant>

#include "mapping/query/work_budget.h"

namespace dhpmap {
namespace {

// The cache may evict surfaces between batches.
constexpr std::size_t kBodiesABatch = 1024;

Status NobodyWaitsForCheck() { return Cancelled("the client went away"); }

/// One query for each list of allowed contacts, created on first use.
class BodyQueries {
 public:
  BodyQueries(std::shared_ptr<const MapSurfaces> surfaces, const CheckQuestion& question)
      : surfaces_(std::move(surfaces)), question_(question), queries_(question.parts.lists.size()) {}

  const BodyQuery& Of(std::size_t body) {
    const std::size_t list = question_.parts.ListOf(body);
    std::optional<BodyQuery>& query = queries_[list];
    if (!query) {
      BodyOptions options = question_.options;
      options.scope.may_touch = question_.parts.lists[list];
      query.emplace(surfaces_, std::move(options));
    }
    return *query;
  }

 private:
  const std::shared_ptr<const MapSurfaces> surfaces_;
  const CheckQuestion& question_;
  std::vector<std::optional<BodyQuery>> queries_;
};

}  // namespace

void MoveContact(const Transform& T_query_map, BodyContact& contact) {
  contact.point_m = T_query_map * contact.point_m;
  contact.normal = T_query_map.linear() * contact.normal;
}

Status TooMuchWork(const char* field) {
  return ResourceExhausted("the check would take too long")
      .WithViolation(field,
                     "are near more of the map than one call may look at: ask for fewer or smaller ones, or with "
                     "less padding");
}

BodyCheck::BodyCheck(std::shared_ptr<const MapSnapshot> state, SurfaceCache& cache, CheckQuestion question,
                     std::span<const Body> bodies, std::int64_t most_work)
    : state_(std::move(state)), cache_(cache), question_(std::move(question)), bodies_(bodies), work_left_(most_work) {}

Result<bool> BodyCheck::Next(const CheckPiece& piece, const std::stop_token& stop,
                             const std::function<void(const BodyAnswer&)>& take) {
  const Transform T_query_map = question_.T_map_query.inverse();
  BodyQueries queries(cache_.Of(state_, question_.options.scope.with_absent), question_);
  WorkBudget work(piece.may_overrun ? work_left_ : std::min(work_left_, piece.work), stop);
  const std::size_t end = std::min(bodies_.size(), next_ + kBodiesABatch);
  for (; next_ < end && work.spent() < piece.work; ++next_) {
    if (stop.stop_requested()) return NobodyWaitsForCheck();
    const Body in_map =
        std::visit([&](const auto& b) -> Body { return Moved(question_.T_map_query, b); }, bodies_[next_]);
    const BodyQuery& query = queries.Of(next_);
    BodyAnswer answer =
        question_.max_contacts == 0 ? query.Test(in_map, &work) : query.Check(in_map, question_.max_contacts, &work);
    if (work.is_over()) break;
    for (BodyContact& contact : answer.contacts) MoveContact(T_query_map, contact);
    take(answer);
  }
  if (next_ == bodies_.size()) return false;
  if (stop.stop_requested()) return NobodyWaitsForCheck();
  work_left_ -= work.spent();
  if (work_left_ <= 0) return TooMuchWork("bodies");
  return true;
}

Status CheckBodies(const MapView& view, SurfaceCache& cache, const CheckQuestion& question,
                   std::span<const Body> bodies, const std::stop_token& stop,
                   const std::function<void(const BodyAnswer&)>& take) {
  BodyCheck check(view.shared_snapshot(), cache, question, bodies);
  for (;;) {
    DHPMAP_ASSIGN_OR_RETURN(const bool has_more, check.Next({}, stop, take));
    if (!has_more) return Status::Ok();
  }
}

}  // namespace dhpmap

// SPDX-License-Identifier: BSD-3-Clause
#include "storage/postgres/postgres_error.h"

#include <libpq-fe.h>

#include <utility>

namespace dhpmap::postgres {
namespace {

StatusCode CodeOf(std::string_view sqlstate) {
  const std::string_view group = sqlstate.substr(0, 2);
  if (sqlstate == "23505") return StatusCode::kAlreadyExists;                  // unique_violation
  if (sqlstate == "25006" || group == "42" || group == "28" || group == "3D")  // read-only, rights, login, database
    return StatusCode::kFailedPrecondition;
  if (group == "08" || group == "57" || group == "40" || group == "55") return StatusCode::kUnavailable;
  if (group == "53" || group == "54") return StatusCode::kResourceExhausted;
  if (group == "XX" || group == "58") return StatusCode::kDataLoss;
  if (group == "22") return StatusCode::kInvalidArgument;
  return StatusCode::kInternal;
}

}  // namespace

Status ErrorFrom(std::string_view sqlstate, std::string_view task, std::string said) {
  return Status(CodeOf(sqlstate), "cannot " + std::string(task) + " (PostgreSQL " + std::string(sqlstate) + ")")
      .WithCause(std::move(said));
}

std::string SqlStateOf(const pg_result* result) {
  const char* state = PQresultErrorField(result, PG_DIAG_SQLSTATE);
  return state == nullptr ? "" : state;
}

Status ConnectionLost(std::string_view task, std::string said) {
  return Unavailable("cannot " + std::string(task) + ": the database does not answer").WithCause(std::move(said));
}

bool MayHaveCommitted(std::string_view sqlstate) {
  const std::string_view group = sqlstate.substr(0, 2);
  return sqlstate.empty() || group == "08" || group == "57";
}

bool IsWorthRepeating(std::string_view sqlstate) { return sqlstate == "40001" || sqlstate == "40P01"; }

}  // namespace dhpmap::postgres

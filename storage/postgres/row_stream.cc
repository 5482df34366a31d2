// SPDX-License-Identifier: BSD-3-Clause
// Connection::Stream: visits the rows of one statement as they arrive.
#include <libpq-fe.h>

#include "storage/postgres/connection.h"
#include "storage/postgres/postgres_error.h"
#include "storage/postgres/unfinished.h"

namespace dhpmap::postgres {

Status Connection::Execute(const std::string& sql, const char* task) {
  ++state_->num_round_trips;
  if (PQsendQuery(connection_.get(), sql.c_str()) != 1) {
    GiveUp();
    return ConnectionLost(task, Said());
  }
  return ReadResults(task, [](Answer&) { return Status::Ok(); });
}

Status Connection::Stream(const Call& call, const char* task, const std::function<Status(Answer& row)>& visit) {
  ++state_->num_round_trips;
  const auto types = call.values.Types();
  const auto pointers = call.values.Pointers();
  const auto lengths = call.values.Lengths();
  const std::vector<int> formats(types.size(), 1);
  // In its own pipeline: otherwise libpq would leave single-row mode to the next pipeline's first statement.
  if (PQenterPipelineMode(connection_.get()) != 1 ||
      PQsendQueryParams(connection_.get(), call.sql->c_str(), static_cast<int>(types.size()), types.data(),
                        pointers.data(), lengths.data(), formats.data(), 1) != 1 ||
      PQsetSingleRowMode(connection_.get()) != 1 || PQpipelineSync(connection_.get()) != 1) {
    GiveUp();
    return ConnectionLost(task, Said());
  }
  return ReadResults(task, visit);
}

Status Connection::ReadResults(const char* task, const std::function<Status(Answer& row)>& visit) {
  Unfinished unfinished(*this);
  Status status;
  for (bool is_lost = false;;) {
    Answer answer(NextResult(Clock::now() + patience_, is_lost));
    const pg_result* const result = answer.result();
    if (is_lost || (result == nullptr && IsBroken())) {
      return status.ok() ? ConnectionLost(task, Said()) : status;
    }
    const bool is_pipeline = PQpipelineStatus(connection_.get()) != PQ_PIPELINE_OFF;
    if (result == nullptr && is_pipeline) continue;
    if (result == nullptr) {
      unfinished.Dismiss();
      return status;
    }
    if (PQresultStatus(result) == PGRES_PIPELINE_SYNC) {
      (void)PQexitPipelineMode(connection_.get());
      unfinished.Dismiss();
      return status;
    }
    if (PQresultStatus(result) == PGRES_FATAL_ERROR) {
      status = ErrorFrom(SqlStateOf(result), task, PQresultErrorMessage(result));
    } else if (status.ok() && answer.Next()) {
      status = visit(answer);
      if (!status.ok()) return status;  // gives up rather than read the rest
    }
  }
}

}  // namespace dhpmap::postgres

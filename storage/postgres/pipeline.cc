// SPDX-License-Identifier: BSD-3-Clause
// A connection's pipelines: many statements, one round trip.
#include <libpq-fe.h>

#include <algorithm>
#include <utility>

#include "storage/postgres/connection.h"
#include "storage/postgres/postgres_error.h"
#include "storage/postgres/unfinished.h"

namespace dhpmap::postgres {
namespace {

/// Names of statements by text, the same on every connection.
std::string NameOf(const std::string& sql) { return "s" + std::to_string(std::hash<std::string>{}(sql)); }

}  // namespace

bool Connection::Send(const Call& call, std::vector<std::string>& names) {
  const std::string name = NameOf(*call.sql);
  const auto types = call.values.Types();
  const auto pointers = call.values.Pointers();
  const auto lengths = call.values.Lengths();
  const std::vector<int> formats(types.size(), 1);
  const auto count = static_cast<int>(types.size());
  const bool is_new = !state_->prepared.contains(name) && std::find(names.begin(), names.end(), name) == names.end();
  if (is_new) {
    if (PQsendPrepare(connection_.get(), name.c_str(), call.sql->c_str(), count, types.data()) != 1) return false;
    names.push_back(name);
  }
  return PQsendQueryPrepared(connection_.get(), name.c_str(), count, pointers.data(), lengths.data(), formats.data(),
                             1) == 1;
}

Answers Connection::Run(std::span<const Call> calls, const char* task) {
  Answers answers;
  answers.outcome = Outcome::kRefused;
  state_->has_warning = false;
  if (IsBroken()) {
    answers.status = ConnectionLost(task, "the connection was lost before");
    return answers;
  }
  ++state_->num_round_trips;
  Unfinished unfinished(*this);
  std::vector<std::string> names;
  bool is_sent = PQenterPipelineMode(connection_.get()) == 1;
  for (const Call& call : calls) is_sent = is_sent && Send(call, names);
  if (!is_sent || PQpipelineSync(connection_.get()) != 1) {
    answers.status = ConnectionLost(task, Said());
    answers.outcome = Outcome::kUnknown;
    return answers;
  }
  Collect(calls, names, task, answers);
  unfinished.Dismiss();
  return answers;
}

void Connection::Collect(std::span<const Call> calls, const std::vector<std::string>& names, const char* task,
                         Answers& answers) {
  const auto end = Clock::now() + patience_;
  std::size_t next_name = 0;
  answers.answers.reserve(calls.size());
  for (;;) {
    bool is_lost = false;
    pg_result* const result = NextResult(end, is_lost);
    if (is_lost || (result == nullptr && PQstatus(connection_.get()) != CONNECTION_OK)) {
      const bool is_refused = !answers.status.ok() && !MayHaveCommitted(answers.sqlstate);
      answers.outcome = is_refused ? Outcome::kRefused : Outcome::kUnknown;
      if (answers.status.ok()) answers.status = ConnectionLost(task, Said());
      return GiveUp();
    }
    if (result == nullptr) continue;
    Answer answer(result);
    const ExecStatusType status = PQresultStatus(result);
    if (status == PGRES_PIPELINE_SYNC) break;
    if (status == PGRES_FATAL_ERROR && answers.status.ok()) {
      answers.sqlstate = SqlStateOf(result);
      answers.status = ErrorFrom(answers.sqlstate, task, PQresultErrorMessage(result));
    }
    if (status != PGRES_COMMAND_OK && status != PGRES_TUPLES_OK) continue;
    const bool is_preparation = next_name < names.size() && status == PGRES_COMMAND_OK && answer.Tag().empty();
    if (is_preparation) state_->prepared.insert(names[next_name++]);
    else answers.answers.push_back(std::move(answer));
  }
  answers.has_warning = state_->has_warning;
  (void)PQexitPipelineMode(connection_.get());
  if (answers.status.ok()) {
    answers.outcome = answers.answers.size() == calls.size() ? Outcome::kDone : Outcome::kUnknown;
    if (answers.outcome != Outcome::kDone) answers.status = Internal("a pipeline gave too few answers");
    return;
  }
  answers.outcome = MayHaveCommitted(answers.sqlstate) ? Outcome::kUnknown : Outcome::kRefused;
  answers.answers.clear();
  EndTransaction();
}

/// After an error the transaction stays open and refuses every statement.
void Connection::EndTransaction() {
  if (PQtransactionStatus(connection_.get()) == PQTRANS_IDLE) return;
  if (!Execute("ROLLBACK", "end a transaction").ok()) GiveUp();
}

}  // namespace dhpmap::postgres

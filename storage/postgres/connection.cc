// SPDX-License-Identifier: BSD-3-Clause
#include "storage/postgres/connection.h"

#include <libpq-fe.h>
#include <poll.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cstring>
#include <utility>

#include "storage/postgres/postgres_error.h"

namespace dhpmap::postgres {
namespace {

constexpr char kConnectTask[] = "connect to the database";

std::string StateOf(const pg_result* result) {
  const char* state = PQresultErrorField(result, PG_DIAG_SQLSTATE);
  return state == nullptr ? "" : state;
}

bool IsPlainName(const std::string& name) {
  return !name.empty() &&
         std::all_of(name.begin(), name.end(), [](unsigned char c) { return std::isalnum(c) != 0 || c == '_'; });
}

/// Names by texts: the same statement has the same name on every connection.
std::string NameOf(const std::string& sql) { return "s" + std::to_string(std::hash<std::string>{}(sql)); }

}  // namespace

void Connection::Closer::operator()(pg_conn* connection) const { PQfinish(connection); }

Connection::Connection(pg_conn* connection, std::chrono::milliseconds patience)
    : connection_(connection), state_(std::make_unique<State>()), patience_(patience) {
  PQsetNoticeReceiver(connection, &Connection::OnNotice, state_.get());
}

void Connection::OnNotice(void* state, const pg_result* notice) {
  const char* severity = PQresultErrorField(notice, PG_DIAG_SEVERITY_NONLOCALIZED);
  if (severity != nullptr && std::strcmp(severity, "WARNING") == 0) static_cast<State*>(state)->has_warning = true;
}

Result<Connection> Connection::Open(const ConnectionOptions& options) {
  if (!IsPlainName(options.schema)) return InvalidArgument("a schema's name has letters, digits and _ alone");
  // Ours come first, so that what the URL says holds.
  const std::array<const char*, 11> keys = {"connect_timeout",
                                            "tcp_user_timeout",
                                            "keepalives",
                                            "keepalives_idle",
                                            "keepalives_interval",
                                            "keepalives_count",
                                            "application_name",
                                            "client_encoding",
                                            "dbname",
                                            nullptr,
                                            nullptr};
  const std::array<const char*, 11> values = {
      "2", "5000", "1", "2", "1", "3", "dhpmap-server", "UTF8", options.url.c_str(), nullptr, nullptr};
  constexpr int kExpandUrl = 1;
  pg_conn* opened = PQconnectdbParams(keys.data(), values.data(), kExpandUrl);
  if (opened == nullptr) return ResourceExhausted("cannot connect to the database: no memory");
  Connection connection(opened, options.patience);
  if (PQstatus(opened) != CONNECTION_OK) {
    return ConnectionLost(kConnectTask, "libpq refused or could not reach it");  // what it says names hosts and users
  }
  constexpr int kOldestVersion = 140000;
  if (PQserverVersion(opened) < kOldestVersion) {
    return FailedPrecondition("the database server is too old: PostgreSQL 14 or later is needed");
  }
  if (PQsetnonblocking(opened, 1) != 0) return ConnectionLost(kConnectTask, connection.Said());
  DHPMAP_RETURN_IF_ERROR(connection.Execute(
      "SET search_path TO " + options.schema + "; SET application_name TO '" + options.application +
          "'; SET idle_in_transaction_session_timeout TO 2000; SET client_min_messages TO warning; "
          "SELECT set_config('synchronous_commit', 'on', false) WHERE current_setting('synchronous_commit') IN ('off', "
          "'local')",
      kConnectTask));
  return connection;
}

Result<Connection> Connection::OpenForLong(const ConnectionOptions& options) {
  DHPMAP_ASSIGN_OR_RETURN(Connection connection, Open(options));
  DHPMAP_RETURN_IF_ERROR(connection.Execute("SET idle_in_transaction_session_timeout TO 0", kConnectTask));
  return connection;
}

bool Connection::IsBroken() const { return is_given_up_ || PQstatus(connection_.get()) != CONNECTION_OK; }

std::string Connection::Said() const { return PQerrorMessage(connection_.get()); }

/// What comes later would be taken for the answer to something else.
void Connection::GiveUp() { is_given_up_ = true; }

/// Waits until there is something to read, sending meanwhile; false: lost, or out of patience.
bool Connection::WaitForInput(Clock::time_point end) {
  pg_conn* const c = connection_.get();
  for (;;) {
    const int unsent = PQflush(c);
    if (unsent < 0) return false;
    const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(end - Clock::now()).count();
    if (left <= 0) return false;
    pollfd socket = {PQsocket(c), static_cast<short>(POLLIN | (unsent > 0 ? POLLOUT : 0)), 0};
    const int ready = poll(&socket, 1, static_cast<int>(std::min<std::int64_t>(left, 1000)));
    if (ready < 0 && errno != EINTR) return false;
    if (ready > 0 && (socket.revents & (POLLIN | POLLERR | POLLHUP)) != 0) return PQconsumeInput(c) == 1;
  }
}

/// Null with !is_lost: the end of a statement's results.
pg_result* Connection::NextResult(Clock::time_point end, bool& is_lost) {
  while (PQisBusy(connection_.get()) != 0) {
    if (WaitForInput(end)) continue;
    is_lost = true;
    return nullptr;
  }
  return PQgetResult(connection_.get());
}

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
  std::vector<std::string> names;
  bool is_sent = PQenterPipelineMode(connection_.get()) == 1;
  for (const Call& call : calls) is_sent = is_sent && Send(call, names);
  if (!is_sent || PQpipelineSync(connection_.get()) != 1) {
    answers.status = ConnectionLost(task, Said());
    answers.outcome = Outcome::kUnknown;
    GiveUp();
    return answers;
  }
  Collect(calls, names, task, answers);
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
      answers.sqlstate = StateOf(result);
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

/// After an error the transaction is open, and refuses everything.
void Connection::EndTransaction() {
  if (PQtransactionStatus(connection_.get()) == PQTRANS_IDLE) return;
  if (!Execute("ROLLBACK", "end a transaction").ok()) GiveUp();
}

Result<Answer> Connection::Query(const Call& call, const char* task) {
  Answers answers = Run({&call, 1}, task);
  if (!answers.status.ok()) return answers.status;
  return std::move(answers.answers.front());
}

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
  // In a pipeline of its own: outside of one, libpq would leave the mode to the next pipeline's first statement.
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
  Status status;
  for (bool is_lost = false;;) {
    Answer answer(NextResult(Clock::now() + patience_, is_lost));
    const pg_result* const result = answer.result();
    if (is_lost || (result == nullptr && IsBroken())) {
      GiveUp();
      return status.ok() ? ConnectionLost(task, Said()) : status;
    }
    const bool is_pipeline = PQpipelineStatus(connection_.get()) != PQ_PIPELINE_OFF;
    if (result == nullptr && is_pipeline) continue;
    if (result == nullptr) return status;
    if (PQresultStatus(result) == PGRES_PIPELINE_SYNC) {
      (void)PQexitPipelineMode(connection_.get());
      return status;
    }
    if (PQresultStatus(result) == PGRES_FATAL_ERROR) {
      status = ErrorFrom(StateOf(result), task, PQresultErrorMessage(result));
    } else if (status.ok() && answer.Next()) {
      status = visit(answer);
      if (!status.ok()) GiveUp();  // rather than read what is left
      if (!status.ok()) return status;
    }
  }
}

}  // namespace dhpmap::postgres

// SPDX-License-Identifier: BSD-3-Clause
#include "storage/postgres/connection.h"

#include <libpq-fe.h>
#include <poll.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cstring>

#include "storage/postgres/postgres_error.h"

namespace dhpmap::postgres {
namespace {

constexpr char kConnectTask[] = "connect to the database";

bool IsPlainName(const std::string& name) {
  return !name.empty() &&
         std::all_of(name.begin(), name.end(), [](unsigned char c) { return std::isalnum(c) != 0 || c == '_'; });
}

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
  // Our settings come first, so those of the URL win.
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
    return ConnectionLost(kConnectTask, "libpq refused or could not reach it");  // its message names hosts and users
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

/// A late answer would be taken for that of another statement.
void Connection::GiveUp() { is_given_up_ = true; }

/// Sends until there is something to read; false: the connection is lost, or the patience has passed.
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

/// Null without is_lost: the end of a statement's results.
pg_result* Connection::NextResult(Clock::time_point end, bool& is_lost) {
  while (PQisBusy(connection_.get()) != 0) {
    if (WaitForInput(end)) continue;
    is_lost = true;
    return nullptr;
  }
  return PQgetResult(connection_.get());
}

Result<Answer> Connection::Query(const Call& call, const char* task) {
  Answers answers = Run({&call, 1}, task);
  if (!answers.status.ok()) return answers.status;
  return std::move(answers.answers.front());
}

}  // namespace dhpmap::postgres

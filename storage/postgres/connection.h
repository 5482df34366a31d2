// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <unordered_set>
#include <vector>

#include "mapping/base/result.h"
#include "storage/postgres/answer.h"
#include "storage/postgres/values.h"

struct pg_conn;

namespace dhpmap::postgres {

/// How statements ended: refused (nothing is stored), done, or unknown because the answer was lost.
enum class Outcome { kDone, kRefused, kUnknown };

/// The results of a pipeline of statements.
struct Answers {
  Outcome outcome = Outcome::kDone;
  Status status;
  std::string sqlstate;         ///< of the server's error; empty without
  bool has_warning = false;     ///< with a COMMIT: it may not be on the standbys
  std::vector<Answer> answers;  ///< of each statement, if it is done
};

/// Where to connect, and how long to wait.
struct ConnectionOptions {
  std::string url;                             ///< postgresql://... ; never in messages
  std::string schema = "dhpmap";               ///< of the tables: letters, digits and _
  std::string application = "dhpmap-server";   ///< as the database server lists it: as the schema's name, or -
  std::chrono::milliseconds patience{30'000};  ///< waits this long for any answer, by the steady clock
};

/// A connection to a PostgreSQL server: statements are prepared when first used, sent in one go and answered in one
/// round trip. Thread-compatible. Errors: UNAVAILABLE if it is lost (IsBroken, for good), else as ErrorFrom. If a call
/// throws, the connection is lost.
class Connection {
 public:
  static Result<Connection> Open(const ConnectionOptions& options);
  /// Allows pauses within a read transaction. The server ends other connections that stay idle in one for 2 s.
  static Result<Connection> OpenForLong(const ConnectionOptions& options);

  /// Sends all statements at once and waits for all answers. After an error the later statements do not run, and the
  /// transaction is rolled back. `task` completes "cannot ...".
  Answers Run(std::span<const Call> calls, const char* task);
  /// Runs one statement that reads.
  Result<Answer> Query(const Call& call, const char* task);
  /// Runs one statement and visits each row as it arrives, with the memory of one row. An error from `visit` ends it.
  Status Stream(const Call& call, const char* task, const std::function<Status(Answer& row)>& visit);
  /// Runs one or more statements without parameters, for schemas and settings.
  Status Execute(const std::string& sql, const char* task);

  [[nodiscard]] bool IsBroken() const;
  /// Number of round trips so far, rollbacks included.
  [[nodiscard]] std::int64_t num_round_trips() const { return state_->num_round_trips; }

 private:
  struct Closer {
    void operator()(pg_conn* connection) const;
  };
  /// libpq's callbacks write to it, so its address is fixed.
  struct State {
    bool has_warning = false;
    std::int64_t num_round_trips = 0;
    std::unordered_set<std::string> prepared;
  };
  using Clock = std::chrono::steady_clock;
  Connection(pg_conn* connection, std::chrono::milliseconds patience);
  static void OnNotice(void* state, const pg_result* notice);

  bool Send(const Call& call, std::vector<std::string>& names);
  bool WaitForInput(Clock::time_point end);
  pg_result* NextResult(Clock::time_point end, bool& is_lost);
  /// Until the statement's results end. Calls `visit` for the first row of each; in single row mode that is every row.
  Status ReadResults(const char* task, const std::function<Status(Answer& row)>& visit);
  void Collect(std::span<const Call> calls, const std::vector<std::string>& names, const char* task, Answers& answers);
  void EndTransaction();
  void GiveUp();
  /// Gives the connection up unless it is dismissed, so that no exception leaves answers to be read by the next user.
  class Unfinished;
  [[nodiscard]] std::string Said() const;

  std::unique_ptr<pg_conn, Closer> connection_;
  std::unique_ptr<State> state_;
  std::chrono::milliseconds patience_;
  bool is_given_up_ = false;
};

}  // namespace dhpmap::postgres

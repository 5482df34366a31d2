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

/// How statements ended. A write was refused (nothing of it is stored), done, or nobody knows.
enum class Outcome { kDone, kRefused, kUnknown };

/// What a pipeline of statements gave.
struct Answers {
  Outcome outcome = Outcome::kDone;
  Status status;
  std::string sqlstate;         ///< of the server's error; empty without
  bool has_warning = false;     ///< the server warned: with a COMMIT it may not be on the standbys
  std::vector<Answer> answers;  ///< of each statement, if it is done
};

/// Where to connect, and how long to wait.
struct ConnectionOptions {
  std::string url;                             ///< postgresql://... ; never in messages
  std::string schema = "dhpmap";               ///< of the tables: letters, digits and _
  std::string application = "dhpmap-server";   ///< as the database server lists it: as the schema's name, or -
  std::chrono::milliseconds patience{30'000};  ///< for any answer; by the steady clock
};

/// A connection to a PostgreSQL server: statements are prepared when first used, sent in one go and answered in one
/// round trip. Thread-compatible. Errors: UNAVAILABLE if it is lost (IsBroken, for good), else as ErrorFrom.
class Connection {
 public:
  static Result<Connection> Open(const ConnectionOptions& options);
  /// For reading that may pause in a transaction: the server ends others when they are idle in one for 2 s.
  static Result<Connection> OpenForLong(const ConnectionOptions& options);

  /// Sends all statements at once and waits for all answers. After the first error none of the others has run, and the
  /// transaction is rolled back. `task` completes "cannot ...".
  Answers Run(std::span<const Call> calls, const char* task);
  /// One statement that reads.
  Result<Answer> Query(const Call& call, const char* task);
  /// One statement, whose rows are visited as they come: its memory is that of a row. `visit` may end it by an error.
  Status Stream(const Call& call, const char* task, const std::function<Status(Answer& row)>& visit);
  /// Texts without parameters, one or more. For schemas and settings.
  Status Execute(const std::string& sql, const char* task);

  [[nodiscard]] bool IsBroken() const;
  /// Pipelines that were sent and waited for, rollbacks included.
  [[nodiscard]] std::int64_t num_round_trips() const { return state_->num_round_trips; }

 private:
  struct Closer {
    void operator()(pg_conn* connection) const;
  };
  /// What libpq's callbacks write to, so at a fixed place.
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
  [[nodiscard]] std::string Said() const;

  std::unique_ptr<pg_conn, Closer> connection_;
  std::unique_ptr<State> state_;
  std::chrono::milliseconds patience_;
  bool is_given_up_ = false;
};

}  // namespace dhpmap::postgres

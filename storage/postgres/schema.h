// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "storage/postgres/connection.h"

namespace dhpmap::postgres {

/// A file of schema/: its number, and SQL.
struct SchemaStep {
  std::int64_t number = 0;
  std::string sql;
};

/// Those of this version, by number.
std::vector<SchemaStep> ReleasedSteps();

/// The oldest schema at which this version works, beside servers of the release before: that release's newest.
inline constexpr std::int64_t kOldestSchema = 4;

/// The schema as this process knows it. During an upgrade servers of two versions share a database, whose schema stays
/// that of the older one. Code that uses a table or column of a step later than kOldestSchema therefore asks Has first,
/// and does without if it is missing. Servers that run see a new step with their next beat, so a step only adds; what
/// no server uses any more may go one release later. Thread-safe.
class Schema {
 public:
  explicit Schema(std::vector<SchemaStep> steps) : steps_(std::move(steps)) {}

  /// Whether the database has this step. Rises while the process runs, never falls.
  [[nodiscard]] bool Has(std::int64_t step) const { return in_force() >= step; }
  [[nodiscard]] std::int64_t in_force() const { return in_force_; }
  void Raise(std::int64_t step);

  /// The newest step that this version knows.
  [[nodiscard]] std::int64_t newest() const { return steps_.back().number; }
  [[nodiscard]] const std::vector<SchemaStep>& steps() const { return steps_; }

 private:
  const std::vector<SchemaStep> steps_;
  std::atomic<std::int64_t> in_force_ = 0;
};

/// FAILED_PRECONDITION, reason NEWER_SCHEMA.
Status NewerSchema(std::int64_t in_force, std::int64_t newest);

/// Makes the list of steps if it is missing, and returns the newest step that the database has; 0: none.
Result<std::int64_t> ReadSchema(Connection& connection, const std::string& schema);

/// Makes all steps after `from`, and then runs `check` (SQL, may be empty), in one transaction. Of processes that do so
/// at once one makes the steps, and the others wait and find them made: OK for each.
Status MakeSteps(Connection& connection, const Schema& schema, std::int64_t from, const std::string& check);

}  // namespace dhpmap::postgres

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "mapping/base/result.h"

namespace dhpmap {

/// A key. The store reads nothing but the id.
struct KeyRow {
  std::string id;
  std::string record;  ///< one line of text
};
struct KeyRows {
  std::int64_t version = 0;  ///< differs after each change
  std::vector<KeyRow> rows;  ///< by id
};

/// A line of the audit log. Texts are valid UTF-8 without NUL.
struct AuditRow {
  std::int64_t time_s = 0;     ///< since 1970, UTC
  std::int64_t server = 0;     ///< FleetServer::id
  std::int64_t number = 0;     ///< ascending on that server
  std::string principal = {};  ///< empty: unknown caller
  std::string key_id = {};
  std::string rpc = {};
  std::string map = {};
  std::string decision = {};      ///< "allowed", or why not
  std::int64_t num_left_out = 0;  ///< rows before this one that are missing
};
struct AuditQuery {
  std::int64_t since_s = 0;
  std::string principal = {}, map = {};  ///< empty: any
  std::int64_t max = 100;
};

/// What all servers on one database need to know of callers: keys, the audit log, and who made which map. Thread-safe.
/// Every call asks the database: UNAVAILABLE if it does not answer within some seconds.
class AuthTables {
 public:
  static constexpr std::int64_t kMostKeys = 10'000;

  virtual ~AuthTables() = default;

  virtual Result<std::int64_t> KeysVersion() = 0;
  /// At least as new as the version. RESOURCE_EXHAUSTED beyond kMostKeys.
  virtual Result<KeyRows> ReadKeys() = 0;
  /// Adds these keys and replaces those with their ids, if the version is still `seen_version`: else ABORTED. After
  /// UNAVAILABLE it is not known whether the keys are stored.
  virtual Status WriteKeys(std::int64_t seen_version, std::span<const KeyRow> changed) = 0;

  /// All or none; rows that are there already are left alone, so a repetition does no harm. Deletes old rows now and
  /// then, see AuthTablesOptions.
  virtual Status AppendAudit(std::span<const AuditRow> rows) = 0;
  /// The newest first.
  virtual Result<std::vector<AuditRow>> ListAudit(const AuditQuery& query) = 0;

  /// Who has made a map, by MapInfo::history_id. Rows of maps that are gone are deleted now and then.
  virtual Status AddMapMaker(std::uint64_t history_id, const std::string& principal) = 0;
  virtual Result<std::optional<std::string>> MakerOf(std::uint64_t history_id) = 0;
  /// Those that are there.
  virtual Result<std::vector<std::uint64_t>> MapsMadeBy(const std::string& principal) = 0;
};

struct AuthTablesOptions {
  std::string schema = "dhpmap";  ///< see PostgresStoreOptions
  std::int64_t most_audit_rows = 1'000'000;
  std::int64_t most_audit_age_s = std::int64_t{90} * 86'400;
  double answer_s = 5;  ///< for an answer of the database
};

/// Opens the tables in a PostgreSQL database; makes all tables of the store in a database that has none. UNAVAILABLE if
/// the database does not answer; FAILED_PRECONDITION, reason OLDER_SCHEMA, if only an earlier version has used it, or
/// without rights.
Result<std::unique_ptr<AuthTables>> OpenAuthTables(const std::string& url, const AuthTablesOptions& options = {});

}  // namespace dhpmap

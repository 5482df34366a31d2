// SPDX-License-Identifier: BSD-3-Clause
#include "storage/auth_tables.h"

#include <atomic>
#include <chrono>
#include <utility>

#include "storage/postgres/auth/audit_rows.h"
#include "storage/postgres/auth/key_rows.h"
#include "storage/postgres/auth/maker_rows.h"
#include "storage/postgres/fleet/upgrade.h"
#include "storage/postgres/pool.h"
#include "storage/postgres/schema.h"

namespace dhpmap {
namespace {

using postgres::Answer;
using postgres::Connection;

constexpr int kMostAuthConnections = 3;          // keys, the audit log, and makers of maps
constexpr std::int64_t kAppendsADeletion = 256;  // the first deletes, too
constexpr std::int64_t kMakersAForgetting = 100;
constexpr char kOpenAuthTask[] = "look for the tables of keys";
const std::string kWhichAuthTables =
    "SELECT to_regclass('audit_rows') IS NOT NULL, to_regclass('schema_steps') IS NOT NULL";

class PostgresAuthTables final : public AuthTables {
 public:
  PostgresAuthTables(const postgres::ConnectionOptions& connection, const AuthTablesOptions& options)
      : options_(options), pool_(connection, kMostAuthConnections) {}

  Result<std::int64_t> KeysVersion() override { return pool_.Read<std::int64_t>(postgres::ReadKeysVersion); }
  Result<KeyRows> ReadKeys() override { return pool_.Read<KeyRows>(postgres::ReadKeyRows); }
  Status WriteKeys(std::int64_t seen_version, std::span<const KeyRow> changed) override {
    DHPMAP_ASSIGN_OR_RETURN(postgres::Pool::Lease connection, pool_.Borrow());
    return postgres::WriteKeyRows(*connection, seen_version, changed);
  }

  Status AppendAudit(std::span<const AuditRow> rows) override {
    if (rows.empty()) return Status::Ok();
    return Write([&](Connection& connection) {
      DHPMAP_RETURN_IF_ERROR(postgres::AppendAuditRows(connection, rows));
      if (num_appends_++ % kAppendsADeletion != 0) return Status::Ok();
      const std::int64_t oldest_s = rows.back().time_s - options_.most_audit_age_s;
      return postgres::DeleteOldAuditRows(connection, oldest_s, options_.most_audit_rows);
    });
  }
  Result<std::vector<AuditRow>> ListAudit(const AuditQuery& query) override {
    return pool_.Read<std::vector<AuditRow>>([&](Connection& c) { return postgres::ReadAuditRows(c, query); });
  }

  Status AddMapMaker(std::uint64_t history_id, const std::string& principal) override {
    return Write([&](Connection& connection) {
      DHPMAP_RETURN_IF_ERROR(postgres::WriteMapMaker(connection, history_id, principal));
      return ++num_makers_ % kMakersAForgetting == 0 ? postgres::ForgetMakersOfGoneMaps(connection) : Status::Ok();
    });
  }
  Result<std::optional<std::string>> MakerOf(std::uint64_t history_id) override {
    return pool_.Read<std::optional<std::string>>([&](Connection& c) { return postgres::ReadMakerOf(c, history_id); });
  }
  Result<std::vector<std::uint64_t>> MapsMadeBy(const std::string& principal) override {
    return pool_.Read<std::vector<std::uint64_t>>(
        [&](Connection& c) { return postgres::ReadMapsMadeBy(c, principal); });
  }

 private:
  /// For writes that may be repeated: done again once if the connection was lost.
  template <typename Writer>
  Status Write(Writer&& write) {
    return pool_
        .Read<bool>([&](Connection& connection) -> Result<bool> {
          DHPMAP_RETURN_IF_ERROR(write(connection));
          return true;
        })
        .status();
  }

  const AuthTablesOptions options_;
  postgres::Pool pool_;
  std::atomic<std::int64_t> num_appends_ = 0, num_makers_ = 0;
};

/// Makes the tables of an empty database. An existing store is upgraded by its servers alone: older ones may use it.
Status PrepareAuthTables(Connection& connection, const std::string& schema) {
  DHPMAP_ASSIGN_OR_RETURN(Answer tables, connection.Query({&kWhichAuthTables}, kOpenAuthTask));
  if (!tables.Next()) return Internal("the database does not say which tables it has");
  const bool has_ours = tables.Int() != 0, has_any = tables.Int() != 0;
  if (has_ours) return Status::Ok();
  if (has_any) {
    return FailedPrecondition(
               "the database has no tables of keys yet: a server of this version makes them when it starts alone, or "
               "`dhpmap fleet upgrade finish` does")
        .WithReason("OLDER_SCHEMA");
  }
  postgres::Schema made(postgres::ReleasedSteps());
  DHPMAP_RETURN_IF_ERROR(postgres::ReadSchema(connection, schema).status());  // makes the schema
  return postgres::Upgrade(connection, made, {});
}

}  // namespace

Result<std::unique_ptr<AuthTables>> OpenAuthTables(const std::string& url, const AuthTablesOptions& options) {
  const postgres::ConnectionOptions connecting{
      .url = url,
      .schema = options.schema,
      .application = "dhpmap-server-auth",
      .patience = std::chrono::milliseconds(static_cast<std::int64_t>(options.answer_s * 1000))};
  {
    DHPMAP_ASSIGN_OR_RETURN(Connection connection, Connection::Open(connecting));
    DHPMAP_RETURN_IF_ERROR(PrepareAuthTables(connection, options.schema));
  }
  return std::unique_ptr<AuthTables>(std::make_unique<PostgresAuthTables>(connecting, options));
}

}  // namespace dhpmap

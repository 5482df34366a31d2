// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>

#include <regex>
#include <string>

#include "storage/postgres/connection.h"
#include "storage/sqlite/database.h"
#include "tests/unit/storage/kept_store.h"

namespace dhpmap::testing {

// The tables of a store behind its back.

inline Result<postgres::Connection> ConnectTo(const std::string& schema) {
  return postgres::Connection::Open({.url = PostgresCluster::Get()->Url(), .schema = schema});
}

inline Status TamperWithFile(const std::string& path, const std::string& sql) {
  DHPMAP_ASSIGN_OR_RETURN(auto database, sqlite::Database::Open(path, sqlite::OpenMode::kReadWriteOrCreate, 1000));
  return database.Execute(sql, "tamper");
}

inline Status TamperWithSchema(const std::string& schema, const std::string& sql) {
  DHPMAP_ASSIGN_OR_RETURN(auto connection, ConnectTo(schema));
  return connection.Execute(sql, "tamper");
}

inline Result<std::int64_t> QueryFile(const std::string& path, const std::string& sql) {
  DHPMAP_ASSIGN_OR_RETURN(auto database, sqlite::Database::Open(path, sqlite::OpenMode::kReadOnly, 1000));
  return database.QueryInt(sql, "look");
}

inline Result<std::int64_t> QuerySchema(const std::string& schema, const std::string& sql) {
  DHPMAP_ASSIGN_OR_RETURN(auto connection, ConnectTo(schema));
  DHPMAP_ASSIGN_OR_RETURN(auto answer, connection.Query({&sql}, "look"));
  return answer.Next() ? answer.Int() : std::int64_t{-1};
}

/// SQL of SQLite as PostgreSQL has it: bytes, x'00'.
inline std::string ForPostgres(const std::string& sql) {
  static const std::regex bytes("\\bx'([0-9A-Fa-f]*)'");
  return std::regex_replace(sql, bytes, "'\\x$1'::bytea");
}

/// Runs SQL of our own, as no store would.
inline void TamperWith(const KeptStore& kept, const std::string& sql) {
  const Status done =
      kept.IsPostgres() ? TamperWithSchema(kept.schema(), ForPostgres(sql)) : TamperWithFile(kept.Path(), sql);
  ASSERT_TRUE(done.ok()) << done.ToString() << " " << sql;
}

/// The first column of the first row; -1 if it cannot be had.
inline std::int64_t QueryOf(const KeptStore& kept, const std::string& sql) {
  const auto found = kept.IsPostgres() ? QuerySchema(kept.schema(), "SELECT (" + ForPostgres(sql) + ")::bigint")
                                       : QueryFile(kept.Path(), sql);
  EXPECT_TRUE(found.ok()) << found.status().ToString() << " " << sql;
  return found.ok() ? *found : -1;
}

}  // namespace dhpmap::testing

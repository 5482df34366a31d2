// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <sys/types.h>

#include <string>
#include <utility>

#include "tests/support/scenes.h"

namespace dhpmap::testing {

/// A PostgreSQL server for the tests of this process: on a Unix socket in a folder of its own, without fsync, with the
/// process gone when it ends. Thread-compatible.
class PostgresCluster {
 public:
  /// Started when it is first asked for; null where PostgreSQL is not installed. Throws if it is, and does not start:
  /// then the tests fail.
  static PostgresCluster* Get();
  static const char* WhyThereIsNone() {
    return "there is no PostgreSQL server to start: deploy/setup.sh --postgres installs one";
  }

  ~PostgresCluster();
  PostgresCluster(const PostgresCluster&) = delete;
  PostgresCluster& operator=(const PostgresCluster&) = delete;

  /// For libpq.
  [[nodiscard]] std::string Url() const;
  /// The folder of its socket.
  [[nodiscard]] std::string Folder() const { return folder_.path().string(); }
  /// A schema that nobody has used.
  [[nodiscard]] std::string NewSchema() { return "test_" + std::to_string(++num_schemas_); }
  /// For libpq: a database that nobody has used.
  [[nodiscard]] std::string NewDatabase();
  /// Ends every connection, as a restart would; what is committed stays.
  void CutConnections() const;

 private:
  explicit PostgresCluster(std::string bin) : bin_(std::move(bin)) {}
  [[nodiscard]] std::string UrlOf(const std::string& database) const;
  [[nodiscard]] bool RunSql(const std::string& sql) const;
  bool Start();

  TempDir folder_;
  const std::string bin_;
  std::string said_;  ///< what it logged until it was ready
  pid_t server_ = -1;
  int num_schemas_ = 0, num_databases_ = 0;
};

}  // namespace dhpmap::testing

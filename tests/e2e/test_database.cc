// SPDX-License-Identifier: BSD-3-Clause
#include "tests/e2e/test_database.h"

#include <cstdlib>
#include <map>
#include <stdexcept>

#include "tests/support/postgres_cluster.h"

namespace dhpmap::testing {

bool IsOnPostgres() {
  const char* const kind = std::getenv("TEST_STORE");
  return kind != nullptr && std::string(kind) == "postgres";
}

std::string DatabaseFor(const std::filesystem::path& db) {
  if (!IsOnPostgres() || db.string().starts_with("postgresql:")) return db.string();
  PostgresCluster* const cluster = PostgresCluster::Get();
  if (cluster == nullptr) throw std::runtime_error(PostgresCluster::WhyThereIsNone());
  static std::map<std::filesystem::path, std::string> databases;
  std::string& url = databases[db];
  if (url.empty()) url = cluster->NewDatabase();
  return url;
}

}  // namespace dhpmap::testing

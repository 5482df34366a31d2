// SPDX-License-Identifier: BSD-3-Clause
#include "tests/integration/test_store.h"

#include <cstdlib>
#include <stdexcept>
#include <string>

#include "storage/postgres_store.h"
#include "tests/support/postgres_cluster.h"

namespace dhpmap::testing {

std::unique_ptr<MapStore> MakeTestStore(const ChangeHistoryLimits& changes, const EditLogLimits& edits) {
  const char* const kind = std::getenv("TEST_STORE");
  if (kind == nullptr || std::string(kind) != "postgres") return MakeMemoryStore(changes, edits);
  PostgresCluster* const cluster = PostgresCluster::Get();
  if (cluster == nullptr) throw std::runtime_error(PostgresCluster::WhyThereIsNone());
  auto store = OpenPostgresStore(cluster->Url(), {.schema = cluster->NewSchema(), .changes = changes, .edits = edits});
  if (!store.ok()) throw std::runtime_error(store.status().ToString());
  return std::move(store).value();
}

}  // namespace dhpmap::testing

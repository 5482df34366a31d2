// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>

namespace dhpmap::testing {

/// Whether the servers of these tests keep their maps on PostgreSQL: the environment has TEST_STORE=postgres.
bool IsOnPostgres();

/// What a test's server takes as --db: the file `db`; or on PostgreSQL a database of this process's cluster, the same
/// one for the same file. URLs stay what they are. Throws where PostgreSQL is asked for and not installed.
std::string DatabaseFor(const std::filesystem::path& db);

}  // namespace dhpmap::testing

/// Skips a case that is about the file itself. `reason` completes "on PostgreSQL ...".
#define SKIP_ON_POSTGRES(reason) \
  if (::dhpmap::testing::IsOnPostgres()) GTEST_SKIP() << "on PostgreSQL " << (reason)

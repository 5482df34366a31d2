// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>

#include <string>

#include "tests/unit/storage/kept_tables.h"
#include "tests/unit/storage/store_samples.h"

namespace dhpmap::testing {

/// A store of the kind that is the test's parameter, and access to its tables behind its back: SQL that both databases
/// know. A SetUp of a test begins with DHPMAP_SKIP_UNLESS_THERE.
class AnyStoreTest : public ::testing::TestWithParam<StoreKind>, protected StoreSamples {
 protected:
  void SetUp() override {
    DHPMAP_SKIP_UNLESS_THERE(kept_);
    Open();
  }
  /// Opens it once more.
  void Open(const KeptStoreOptions& options = {}) { kept_.Open(store_, options); }
  void BeginAnew() {
    store_ = nullptr;
    kept_.BeginAnew();
    Open();
  }
  void Tamper(const std::string& sql) { TamperWith(kept_, sql); }
  std::int64_t Query(const std::string& sql) { return QueryOf(kept_, sql); }

  KeptStore kept_{GetParam()};
};

/// The cases of a suite, on SQLite and PostgreSQL.
#define DHPMAP_ON_STORES_THAT_KEEP(Suite)                                                           \
  INSTANTIATE_TEST_SUITE_P(Stores, Suite, ::testing::ValuesIn(::dhpmap::testing::StoresThatKeep()), \
                           ::dhpmap::testing::NameOfKind)

}  // namespace dhpmap::testing

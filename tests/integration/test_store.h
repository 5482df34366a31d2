// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>

#include "storage/store.h"

namespace dhpmap::testing {

/// A store for one test that opens it only once: in memory, or, if the environment has TEST_STORE=postgres, a new
/// schema of this process's PostgreSQL. Throws if PostgreSQL is requested but not installed.
std::unique_ptr<MapStore> MakeTestStore(const ChangeHistoryLimits& changes = {}, const EditLogLimits& edits = {});

}  // namespace dhpmap::testing

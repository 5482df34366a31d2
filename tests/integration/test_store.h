// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>

#include "storage/store.h"

namespace dhpmap::testing {

/// A store for one test, which nobody opens a second time: in memory; or, where the environment has
/// TEST_STORE=postgres, a schema of its own of this process's PostgreSQL. Throws where that is not installed: whoever
/// asks for it wants to know.
std::unique_ptr<MapStore> MakeTestStore(const ChangeHistoryLimits& changes = {}, const EditLogLimits& edits = {});

}  // namespace dhpmap::testing

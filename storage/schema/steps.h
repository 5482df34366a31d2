// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>

#include "storage/schema/schema_step.h"

namespace dhpmap {

/// Entry i brings a database from schema i to i + 1.
SchemaSteps ReleasedSteps();
inline std::int64_t VersionOf(SchemaSteps steps) { return static_cast<std::int64_t>(steps.size()); }
/// Schema of this version.
inline std::int64_t SchemaVersion() { return VersionOf(ReleasedSteps()); }

/// The .sql files of this folder, by number from 1.
std::span<const char* const> SchemaSql();

}  // namespace dhpmap

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <span>
#include <string>

#include "storage/postgres/connection.h"

namespace dhpmap::postgres {

/// Makes the tables, or brings them up to date, each step in a transaction. FAILED_PRECONDITION, reason NEWER_SCHEMA,
/// if a later version wrote them.
Status PrepareSchema(Connection& connection, const std::string& schema,
                     const std::function<void(const std::string& message)>& on_progress);

/// The .sql files of schema/, by number from 1.
std::span<const char* const> SchemaTexts();

}  // namespace dhpmap::postgres

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>

#include "mapping/base/status.h"

struct pg_result;

namespace dhpmap::postgres {

/// The status for an error that the server reported. `task` completes "cannot ...". Messages contain no SQL and no
/// names of tables, hosts or users. The server's own words are the cause, for logs.
Status ErrorFrom(std::string_view sqlstate, std::string_view task, std::string said);
/// The SQLSTATE of a result that is an error; empty if it has none.
std::string SqlStateOf(const pg_result* result);
/// The status for a connection that was lost or could not be opened.
Status ConnectionLost(std::string_view task, std::string said);

/// Whether the server ended the connection, so that the outcome of a commit is unknown.
bool MayHaveCommitted(std::string_view sqlstate);
/// Whether the same statements may succeed when sent again.
bool IsWorthRepeating(std::string_view sqlstate);

}  // namespace dhpmap::postgres

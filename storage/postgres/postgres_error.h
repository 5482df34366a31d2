// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>

#include "mapping/base/status.h"

struct pg_result;

namespace dhpmap::postgres {

/// The status of an error that the server reported. `task` completes "cannot ...". Messages never hold SQL, names of
/// tables, hosts or users: what the server said is the cause, for logs.
Status ErrorFrom(std::string_view sqlstate, std::string_view task, std::string said);
/// The SQLSTATE of a result that is an error; empty if it has none.
std::string SqlStateOf(const pg_result* result);
/// Of a connection that is gone, or never was.
Status ConnectionLost(std::string_view task, std::string said);

/// Whether the error says nothing about a statement that may have committed: the server ended the connection.
bool MayHaveCommitted(std::string_view sqlstate);
/// Whether the same statements may succeed if they are sent again.
bool IsWorthRepeating(std::string_view sqlstate);

}  // namespace dhpmap::postgres

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <span>
#include <string>

#include "storage/postgres/fleet/peers.h"
#include "storage/postgres/schema.h"

namespace dhpmap::postgres {

// Servers of two versions on one database. Each server writes the newest schema that its version knows into its row.
// The database is upgraded when a server starts on it alone, or by Fleet::FinishUpgrade when all living servers know
// the newer schema. From then on the database refuses the beats of older servers.

struct SchemaOpening {
  std::string schema;                                           ///< see ConnectionOptions
  std::function<void()> pause;                                  ///< waits long enough for every living server to beat
  std::function<void(const std::string& message)> on_progress;  ///< may be empty
};
/// At the start of a server: makes the tables of an empty database, and upgrades an older one unless another server
/// beats. FAILED_PRECONDITION: reason NEWER_SCHEMA; or the schema is older than kOldestSchema and another server beats.
Status OpenSchema(Connection& connection, Schema& schema, const SchemaOpening& opening);

/// Makes the steps after the one in force. `dead`: the last seen rows of dead servers. UNAVAILABLE if any other server
/// does not know the newest step: it has started meanwhile.
Status Upgrade(Connection& connection, Schema& schema, std::span<const ServerRow> dead);

/// For messages: its address, version and schema.
std::string DescribeServer(const ServerRow& server);

}  // namespace dhpmap::postgres

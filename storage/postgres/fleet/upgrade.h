// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <span>
#include <string>

#include "storage/postgres/fleet/peers.h"
#include "storage/postgres/schema.h"

namespace dhpmap::postgres {

// How servers of two versions share a database. Each writes the newest schema that its version knows into its row. The
// database goes to a newer one when a server starts on it alone, or when somebody asks for it (Fleet::FinishUpgrade)
// and all that live know it. From then on the database itself refuses the beats of an older server.

struct SchemaOpening {
  std::string schema;           ///< see ConnectionOptions
  std::function<void()> pause;  ///< waits for as long as it takes every living server to beat
  std::function<void(const std::string& message)> on_progress;  ///< may be empty
};
/// At the start of a server: makes the tables in an empty database; brings an older one to this version's schema if no
/// other server beats, and else leaves it. FAILED_PRECONDITION: reason NEWER_SCHEMA; or it is older than kOldestSchema
/// and another server beats.
Status OpenSchema(Connection& connection, Schema& schema, const SchemaOpening& opening);

/// Makes the steps after the one in force. `dead`: servers as they were last seen; any other that does not know the
/// newest step refuses the upgrade (UNAVAILABLE: it has started meanwhile).
Status Upgrade(Connection& connection, Schema& schema, std::span<const ServerRow> dead);

/// For messages: its address, version and schema.
std::string DescribeServer(const ServerRow& server);

}  // namespace dhpmap::postgres

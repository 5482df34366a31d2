// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "tests/rig/bulk_calls.h"

namespace dhpmap::rig {

// Each starts a server of its own in a temporary folder, prints what it saw, and returns whether all of it is within
// what the server promises.

struct LoadOptions {
  std::string dataset;  ///< the apartment of dhpmap-simulate
  double seconds = 300;
  int num_bulk_clients = 8;
};
/// Quick calls and mapping at full rate, while other clients ask for what takes long.
bool RunLoad(const LoadOptions& options);

struct HostileOptions {
  std::string dataset;
};
/// The memory that clients can make the server take who do not read, do not finish, or hang up.
bool RunHostile(const HostileOptions& options);

struct ManyMapsOptions {
  int num_maps = 1000;
  double idle_close_s = 5;
};
/// Threads and memory, with many maps made, listed and read once.
bool RunManyMaps(const ManyMapsOptions& options);

struct ApartmentsOptions {
  std::string dataset;
  int repetitions = 40;
};
/// Memory after maps have been made, queried, cloned, meshed and deleted in turn.
bool RunApartments(const ApartmentsOptions& options);

struct SoakOptions {
  std::string dataset;  ///< the apartment of dhpmap-simulate
  double seconds = 1800;
  int num_clients = 8;
  double rate_hz = 2;         ///< calls a second of each client, at most
  double frame_rate_hz = 10;  ///< a camera's; 0: as many as the server takes
};
/// Mapping, edits and every kind of query at once, for long: no error, nothing that grows.
bool RunSoak(const SoakOptions& options);

// Clients in processes of their own, started by the above.

/// Bulk calls from `num_clients` connections until killed.
void RunBulkClients(const Target& target, int num_clients);

enum class Stall { kMeshes, kPoints, kQueryStreams, kWatches };
/// Begins `num_calls` calls whose answers it does not read, and stands still until it is killed.
void RunStalledClient(const Target& target, Stall stall, int num_calls);

}  // namespace dhpmap::rig

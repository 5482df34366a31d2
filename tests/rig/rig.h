// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "tests/rig/load/bulk_calls.h"

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
  std::string only;  ///< the cases whose names contain this; empty: all
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
/// Memory while and after maps are made, queried, cloned, meshed and deleted in turn, and how much of it the server's
/// own count explains.
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

struct DoorsOptions {
  std::string dataset;  ///< the apartment of dhpmap-simulate
  double seconds = 30;  ///< at rest, and as long while mapping
  int num_clients = 1;
  double rate_hz = 50;       ///< calls a second of each client, at most; 0: as fast as they are answered
  double frame_rate_hz = 0;  ///< 0: as many as the server takes
};
/// How long queries of a hundred points take through each door, at rest and while a map is fused.
bool RunDoors(const DoorsOptions& options);

struct WatchersOptions {
  std::string dataset;
  int num_watchers = 100;
  int num_pairs = 3;  ///< of a run without watchers and one with
};
/// How much slower frames are fused while others watch the map, and what the watchers take.
bool RunWatchers(const WatchersOptions& options);

struct TwoFeedersOptions {
  std::string dataset;  ///< the house of dhpmap-simulate
};
/// Whether two sessions that feed a map at once, half of the frames each, make the map that one makes: every other
/// frame each, and the first and the second half.
bool RunTwoFeeders(const TwoFeedersOptions& options);

// Clients in processes of their own, started by the above.

/// Bulk calls from `num_clients` connections until killed.
void RunBulkClients(const Target& target, int num_clients);

/// Reads so many watches of the map until SIGTERM. Whether none ended before, and each was told a change; prints how
/// many.
bool RunReadWatches(const Target& target, int num_watches);

enum class Stall { kMeshes, kPoints, kQueryStreams, kWatches };
/// Begins `num_calls` calls whose answers it does not read, and stands still until it is killed.
void RunStalledClient(const Target& target, Stall stall, int num_calls);

}  // namespace dhpmap::rig

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "dhpmap/v1/query_options.pb.h"

namespace CLI {
class App;
}

namespace dhpmap {

struct Session;

/// Which state of a map is read.
struct ReadFlags {
  std::int64_t revision = 0;  ///< 0: the present state
  bool is_eventual = false;   ///< of the server that is asked
};
template <typename Request>
void SetRead(const ReadFlags& flags, Request& request) {
  request.set_read_revision(flags.revision);
  if (flags.is_eventual) request.set_consistency(v1::Consistency::EVENTUAL);
}

/// In which frame a query is asked, and of a map how new.
struct AskerFlags {
  std::vector<double> frame;  ///< X Y Z YAW_DEG; empty: the map frame
  std::int64_t min_revision = 0;
  ReadFlags read;
};
/// The world of a query, as far as the command line defines it.
struct WorldFlags {
  AskerFlags asker;
  std::vector<std::int64_t> excluded_submaps;
  std::vector<std::string> excluded_class_names, class_names;
  std::optional<double> max_free_age_s;
  bool vacated_is_free = false;
  bool include_absent = false;
};
/// The same for queries with a search distance.
struct QueryFlags {
  WorldFlags world;
  double max_distance_m = 3;
};

/// --read-revision and --eventual, which everything has that reads a map.
void AddReadFlags(CLI::App& command, ReadFlags& flags);
void AddAskerFlags(CLI::App& command, AskerFlags& flags);
void AddWorldFlags(CLI::App& command, WorldFlags& flags);
void AddPaddingFlag(CLI::App& command, double& padding_m);
void AddQueryFlags(CLI::App& command, QueryFlags& flags);
/// Adds --unknown: occupied, report or free.
void AddUnknownFlag(CLI::App& command, v1::QueryOptions::UnknownPolicy& policy);
/// Sets the vector from three numbers.
void SetVector(const double* xyz, v1::Vector3& vector);
v1::QueryOptions ToProto(const AskerFlags& flags);
v1::QueryOptions ToProto(const WorldFlags& flags, const std::string& map);
v1::QueryOptions ToProto(const QueryFlags& flags, const std::string& map);

/// Adds `collisions` and `trajectory` to `dhpmap query`.
void AddCheckCommands(CLI::App& query, Session& session);

}  // namespace dhpmap

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "dhpmap/v1/query_options.pb.h"

namespace CLI {
class App;
}

namespace dhpmap {

struct Session;

/// What a query takes as the world, as far as the command line says so.
struct QueryFlags {
  double max_distance_m = 3;
  std::vector<std::int64_t> excluded_submaps;
  std::vector<std::string> excluded_class_names, class_names;
};

void AddQueryFlags(CLI::App& command, QueryFlags& flags);
v1::QueryOptions ToProto(const QueryFlags& flags, const std::string& map);

/// Adds `collisions` and `trajectory` to `dhpmap query`.
void AddCheckCommands(CLI::App& query, Session& session);

}  // namespace dhpmap

// SPDX-License-Identifier: BSD-3-Clause
#include "clients/cli/query_flags.h"

#include <CLI/CLI.hpp>

#include "clients/cli/connection.h"

namespace dhpmap {

void AddWorldFlags(CLI::App& command, WorldFlags& flags) {
  command.add_option("--exclude-submap", flags.excluded_submaps, "Ids of objects to leave out");
  command.add_option("--exclude-class", flags.excluded_class_names, "Names of classes to leave out");
  command.add_option("--class", flags.class_names, "Names of the only classes to look at");
  command.add_option("--max-age-s", flags.max_age_s,
                     "Space that was looked through so long before the newest look is no longer known to be free");
  command.add_flag("--vacated-free", flags.vacated_is_free, "What moved and deleted objects have left is free");
}

void AddQueryFlags(CLI::App& command, QueryFlags& flags) {
  command.add_option("--max-distance", flags.max_distance_m, "How far to look, in m")->capture_default_str();
  AddWorldFlags(command, flags.world);
}

v1::QueryOptions ToProto(const WorldFlags& flags, const std::string& map) {
  v1::QueryOptions options;
  for (const std::int64_t id : flags.excluded_submaps) options.add_excluded_submaps(SubmapName(map, id));
  options.mutable_excluded_class_names()->Assign(flags.excluded_class_names.begin(), flags.excluded_class_names.end());
  options.mutable_class_names()->Assign(flags.class_names.begin(), flags.class_names.end());
  if (flags.max_age_s) options.set_max_age_s(*flags.max_age_s);
  if (flags.vacated_is_free) options.set_vacated(v1::Vacated::FREE);
  return options;
}

v1::QueryOptions ToProto(const QueryFlags& flags, const std::string& map) {
  v1::QueryOptions options = ToProto(flags.world, map);
  options.set_max_distance_m(flags.max_distance_m);
  return options;
}

}  // namespace dhpmap

// SPDX-License-Identifier: BSD-3-Clause
#include "clients/cli/query_flags.h"

#include <CLI/CLI.hpp>
#include <cmath>
#include <map>

#include "clients/cli/connection.h"

namespace dhpmap {

void AddReadFlags(CLI::App& command, ReadFlags& flags) {
  command.add_option("--read-revision", flags.revision, "Read this recent revision");
  command.add_flag("--eventual", flags.is_eventual,
                   "Read the state that the server has, even if another one writes the map");
}

void AddAskerFlags(CLI::App& command, AskerFlags& flags) {
  command.add_option("--map-from-query", flags.frame, "X Y Z YAW_DEG of the frame of the query, in the map frame")
      ->expected(4);
  command.add_option("--min-revision", flags.min_revision, "Wait until the map is at this revision");
  AddReadFlags(command, flags.read);
}

void AddPaddingFlag(CLI::App& command, double& padding_m) {
  command.add_option("--padding", padding_m, "How far to grow surfaces, in m")->capture_default_str();
}

void AddWorldFlags(CLI::App& command, WorldFlags& flags) {
  AddAskerFlags(command, flags.asker);
  command.add_option("--exclude-submap", flags.excluded_submaps, "Ids of objects to leave out");
  command.add_option("--exclude-class", flags.excluded_class_names, "Names of classes to leave out");
  command.add_option("--class", flags.class_names, "Names of the only classes to look at");
  command.add_option("--max-free-age-s", flags.max_free_age_s,
                     "Free space last seen more than this before the newest frame counts as unknown");
  command.add_flag("--vacated-free", flags.vacated_is_free, "The old places of moved and deleted objects are free");
  command.add_flag("--include-absent", flags.include_absent, "Include absent objects");
}

void AddQueryFlags(CLI::App& command, QueryFlags& flags) {
  command.add_option("--max-distance", flags.max_distance_m, "How far to look, in m")->capture_default_str();
  AddWorldFlags(command, flags.world);
}

void AddUnknownFlag(CLI::App& command, v1::QueryOptions::UnknownPolicy& policy) {
  static const std::map<std::string, v1::QueryOptions::UnknownPolicy> kPolicies = {
      {"occupied", v1::QueryOptions::OCCUPIED}, {"report", v1::QueryOptions::REPORT}, {"free", v1::QueryOptions::FREE}};
  command.add_option("--unknown", policy, "How to treat unseen space: occupied, report, free")
      ->transform(CLI::CheckedTransformer(kPolicies, CLI::ignore_case));
}

void SetVector(const double* xyz, v1::Vector3& vector) {
  vector.set_x(xyz[0]);
  vector.set_y(xyz[1]);
  vector.set_z(xyz[2]);
}

v1::QueryOptions ToProto(const AskerFlags& flags) {
  v1::QueryOptions options;
  options.set_min_revision(flags.min_revision);
  if (flags.frame.empty()) return options;
  v1::Pose& frame = *options.mutable_map_from_query();
  SetVector(flags.frame.data(), *frame.mutable_translation_m());
  const double half_rad = flags.frame[3] * M_PI / 360;
  frame.mutable_rotation()->set_z(std::sin(half_rad));
  frame.mutable_rotation()->set_w(std::cos(half_rad));
  return options;
}

v1::QueryOptions ToProto(const WorldFlags& flags, const std::string& map) {
  v1::QueryOptions options = ToProto(flags.asker);
  for (const std::int64_t id : flags.excluded_submaps) options.add_excluded_submaps(SubmapName(map, id));
  options.mutable_excluded_class_names()->Assign(flags.excluded_class_names.begin(), flags.excluded_class_names.end());
  options.mutable_class_names()->Assign(flags.class_names.begin(), flags.class_names.end());
  if (flags.max_free_age_s) options.set_max_free_age_s(*flags.max_free_age_s);
  if (flags.vacated_is_free) options.set_vacated_policy(v1::Vacated::FREE);
  if (flags.include_absent) options.set_include_absent(true);
  return options;
}

v1::QueryOptions ToProto(const QueryFlags& flags, const std::string& map) {
  v1::QueryOptions options = ToProto(flags.world, map);
  options.set_max_distance_m(flags.max_distance_m);
  return options;
}

}  // namespace dhpmap

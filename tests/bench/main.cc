// SPDX-License-Identifier: BSD-3-Clause
#include <CLI/CLI.hpp>
#include <cstdio>

#include "tests/bench/bench.h"

int main(int argc, char** argv) {
  CLI::App app{"Measures the parts of the map server on recorded frames"};
  app.require_subcommand(1);

  dhpmap::bench::FusionBenchOptions fusion;
  CLI::App* fusion_command = app.add_subcommand("fusion", "Time of fusing a frame, by stage; decoding is not in it");
  fusion_command->add_option("directory", fusion.directory, "Data set")->required();
  fusion_command->add_option("--voxel", fusion.voxel_size_m, "Voxel size in m")->capture_default_str();
  fusion_command->add_option("--truncation", fusion.truncation_m, "Truncation in m")->capture_default_str();
  fusion_command->add_option("--max-range", fusion.max_range_m, "Range limit in m")->capture_default_str();
  fusion_command->add_option("--threads", fusion.num_threads, "Threads, 0 = one a core")->capture_default_str();
  fusion_command->add_option("--frames", fusion.num_frames, "Frames, 0 = all");
  fusion_command->add_option("--repetitions", fusion.repetitions, "Runs over all frames")->capture_default_str();
  fusion_command->add_option("--labels", fusion.labels, "one (a single segment a frame), predicted or groundtruth")
      ->check(CLI::IsMember({"one", "predicted", "groundtruth"}))
      ->capture_default_str();
  fusion_command->add_flag("--carving", fusion.carving, "Clear free space too");

  dhpmap::bench::GeometryCheckOptions geometry;
  CLI::App* geometry_command = app.add_subcommand("geometry", "Surface error against depth images that were held out");
  geometry_command->add_option("directory", geometry.directory, "Data set with ground truth")->required();
  geometry_command->add_option("--hold-out", geometry.hold_out_every, "Hold out every n-th frame")
      ->capture_default_str();
  geometry_command->add_option("--voxel", geometry.voxel_size_m, "Voxel size in m")->capture_default_str();
  geometry_command->add_option("--truncation", geometry.truncation_m, "Truncation in m")->capture_default_str();

  CLI11_PARSE(app, argc, argv);
  const dhpmap::Status status =
      fusion_command->parsed() ? dhpmap::bench::RunFusionBench(fusion) : dhpmap::bench::RunGeometryCheck(geometry);
  if (!status.ok()) std::fprintf(stderr, "dhpmap-bench: %s\n", status.ToString().c_str());
  return status.ok() ? 0 : 1;
}

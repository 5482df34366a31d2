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
  fusion_command->add_flag("!--no-free", fusion.free_space, "Do not keep which voxels were looked through");

  fusion_command->add_flag("!--no-gone", fusion.gone, "Do not look for what is no longer there");
  fusion_command->add_option("--kept-clear", fusion.num_kept_clear, "Keep so many regions clear along the way")
      ->check(CLI::Range(0, 64));

  dhpmap::bench::GeometryCheckOptions geometry;
  CLI::App* geometry_command = app.add_subcommand("geometry", "Surface error against frames that were held out");
  geometry_command->add_option("directory", geometry.directory, "Data set with ground truth")->required();
  geometry_command
      ->add_option("--hold-out", geometry.hold_out_every, "Hold out every n-th frame, 0 = ask those that are mapped")
      ->capture_default_str();
  geometry_command->add_option("--voxel", geometry.voxel_size_m, "Voxel size in m, 0 = the preset's");
  geometry_command->add_option("--truncation", geometry.truncation_m, "Truncation in m, 0 = the preset's");

  dhpmap::bench::CrfBenchOptions crf;
  CLI::App* crf_command = app.add_subcommand("crf", "Time and memory of the dense CRF on many surface voxels");
  crf_command->add_option("directory", crf.directory, "Data set whose surface is tiled; a synthetic room without");
  crf_command->add_option("--frames", crf.num_frames, "Frames of the data set, 0 = all")->capture_default_str();
  crf_command->add_option("--points", crf.num_points, "Points in all")->capture_default_str();
  crf_command->add_option("--labels", crf.num_labels, "Labels")->capture_default_str();
  crf_command->add_option("--iterations", crf.iterations, "Of mean field")->capture_default_str();
  crf_command->add_option("--smoothness-position", crf.smoothness_position_m, "Kernel width in m, 0 = off")
      ->capture_default_str();
  crf_command->add_option("--appearance-position", crf.appearance_position_m, "Kernel width in m, 0 = off")
      ->capture_default_str();
  crf_command->add_option("--appearance-color", crf.appearance_color, "Kernel width of 0..255")->capture_default_str();
  crf_command->add_option("--threads", crf.num_threads, "Threads, 0 = one a core")->capture_default_str();
  crf_command->add_option("--repetitions", crf.repetitions, "Runs")->capture_default_str();

  dhpmap::bench::QueryBenchOptions query;
  CLI::App* query_command = app.add_subcommand("query", "Queries a second of one core, and their errors");
  query_command->add_option("directory", query.directory, "Data set")->required();
  query_command->add_option("--frames", query.num_frames, "Frames, 0 = all");
  query_command->add_option("--points", query.num_points, "Points of each kind")->capture_default_str();
  query_command->add_option("--check", query.num_checked, "Of these, compared with brute force")->capture_default_str();
  query_command->add_flag("--distances", query.only_distances, "Nothing but distances");

  dhpmap::bench::ChangeBenchOptions change;
  CLI::App* change_command = app.add_subcommand("change", "What is gone and what was moved between two walks");
  change_command->add_option("directory", change.directory, "Recording of dhpmap-simulate --change")->required();
  change_command->add_option("--labels", change.labels, "predicted or groundtruth")->capture_default_str();
  change_command->add_flag("--framewise", change.framewise, "Do not use persistent ids");
  change_command->add_flag("--carving", change.carving, "Clear free space too");
  change_command->add_flag("!--no-gone", change.gone, "Do not look for what is no longer there");

  dhpmap::bench::FrayBenchOptions fray;
  CLI::App* fray_command =
      app.add_subcommand("fray", "How many things are listed a true one, recording after recording");
  fray_command->add_option("directories", fray.directories, "Data sets of one place with ground truth")->required();
  fray_command->add_option("--set", fray.settings, "key=value of the map's configuration, on top of the preset");
  fray_command->add_option("--frames", fray.num_frames, "Frames of each, 0 = all");
  fray_command->add_option("--threads", fray.num_threads, "Threads, 0 = one a core")->capture_default_str();
  fray_command->add_flag("--list", fray.list, "List the things by the true object that they lie on");

  dhpmap::bench::StoreBenchOptions store;
  CLI::App* store_command = app.add_subcommand(
      "store",
      "Rates of the store on a fused map of a given size: commit, load, verify, export, import, in MB of blobs, or of "
      "the "
      "file, a second of the clock and of the process's cores; then how long commits of another map, which is mapped "
      "meanwhile, take while the file comes in. Import has four parts: what came is kept; looked through, as verify "
      "does; its blobs are brought in steps between which commits go on; its rows are added, which commits wait for");
  store_command
      ->add_option("directory", store.directory, "Data set; it is walked again and again, each walk beside the last")
      ->required();
  store_command->add_option("--mib", store.size_mib, "MiB of encoded blobs that the map is to have")
      ->capture_default_str();
  store_command
      ->add_option("--voxel", store.voxel_size_m, "Voxel size in m, 0 = the preset's; the truncation goes with it")
      ->capture_default_str();
  store_command->add_option("--frames", store.num_frames, "Frames of a walk, 0 = all");
  store_command->add_option("--commit-frames", store.commit_frames, "Frames a commit")->capture_default_str();
  store_command->add_option("--repetitions", store.repetitions, "Imports beside commits, 0 = none")
      ->capture_default_str();
  store_command
      ->add_option("--commit-every", store.commit_every_s, "Pause in s between a frame with its commit and the next")
      ->capture_default_str();
  store_command->add_option("--scratch", store.scratch, "Folder for the database, three times the map's size")
      ->capture_default_str();

  CLI11_PARSE(app, argc, argv);
  const dhpmap::Status status = fusion_command->parsed()     ? dhpmap::bench::RunFusionBench(fusion)
                                : geometry_command->parsed() ? dhpmap::bench::RunGeometryCheck(geometry)
                                : query_command->parsed()    ? dhpmap::bench::RunQueryBench(query)
                                : change_command->parsed()   ? dhpmap::bench::RunChangeBench(change)
                                : store_command->parsed()    ? dhpmap::bench::RunStoreBench(store)
                                : fray_command->parsed()     ? dhpmap::bench::RunFrayBench(fray)
                                                             : dhpmap::bench::RunCrfBench(crf);
  if (!status.ok()) std::fprintf(stderr, "dhpmap-bench: %s\n", status.ToString().c_str());
  return status.ok() ? 0 : 1;
}

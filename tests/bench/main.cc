// SPDX-License-Identifier: BSD-3-Clause
#include <CLI/CLI.hpp>
#include <cstdio>
#include <string>

#include "clients/command_line/typos.h"
#include "clients/command_line/version.h"
#include "tests/bench/bench.h"

namespace {

/// Of `store`: a made map instead of a data set, read at several budgets of memory.
CLI::Option* AddPagingOptions(CLI::App& command, dhpmap::bench::PagingBenchOptions& paging) {
  const std::string instead =
      "Instead: what a made map larger than its budget of memory answers, how fast, and what it takes";
  CLI::Option* const flag = command.add_flag("--paging", instead);  // text alone would do for its value, too
  command.add_option("--disk-mib", paging.disk_mib, "With --paging: MiB of encoded blobs of the map")
      ->check(CLI::Range(1.0, 1e5))
      ->needs(flag)
      ->capture_default_str();
  command.add_option("--budgets-mib", paging.budgets_mib, "With --paging: budgets of memory, by commas")
      ->delimiter(',')
      ->check(CLI::Range(1, 1'000'000))
      ->needs(flag)
      ->capture_default_str();
  command.add_flag("--json", paging.json, "With --paging: as JSON instead of a table")->needs(flag);
  return flag;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{"Measures the parts of the map server on recorded frames", "dhpmap-bench"};
  app.set_version_flag("--version", dhpmap::VersionOf("dhpmap-bench"));
  app.failure_message(dhpmap::ExplainParseError);
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
  fusion_command->add_flag("!--no-free", fusion.free_space, "Do not keep which voxels were looked through");

  fusion_command->add_flag("!--no-gone", fusion.gone, "Do not look for what is no longer there");
  fusion_command->add_option("--kept-clear", fusion.num_kept_clear, "Keep so many regions clear along the way")
      ->check(CLI::Range(0, 64));

  dhpmap::bench::SurfaceCheckOptions surfaces;
  CLI::App* surfaces_command =
      app.add_subcommand("surfaces", "Distances against the whole-map mesh, and both against depth images");
  surfaces_command->add_option("directory", surfaces.directory, "Data set with depth images")->required();
  surfaces_command->add_option("--frames", surfaces.num_frames, "Frames, 0 = all");
  surfaces_command->add_option("--points", surfaces.num_points, "Points around surfaces")->capture_default_str();
  surfaces_command->add_option("--reach", surfaces.reach_m, "Of the points, in m")->capture_default_str();
  surfaces_command->add_option("--things", surfaces.num_things, "To exclude and move")->capture_default_str();
  surfaces_command->add_option("--seed", surfaces.seed, "Of the points")->capture_default_str();

  dhpmap::bench::PathCheckOptions paths;
  CLI::App* paths_command = app.add_subcommand("paths", "Whether ways that an occupancy slice leaves pass checks");
  paths_command->add_option("directory", paths.directory, "Data set")->required();
  paths_command->add_option("--frames", paths.num_frames, "Frames, 0 = all");
  paths_command->add_option("--min-z", paths.min_z_m, "Of the band, in m")->capture_default_str();
  paths_command->add_option("--max-z", paths.max_z_m, "Of the band, in m")->capture_default_str();
  paths_command->add_option("--radius", paths.radius_m, "Of the ball, in m")->capture_default_str();
  paths_command->add_option("--resolution", paths.resolution_m, "Of the slice in m, 0 = the voxel size");
  paths_command->add_option("--height-step", paths.height_step_m, "Between the heights of steps, in m")
      ->check(CLI::Range(0.001, 100.0))
      ->capture_default_str();
  paths_command->add_option("--list", paths.num_listed, "So many of the cells in which it collides");

  dhpmap::bench::DoorCheckOptions doors;
  CLI::App* doors_command = app.add_subcommand("doors", "How much room the doors of the sample apartment have");
  doors_command->add_option("directory", doors.directory, "Recording of dhpmap-simulate")->required();
  doors_command->add_option("--frames", doors.num_frames, "Frames, 0 = all");

  dhpmap::bench::SliceBenchOptions slices;
  CLI::App* slices_command = app.add_subcommand("slices", "Time of an occupancy slice of all that is known");
  slices_command->add_option("directory", slices.directory, "Data set")->required();
  slices_command->add_option("--frames", slices.num_frames, "Frames, 0 = all");
  slices_command->add_option("--min-z", slices.min_z_m, "Of the band, in m")->capture_default_str();
  slices_command->add_option("--max-z", slices.max_z_m, "Of the band, in m")->capture_default_str();
  slices_command->add_flag("--objects", slices.objects, "Also whose each cell is");

  dhpmap::bench::InsideCheckOptions inside;
  CLI::App* inside_command = app.add_subcommand("inside", "Whether the unseen inside of things is solid");
  inside_command->add_option("directory", inside.directory, "Recording of dhpmap-simulate")->required();
  inside_command->add_option("--frames", inside.num_frames, "Frames, 0 = all");
  inside_command->add_option("--depth", inside.depth_m, "So deep inside, in m")->capture_default_str();
  inside_command->add_option("--seed", inside.seed, "Of the places")->capture_default_str();

  dhpmap::bench::BoxCheckOptions boxes;
  CLI::App* boxes_command =
      app.add_subcommand("boxes", "Boxes of a map's things against those of the parts that were seen");
  boxes_command->add_option("directories", boxes.directories, "Recordings of dhpmap-simulate")->required();
  boxes_command->add_flag("--list", boxes.list, "List the things");

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
  query_command->add_option("--points", query.num_points, "Points of each kind")
      ->check(CLI::Range(10, 10'000'000))
      ->capture_default_str();
  query_command->add_option("--check", query.num_checked, "Of these, compared with brute force")->capture_default_str();
  query_command->add_flag("--distances", query.only_distances, "Nothing but distances");
  query_command->add_flag("--edits", query.only_edits, "Nothing but the first distances after edits far away");
  query_command->add_flag("--first", query.only_first,
                          "Nothing but the first distances of a map that nobody has asked about");

  dhpmap::bench::ChangeBenchOptions change;
  CLI::App* change_command = app.add_subcommand("change", "What is gone and what was moved between two walks");
  change_command->add_option("directory", change.directory, "Recording of dhpmap-simulate --change")->required();
  change_command->add_option("--labels", change.labels, "predicted or groundtruth")->capture_default_str();
  change_command->add_flag("--framewise", change.framewise, "Do not use persistent ids");
  change_command->add_flag("!--no-gone", change.gone, "Do not look for what is no longer there");

  dhpmap::bench::FrayBenchOptions fray;
  CLI::App* fray_command =
      app.add_subcommand("fray", "How many things are listed a true one, recording after recording");
  fray_command
      ->add_option("directories", fray.directories,
                   "Data sets of one place with ground truth, which that of the first is")
      ->required();
  fray_command->add_option("--set", fray.settings, "key=value of the map's configuration, on top of the preset");
  fray_command->add_option("--frames", fray.num_frames, "Frames of each, 0 = all");
  fray_command->add_option("--threads", fray.num_threads, "Threads, 0 = one a core")->capture_default_str();
  fray_command->add_flag("--list", fray.list, "List the things by the true object that they lie on");

  dhpmap::bench::BudgetBenchOptions budget;
  CLI::App* budget_command =
      app.add_subcommand("budget", "A map made with budgets of memory for its voxels, and whether it is the same");
  budget_command->add_option("directory", budget.directory, "Data set")->required();
  budget_command->add_option("--frames", budget.num_frames, "Frames, 0 = all");
  budget_command->add_option("--budgets-mib", budget.budgets_mib, "Budgets, by commas, beside all in memory")
      ->delimiter(',')
      ->check(CLI::Range(1, 1'000'000))
      ->capture_default_str();
  budget_command->add_option("--scratch", budget.scratch, "Folder for the databases")->capture_default_str();

  dhpmap::bench::StoreBenchOptions store;
  CLI::App* store_command = app.add_subcommand(
      "store",
      "Rates of the store on a fused map of a given size: commit, load, verify, export, import, in MB of blobs, or of "
      "the "
      "file, a second of the clock and of the process's cores; then how long commits of another map, which is mapped "
      "meanwhile, take while the file comes in. Import has four parts: what came is kept; looked through, as verify "
      "does; its blobs are brought in steps between which commits go on; its rows are added, which commits wait for");
  CLI::Option* const walked = store_command->add_option(
      "directory", store.directory, "Data set; it is walked again and again, each walk beside the last");
  dhpmap::bench::PagingBenchOptions paging;
  const CLI::Option* const is_paging = AddPagingOptions(*store_command, paging)->excludes(walked);
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

  dhpmap::bench::EditBenchOptions edit;
  CLI::App* edit_command = app.add_subcommand(
      "edit",
      "Time of each edit on objects of several sizes: on the map's writer, until it is stored, and of its undo");
  edit_command->add_option("--voxels", edit.num_voxels, "Observed voxels of an object, about; may be repeated")
      ->check(CLI::Range(500.0, 1e7))
      ->capture_default_str();
  edit_command->add_option("--repetitions", edit.repetitions, "Of each edit; the median is told")
      ->check(CLI::Range(1, 100))
      ->capture_default_str();
  edit_command->add_option("--scratch", edit.scratch, "Folder for the databases; default: the system's for such files");
  edit_command->add_flag("--json", edit.json, "As JSON instead of a table");

  CLI11_PARSE(app, argc, argv);
  if (store_command->parsed() && store.directory.empty() && is_paging->count() == 0) {
    return app.exit(CLI::RequiredError("directory, or --paging,"));
  }
  paging.scratch = store.scratch;
  const dhpmap::Status status = fusion_command->parsed()     ? dhpmap::bench::RunFusionBench(fusion)
                                : geometry_command->parsed() ? dhpmap::bench::RunGeometryCheck(geometry)
                                : boxes_command->parsed()    ? dhpmap::bench::RunBoxCheck(boxes)
                                : surfaces_command->parsed() ? dhpmap::bench::RunSurfaceCheck(surfaces)
                                : paths_command->parsed()    ? dhpmap::bench::RunPathCheck(paths)
                                : doors_command->parsed()    ? dhpmap::bench::RunDoorCheck(doors)
                                : slices_command->parsed()   ? dhpmap::bench::RunSliceBench(slices)
                                : inside_command->parsed()   ? dhpmap::bench::RunInsideCheck(inside)
                                : query_command->parsed()    ? dhpmap::bench::RunQueryBench(query)
                                : change_command->parsed()   ? dhpmap::bench::RunChangeBench(change)
                                : is_paging->count() > 0     ? dhpmap::bench::RunPagingBench(paging)
                                : store_command->parsed()    ? dhpmap::bench::RunStoreBench(store)
                                : edit_command->parsed()     ? dhpmap::bench::RunEditBench(edit)
                                : budget_command->parsed()   ? dhpmap::bench::RunBudgetBench(budget)
                                : fray_command->parsed()     ? dhpmap::bench::RunFrayBench(fray)
                                                             : dhpmap::bench::RunCrfBench(crf);
  if (!status.ok()) std::fprintf(stderr, "dhpmap-bench: %s\n", status.ToString().c_str());
  return status.ok() ? 0 : 1;
}

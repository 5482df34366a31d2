// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "mapping/base/status.h"

namespace dhpmap::bench {

struct FusionBenchOptions {
  std::string directory;
  std::string labels = "one";  ///< "one": a single background segment a frame; or predicted, groundtruth
  double voxel_size_m = 0.04;
  double truncation_m = 0.08;
  double max_range_m = 5.0;
  int num_threads = 1;
  std::size_t num_frames = 0;
  int repetitions = 3;
  bool free_space = true, gone = true;
  std::size_t num_kept_clear = 0;  ///< regions of 0.3 m along the way that hold no surface, so that they only cost
};
/// Time of fusing a frame by stage, and the size of the map.
Status RunFusionBench(const FusionBenchOptions& options);

struct GeometryCheckOptions {
  std::string directory;
  int hold_out_every = 10;  ///< 0: all frames are mapped, and all are asked
  int pixel_step = 7;
  double voxel_size_m = 0, truncation_m = 0;  ///< 0: the preset's
};
/// Maps all frames but every n-th, then compares the surface with what the frames held out have measured: along the
/// rays of depth images, by brute force over all triangles for points of scans. And how flat it is where it should be.
Status RunGeometryCheck(const GeometryCheckOptions& options);

struct SurfaceCheckOptions {
  std::string directory;
  std::size_t num_frames = 0;
  std::size_t num_points = 20000;  ///< around surfaces, and on them
  double reach_m = 0.25;           ///< of the points, from a surface
  std::size_t num_things = 20;     ///< the largest, excluded and moved one by one
  unsigned seed = 1;
};
/// Whether distances agree with the whole-map mesh, and both with what depth images saw: measured by code of its own.
Status RunSurfaceCheck(const SurfaceCheckOptions& options);

struct PathCheckOptions {
  std::string directory;
  std::size_t num_frames = 0;
  double min_z_m = 0.1, max_z_m = 1.2;  ///< of the band
  double radius_m = 0.2;                ///< of the ball
  double resolution_m = 0;              ///< of the slice; 0: the map's voxel size
  double height_step_m = 0.1;           ///< between the heights at which steps are checked
  std::size_t num_listed = 0;           ///< of the cells in which it collides
};
/// Whether a ball that goes where a slice lets it passes the check of its motion, at all heights of the band, with what
/// is unknown free, and occupied. All paths of A* are made of the steps that are looked at.
Status RunPathCheck(const PathCheckOptions& options);

struct SliceBenchOptions {
  std::string directory;
  std::size_t num_frames = 0;
  double min_z_m = 0.1, max_z_m = 1.2;  ///< of the band
  bool objects = false;                 ///< also whose each cell is
};
/// How long a slice of all that is known takes by what is unknown: the first of a map, later ones, and after an edit.
Status RunSliceBench(const SliceBenchOptions& options);

struct InsideCheckOptions {
  std::string directory;  ///< of dhpmap-simulate, nothing changed
  std::size_t num_frames = 0;
  double depth_m = 0.12;  ///< so deep inside solids
  unsigned seed = 1;
};
/// What answers say of the inside of things, which nobody has seen, if what is unknown is free: by the simulator's
/// truth.
Status RunInsideCheck(const InsideCheckOptions& options);

struct DoorCheckOptions {
  std::string directory;  ///< of dhpmap-simulate, nothing changed
  std::size_t num_frames = 0;
};
/// How much room doors have, by what distances say and by the simulator's scene.
Status RunDoorCheck(const DoorCheckOptions& options);

struct CrfBenchOptions {
  std::string directory;        ///< empty: a synthetic room
  std::size_t num_frames = 80;  ///< of the data set
  std::size_t num_points = 1000000;
  int num_labels = 21;
  int iterations = 5;
  double smoothness_position_m = 0.10, appearance_position_m = 0.30, appearance_color = 20.0;
  int num_threads = 2;
  int repetitions = 3;
};
/// Time and memory of the dense CRF on the surface voxels of a map, tiled side by side, with noisy labels.
Status RunCrfBench(const CrfBenchOptions& options);

struct ChangeBenchOptions {
  std::string directory;
  std::string labels = "predicted";  ///< or groundtruth
  bool framewise = false;            ///< without persistent ids, though the labels have them
  bool gone = true;
};
/// Maps a double walk of dhpmap-simulate --change: how much of what is gone still has a surface, how much of what was
/// moved has one at its new place, and whether anything else has lost its own.
Status RunChangeBench(const ChangeBenchOptions& options);

struct FrayBenchOptions {
  std::vector<std::string> directories;  ///< mapped one after the other into one map; of one place
  std::vector<std::string> settings;     ///< key=value of the map's configuration, on top of the preset
  std::size_t num_frames = 0;            ///< of each
  int num_threads = 2;
  bool list = false;  ///< all things, by the true object that most of each lies on
};
/// How many things a map lists for how many true ones, and how well they fit, after one or more recordings of a place.
Status RunFrayBench(const FrayBenchOptions& options);

struct BoxCheckOptions {
  std::vector<std::string> directories;
  bool list = false;  ///< every thing
};
/// How well the boxes of a map's things (OutlineInMap) fit those of what images show of them, by the truth.json of
/// simulated recordings, with predicted and with true labels. Which object a thing is follows from its point_m.
Status RunBoxCheck(const BoxCheckOptions& options);

struct QueryBenchOptions {
  std::string directory;
  std::size_t num_frames = 0;
  std::size_t num_points = 100000;  ///< of each kind
  std::size_t num_checked = 300;    ///< of these, compared with every triangle
  bool only_distances = false;
  bool only_edits = false;  ///< what they cost that change nothing near by
  bool only_first = false;  ///< distances of a map that nobody has asked about
};
/// What one core answers a second on the data set's map, as it is and with a third of the things moved, the errors
/// against brute force over all triangles, and how the time grows with the number of submaps.
Status RunQueryBench(const QueryBenchOptions& options);

struct StoreBenchOptions {
  std::string directory;
  std::string scratch = "/tmp";  ///< folder in which the database is made, and removed again
  double size_mib = 200;         ///< of encoded blobs
  double voxel_size_m = 0;       ///< 0: the preset's; the truncation goes with it
  std::size_t num_frames = 0;    ///< of a walk
  int commit_frames = 10;
  int repetitions = 3;  ///< imports beside commits; 0: none
  double commit_every_s = 0.1, alone_s = 5;
};
/// Rates of the store on a fused map of a given size, walk beside walk: commit, load, verify, export, import; and how
/// long commits of a map that is being mapped wait while others come in.
Status RunStoreBench(const StoreBenchOptions& options);

struct PagingBenchOptions {
  double disk_mib = 600;  ///< of encoded blobs
  std::vector<std::int64_t> budgets_mib = {256, 1024, 8192};
  std::string scratch = "/tmp";  ///< folder in which the database is made, and removed again
  bool json = false;
};
/// What a made map of this size answers at each budget of memory for its voxels, in a process of its own: how soon
/// after the start, how fast, what it takes, and whether it is what the map answers that is all in memory, where that
/// fits.
Status RunPagingBench(const PagingBenchOptions& options);

struct BudgetBenchOptions {
  std::string directory;
  std::size_t num_frames = 0;  ///< 0 = all
  std::vector<std::int64_t> budgets_mib = {32};
  std::string scratch = "/tmp";  ///< folder of the databases, which are removed again
};
/// A data set mapped as a server does, with all voxels in memory and with each budget of memory for them, in a process
/// of its own: what that costs, and whether it is the same map.
Status RunBudgetBench(const BudgetBenchOptions& options);

struct EditBenchOptions {
  std::vector<double> num_voxels = {1e3, 1e5, 1e6};  ///< of the objects that are edited, about
  std::string scratch;                               ///< folder for the databases; empty: that of the system
  int repetitions = 3;                               ///< of each edit; medians are told
  bool json = false;
};
/// What each edit costs on things of these sizes, beside two more of the kind: on the map's writer, until it is stored
/// with a full sync, and what its undo costs.
Status RunEditBench(const EditBenchOptions& options);

}  // namespace dhpmap::bench

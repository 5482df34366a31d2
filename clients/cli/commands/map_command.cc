// SPDX-License-Identifier: BSD-3-Clause
// dhpmap map: streams a data set into a map.
#include <CLI/CLI.hpp>
#include <atomic>
#include <csignal>
#include <iostream>
#include <utility>

#include "clients/cli/ack_summary.h"
#include "clients/cli/connection.h"
#include "clients/cli/finish_call.h"
#include "clients/cli/frame_selection.h"
#include "clients/cli/frame_stream.h"
#include "clients/cli/map_settings.h"
#include "clients/cli/new_map.h"
#include "clients/cli/progress_bar.h"
#include "clients/cli/text_table.h"
#include "clients/datasets/dataset.h"
#include "clients/datasets/open_dataset.h"

namespace dhpmap {
namespace {

struct MapOptions {
  std::string directory, format = "auto", labels = "auto", ids = "auto";
  FrameSelection selection;
  NewMap map;
  bool no_finish = false, keep_moving_points = false, take_over = false, refuse_implausible = false;
  std::string session;
  double reconnect_s = 30;
};

std::atomic<bool> g_is_interrupted = false;

/// The first Ctrl-C ends the stream in good order, the second one ends the program.
void OnInterrupt(int) {
  g_is_interrupted = true;
  std::signal(SIGINT, SIG_DFL);
}

/// "auto" uses predictions if the data set has them.
Result<std::unique_ptr<Dataset>> Open(const MapOptions& options) {
  const DatasetOptions dataset_options{.drop_moving_points = !options.keep_moving_points};
  if (options.labels != "auto") {
    DHPMAP_ASSIGN_OR_RETURN(const LabelSource labels, ParseLabelSource(options.labels));
    return OpenDataset(options.directory, options.format, labels, dataset_options);
  }
  auto dataset = OpenDataset(options.directory, options.format, LabelSource::kPredicted, dataset_options);
  if (dataset.ok() || dataset.status().reason() != "NO_LABELS") return dataset;
  std::cerr << "dhpmap: mapping without labels: " << dataset.status().message() << "\n";
  return OpenDataset(options.directory, options.format, LabelSource::kNone, dataset_options);
}

/// Streams frames into a map once.
class Run {
 public:
  Run(const MapOptions& options, Dataset& dataset, AckSummary& summary, ProgressBar& progress)
      : options_(options), dataset_(dataset), summary_(summary), progress_(progress) {}

  /// Streams and reports; the caller evaluates the counts.
  client::Status Stream(const std::shared_ptr<client::Caller>& caller, const std::vector<std::size_t>& indices) {
    const FrameSession session{.map = MapName(options_.map.name),
                               .name = options_.session,
                               .take_over = options_.take_over,
                               .refuse_implausible = options_.refuse_implausible,
                               .reconnect_s = options_.reconnect_s};
    client::Status status = StreamFrames(
        caller, session, indices,
        {.read = [this](const std::vector<std::size_t>& left) { return Read(left); },
         .on_stored_before = [this](std::size_t num_frames) { summary_.SetStoredBefore(num_frames); },
         .on_ack = [this](const v1::IntegrateFramesResponse& ack) { Hear(ack); },
         .on_progress = [this](const v1::IntegrateFramesResponse& answer) { summary_.AddProgress(answer); },
         .reconnect = [this](const client::Status& why) { return Reconnect(why); },
         .is_interrupted = [] { return g_is_interrupted.load(); }});
    if (status.ok()) summary_.SetAllStored();
    return status;
  }

 private:
  std::unique_ptr<FrameQueue> Read(const std::vector<std::size_t>& indices) {
    const bool persistent = options_.ids == "auto" ? dataset_.has_persistent_ids() : options_.ids == "persistent";
    return std::make_unique<FrameQueue>(dataset_, indices, persistent, [this](std::size_t index, const Status& why) {
      if (summary_.AddSkipped(why)) Warn(index, "skipped", why.message());
    });
  }

  void Hear(const v1::IntegrateFramesResponse& ack) {
    if (summary_.AddAck(ack)) Warn(static_cast<std::size_t>(ack.sequence()), "refused", ack.error().message());
    for (const std::string& warning : summary_.AddWarnings(ack)) {
      Warn(static_cast<std::size_t>(ack.sequence()), "doubtful", warning);
    }
    progress_.Show(summary_.num_done(), Fixed(static_cast<double>(summary_.num_done()) / progress_.elapsed_s(), 1) +
                                            " frames/s, " + std::to_string(summary_.num_created()) + " new submaps");
  }

  bool Reconnect(const client::Status& why) {
    if (g_is_interrupted) return false;
    progress_.Print("the connection is lost (" + why.message + "): trying for " + Fixed(options_.reconnect_s, 0) +
                    " s to go on where the server stopped");
    return true;
  }

  void Warn(std::size_t index, const char* what, const std::string& why) {
    progress_.Print(std::string(what) + " frame " + std::to_string(index) +
                    " (others like it are only counted): " + why);
  }

  const MapOptions& options_;
  Dataset& dataset_;
  AckSummary& summary_;
  ProgressBar& progress_;
};

client::Status Finish(client::Caller& caller, const std::string& map) {
  const auto finished = FinishAndTell(caller, map);
  if (finished.status().code != client::StatusCode::kCancelled) return finished.status();
  g_is_interrupted = true;
  return {};
}

ExitCode RunMap(const Session& session, const MapOptions& options) {
  const auto dataset = Open(options);
  if (!dataset.ok()) return ReportLocalError(dataset.status().message());
  const std::vector<std::size_t> indices = options.selection.Indices((*dataset)->num_frames());
  if (indices.empty()) {
    return ReportLocalError("of " + std::to_string((*dataset)->num_frames()) + " frames none is selected",
                            ExitCode::kUsage);
  }
  if (const ExitCode code = EnsureMap(session, options.map, **dataset); code != ExitCode::kOk) return code;

  AckSummary summary;
  double elapsed_s = 0;
  client::Status status;
  std::signal(SIGINT, OnInterrupt);
  {
    ProgressBar progress(indices.size());
    status = Run(options, **dataset, summary, progress).Stream(session.caller, indices);
    elapsed_s = progress.elapsed_s();
  }
  if (status.ok() && !options.no_finish && !g_is_interrupted) {
    status = Finish(*session.caller, MapName(options.map.name));
  }
  v1::Map map;
  if (status.ok()) {
    auto got = GetMap(session, options.map.name);
    status = got.status();
    if (got.ok()) map = *std::move(got);
  }
  if (session.json) {
    std::cout << summary.Json(map, elapsed_s);
  } else {
    summary.Print(std::cout, elapsed_s);
    if (status.ok()) {
      std::cout << map.name() << " holds " << map.num_submaps() << " submaps at revision " << map.revision() << "\n";
    }
  }
  if (!status.ok()) return ReportError(session, status);
  if (g_is_interrupted) return ExitCode::kInterrupted;
  return summary.num_refused() > 0 || summary.num_stored() == 0 ? ExitCode::kPartly : ExitCode::kOk;
}

}  // namespace

void AddMapCommand(CLI::App& app, Session& session) {
  auto options = std::make_shared<MapOptions>();
  CLI::App* command = app.add_subcommand("map", "Stream a data set into a map; creates the map if it does not exist");
  command->add_option("directory", options->directory, "Root of the data set, or one of its recordings")->required();
  command->add_option("--map", options->map.name, "Name of the map")->required();
  command->add_option("--format", options->format, "Layout of the data set")
      ->check(CLI::IsMember(DatasetFormats()))
      ->capture_default_str();
  command->add_option("--labels", options->labels, "Where labels come from; auto: predictions if there are any")
      ->check(CLI::IsMember({"auto", "predicted", "groundtruth", "none"}))
      ->capture_default_str();
  command
      ->add_option("--ids", options->ids,
                   "Do segment ids mean the same object in every frame? auto: as the labels have it")
      ->check(CLI::IsMember({"auto", "persistent", "framewise"}))
      ->capture_default_str();
  command->add_option("--start", options->selection.start, "Index of the first frame");
  command->add_option("--frames", options->selection.frames, "Number of frames to use");
  command->add_option("--every", options->selection.every, "Take every Kth of them")->check(CLI::PositiveNumber);
  command->add_option("--skip-every", options->selection.skip_every, "Hold out frames K-1, 2K-1, ...")
      ->check(CLI::PositiveNumber);
  AddNewMapOptions(*command, options->map);
  command->add_flag("--keep-moving-points", options->keep_moving_points,
                    "Keep LiDAR points that the data set's labels call moving or unlabelled");
  command->add_flag("--no-finish", options->no_finish, "Do not call FinishMapping at the end");
  command->add_option("--session", options->session, "Feed session: resumes after a lost connection or when run again");
  command->add_option("--reconnect-s", options->reconnect_s, "In a session: how long to try after a lost connection")
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str();
  command->add_flag("--take-over", options->take_over, "Replace the active streams of the map");
  command->add_flag("--refuse-implausible", options->refuse_implausible,
                    "Refuse implausible frames instead of warning of them");
  command->callback([options, &session] { session.exit_code = RunMap(session, *options); });
}

}  // namespace dhpmap

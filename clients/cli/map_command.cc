// SPDX-License-Identifier: BSD-3-Clause
// dhpmap map: streams a data set into a map.
#include <CLI/CLI.hpp>
#include <atomic>
#include <csignal>
#include <iostream>

#include "clients/cli/ack_summary.h"
#include "clients/cli/connection.h"
#include "clients/cli/frame_selection.h"
#include "clients/cli/frame_stream.h"
#include "clients/cli/map_settings.h"
#include "clients/cli/new_map.h"
#include "clients/cli/progress_bar.h"
#include "clients/cli/text_table.h"
#include "clients/datasets/dataset.h"
#include "dhpmap/v1/mapping_service.grpc.pb.h"

namespace dhpmap {
namespace {

struct MapOptions {
  std::string directory, format = "auto", labels = "auto", ids = "auto";
  FrameSelection selection;
  NewMap map;
  bool no_finish = false, keep_moving_points = false;
};

std::atomic<bool> g_is_interrupted = false;

/// The first Ctrl-C ends the stream in good order, the second one the program.
void OnInterrupt(int) {
  g_is_interrupted = true;
  std::signal(SIGINT, SIG_DFL);
}

/// "auto" takes predictions where the data set has them.
Result<std::unique_ptr<Dataset>> Open(const MapOptions& options) {
  const DatasetOptions dataset_options{.drop_moving_points = !options.keep_moving_points};
  DHPMAP_ASSIGN_OR_RETURN(const DatasetFormat format, ParseDatasetFormat(options.format));
  if (options.labels != "auto") {
    DHPMAP_ASSIGN_OR_RETURN(const LabelSource labels, ParseLabelSource(options.labels));
    return OpenDataset(options.directory, format, labels, dataset_options);
  }
  auto dataset = OpenDataset(options.directory, format, LabelSource::kPredicted, dataset_options);
  if (dataset.ok() || dataset.status().reason() != "NO_LABELS") return dataset;
  std::cerr << "dhpmap: mapping without labels: " << dataset.status().message() << "\n";
  return OpenDataset(options.directory, format, LabelSource::kNone, dataset_options);
}

/// Streams and reports; the caller still has to look at the counts.
grpc::Status Stream(const std::shared_ptr<grpc::Channel>& channel, const MapOptions& options, Dataset& dataset,
                    AckSummary& summary, ProgressBar& progress, const std::vector<std::size_t>& indices) {
  const auto warn = [&progress](std::size_t index, const char* what, const std::string& why) {
    progress.Print(std::string(what) + " frame " + std::to_string(index) +
                   " (others like it are only counted): " + why);
  };
  const bool persistent = options.ids == "auto" ? dataset.has_persistent_ids() : options.ids == "persistent";
  FrameQueue queue(dataset, indices, persistent, [&](std::size_t index, const Status& why) {
    if (summary.AddSkipped(why)) warn(index, "skipped", why.message());
  });
  const auto stub = v1::MappingService::NewStub(channel);
  return StreamFrames(*stub, MapName(options.map.name), queue, [&](const v1::IntegrateFramesResponse& ack) {
    if (summary.AddAck(ack)) warn(static_cast<std::size_t>(ack.sequence()), "refused", ack.error_message());
    progress.Show(summary.num_done(), Fixed(static_cast<double>(summary.num_done()) / progress.elapsed_s(), 1) +
                                          " frames/s, " + std::to_string(summary.num_created()) + " new submaps");
    if (g_is_interrupted) queue.Stop();
  });
}

grpc::Status Finish(const std::shared_ptr<grpc::Channel>& channel, const std::string& map) {
  grpc::ClientContext context;
  v1::FinishMappingRequest request;
  request.set_map(map);
  v1::FinishMappingResponse response;
  return v1::MappingService::NewStub(channel)->FinishMapping(&context, request, &response);
}

ExitCode RunMap(const Session& session, const MapOptions& options) {
  const auto dataset = Open(options);
  if (!dataset.ok()) return ReportLocalError(dataset.status().message());
  const std::vector<std::size_t> indices = options.selection.Indices((*dataset)->num_frames());
  if (indices.empty()) {
    return ReportLocalError("of " + std::to_string((*dataset)->num_frames()) + " frames none is selected",
                            ExitCode::kUsage);
  }
  const auto channel = Connect(session);
  if (const ExitCode code = EnsureMap(session, channel, options.map, **dataset); code != ExitCode::kOk) return code;

  AckSummary summary;
  double elapsed_s = 0;
  grpc::Status status;
  std::signal(SIGINT, OnInterrupt);
  {
    ProgressBar progress(indices.size());
    status = Stream(channel, options, **dataset, summary, progress, indices);
    elapsed_s = progress.elapsed_s();
  }
  if (status.ok() && !options.no_finish && !g_is_interrupted) status = Finish(channel, MapName(options.map.name));
  v1::Map map;
  if (status.ok()) status = GetMap(channel, options.map.name, map);
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
  return summary.num_refused() > 0 || summary.num_fused() == 0 ? ExitCode::kPartly : ExitCode::kOk;
}

}  // namespace

void AddMapCommand(CLI::App& app, Session& session) {
  auto options = std::make_shared<MapOptions>();
  CLI::App* command = app.add_subcommand("map", "Stream a data set into a map, which is created if it is not there");
  command->add_option("directory", options->directory, "Root of the data set, or one of its recordings")->required();
  command->add_option("--map", options->map.name, "Name of the map")->required();
  command->add_option("--format", options->format, "Layout of the data set")
      ->check(CLI::IsMember({"auto", "flat", "kitti", "sevenscenes", "tum"}))
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
  command->add_option("--frames", options->selection.frames, "Look at so many frames only");
  command->add_option("--every", options->selection.every, "Take every Kth of them")->check(CLI::PositiveNumber);
  command->add_option("--skip-every", options->selection.skip_every, "Hold out frames K-1, 2K-1, ...")
      ->check(CLI::PositiveNumber);
  AddNewMapOptions(*command, options->map);
  command->add_flag("--keep-moving-points", options->keep_moving_points,
                    "Keep LiDAR points that the data set's labels call moving or unlabelled");
  command->add_flag("--no-finish", options->no_finish, "Leave the session open: do not call FinishMapping at the end");
  command->callback([options, &session] { session.exit_code = RunMap(session, *options); });
}

}  // namespace dhpmap

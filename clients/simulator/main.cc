// SPDX-License-Identifier: BSD-3-Clause
// dhpmap-simulate: records a walk through a furnished apartment as a data set with ground truth.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <string>

#include "clients/command_line/typos.h"
#include "clients/command_line/version.h"
#include "clients/simulator/apartment.h"
#include "clients/simulator/flat_recording.h"
#include "clients/simulator/image_files.h"
#include "clients/simulator/plan_view.h"
#include "clients/simulator/progress.h"

namespace dhpmap::simulator {
namespace {

constexpr int kFailed = 1, kUsage = 2;
constexpr int kPlanWidth_px = 1280;

int Fail(const Status& status) {
  std::fprintf(stderr, "dhpmap-simulate: %s\n", status.ToString().c_str());
  return status.code() == StatusCode::kInvalidArgument ? kUsage : kFailed;
}

Status DrawPlan(const std::string& path) {
  const RenderedFrame plan = RenderPlan(kPlanWidth_px);
  return WriteColorPng(path, plan.camera.width_px, plan.color);
}

int Record(const RecordingOptions& options, int num_threads, bool is_quiet) {
  const ApartmentScene scene;
  const int num_frames = options.TotalFrames() - options.first_frame;
  ThreadPool threads(num_threads);
  Progress progress(num_frames, is_quiet);
  const auto views = RecordApartment(scene, options, threads, [&progress] { progress.Step(); });
  if (!views.ok()) return Fail(views.status());
  int num_things = 0;
  for (const Instance& instance : scene.instances()) {
    if (InfoOf(instance.object_class).is_thing && (*views)[instance.id].num_frames > 0) ++num_things;
  }
  std::printf("%s: %d frames of %d x %d, %d things in view\n", options.directory.c_str(), num_frames, options.width_px,
              options.height_px, num_things);
  return 0;
}

int Run(int argc, char** argv) {
  CLI::App app("Records a walk through a furnished apartment: colour, depth, poses, panoptic labels and the truth.",
               "dhpmap-simulate");
  app.set_version_flag("--version", VersionOf("dhpmap-simulate"));
  app.failure_message(ExplainParseError);
  RecordingOptions options;
  std::string directory, plan;
  bool no_noise = false, no_predictions = false, is_quiet = false;
  int num_threads = 0;
  app.add_option("OUT_DIR", directory, "Where the data set goes, in the flat layout")->required();
  app.add_option("--frames", options.num_frames, "Frames on the way through all rooms")->capture_default_str();
  app.add_option("--start", options.first_frame, "Leave out the frames before this one")->capture_default_str();
  app.add_option("--run", options.run, "Folder of the frames in OUT_DIR")->capture_default_str();
  app.add_option("--seed", options.seed, "Other seeds give other noise")->capture_default_str();
  app.add_option("--width", options.width_px, "Pixels")->capture_default_str();
  app.add_option("--height", options.height_px, "Pixels")->capture_default_str();
  app.add_option("--change", options.num_changed,
                 "Walk twice; so many things are moved and as many taken away in between; see changes.json")
      ->capture_default_str();
  app.add_option("--noise", options.noise_level, "How much depth and predictions err, 0 to 5")->capture_default_str();
  app.add_flag("--no-noise", no_noise, "Exact depth");
  app.add_flag("--no-predictions", no_predictions, "Ground truth labels only");
  app.add_flag("--class-scores", options.has_class_scores, "Predictions contain scores of several classes");
  app.add_option("--threads", num_threads, "0 = one a core")->check(CLI::Range(0, 1024))->capture_default_str();
  app.add_option("--plan", plan, "Also draw the apartment from above into this PNG file");
  app.add_flag("--quiet", is_quiet, "No progress");
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : kUsage;
  }
  options.directory = directory;
  options.has_depth_noise = !no_noise;
  options.has_predictions = !no_predictions;
  if (const Status status = options.Validate(); !status.ok()) return Fail(status);
  if (!plan.empty()) {
    if (const Status status = DrawPlan(plan); !status.ok()) return Fail(status);
  }
  return Record(options, num_threads, is_quiet);
}

}  // namespace
}  // namespace dhpmap::simulator

int main(int argc, char** argv) { return dhpmap::simulator::Run(argc, argv); }

// SPDX-License-Identifier: BSD-3-Clause
// dhpmap replay: feeds a server's recording into a new map.
#include <CLI/CLI.hpp>
#include <chrono>
#include <iostream>
#include <optional>
#include <set>
#include <thread>
#include <utility>

#include "clients/cli/connection.h"
#include "clients/cli/map_settings.h"
#include "clients/cli/new_map.h"
#include "clients/cli/replay_edits.h"
#include "clients/cli/replay_streams.h"
#include "clients/cpp/calls/error.h"
#include "proto/types/record_file.h"

namespace dhpmap {
namespace {

struct ReplayOptions {
  std::string file, map;
  std::vector<std::string> settings;
  double rate = 0;
};

struct Counts {
  std::size_t num_sent = 0, num_fused = 0, num_refused = 0, num_skipped = 0, num_finished = 0;
  std::size_t num_edits = 0, num_edits_refused = 0, num_edits_missing = 0;
  std::set<std::string> sessions;
  std::string first_refusal, first_edit_refusal;
  bool is_full = false;
};

Result<v1::CreateMapRequest> RequestOf(const v1::RecordStart& start, const ReplayOptions& options) {
  v1::CreateMapRequest request;
  request.set_map_id(MapName(options.map).substr(std::string("maps/").size()));
  request.set_display_name(start.map().display_name());
  *request.mutable_config() = start.map().config();
  *request.mutable_label_classes() = start.map().label_classes();
  for (const std::string& setting : options.settings) {
    DHPMAP_RETURN_IF_ERROR(ApplySetting(setting, *request.mutable_config()));
  }
  return request;
}

/// Waits so that the replay runs at `rate` times the recorded speed; 0: does not wait.
class Pace {
 public:
  explicit Pace(double rate) : rate_(rate) {}
  void WaitFor(std::int64_t time_ns) {
    if (rate_ <= 0) return;
    if (!first_ns_) first_ns_ = time_ns;
    const std::chrono::duration<double> due(static_cast<double>(time_ns - *first_ns_) / 1e9 / rate_);
    std::this_thread::sleep_until(begin_ + std::chrono::duration_cast<std::chrono::steady_clock::duration>(due));
  }

 private:
  const double rate_;
  const std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
  std::optional<std::int64_t> first_ns_;
};

/// Replays one recording into a map.
class Replay {
 public:
  Replay(RecordReader& reader, const Session& session, ReplayEdits& edits, const ReplayOptions& options, Counts& counts)
      : reader_(reader),
        session_(session),
        edits_(edits),
        map_(MapName(options.map)),
        counts_(counts),
        pace_(options.rate),
        streams_(session.caller, map_, [this](const v1::IntegrateFramesResponse& answer) { Hear(answer); }) {}

  client::Status Run() {
    std::optional<v1::Record> next = Read();
    while (next && status_.ok()) {
      const v1::Record record = *std::exchange(next, Read());
      // Skip frames that were refused: they changed nothing. A frame without a recorded answer, such as after a crash,
      // is sent.
      if (record.has_frame() && next && next->has_refused()) ++counts_.num_skipped;
      else if (record.has_frame()) Send(record);
      else if (record.has_edited()) Edit(record.edited());
      else if (record.has_finished()) FinishAll();
      else if (record.has_full()) counts_.is_full = true;
    }
    return status_.ok() ? streams_.Close() : status_;
  }

 private:
  std::optional<v1::Record> Read() { return reader_.Next().value(); }

  void Send(const v1::Record& record) {
    v1::IntegrateFramesRequest request;
    if (!request.ParseFromString(record.frame().request())) {
      status_ = client::Error(client::StatusCode::kDataLoss, "a recorded message is no frame");
      return;
    }
    pace_.WaitFor(record.time_ns());
    counts_.sessions.insert(record.frame().session());
    ++counts_.num_sent;
    status_ = streams_.Send(record.frame().session(), record.frame().sequence(), std::move(request));
  }

  /// Makes the edit in its order among the frames. A refusal is only reported: with other settings there may be other
  /// objects.
  void Edit(const v1::RecordedEdit& edit) {
    if (!ReplayEdits::Knows(edit)) {
      ++counts_.num_edits_missing;
      return;
    }
    status_ = streams_.Drain();
    if (!status_.ok()) return;
    const client::Status made = edits_.Make(edit);
    if (made.ok()) ++counts_.num_edits;
    else if (made.code == client::StatusCode::kUnavailable) status_ = made;
    else if (counts_.num_edits_refused++ == 0) counts_.first_edit_refusal = made.message;
  }

  void FinishAll() {
    status_ = streams_.Drain();
    v1::FinishMappingRequest request;
    request.set_map(map_);
    if (status_.ok()) status_ = Ask(session_, &v1::MappingService::Stub::FinishMapping, request).status();
    counts_.num_finished += status_.ok();
  }

  void Hear(const v1::IntegrateFramesResponse& answer) {
    if (answer.outcome() == v1::IntegrateFramesResponse::FUSED) ++counts_.num_fused;
    else if (counts_.num_refused++ == 0)
      counts_.first_refusal = answer.outcome() == v1::IntegrateFramesResponse::DUPLICATE
                                  ? "its sequence was taken before"
                                  : answer.error().message();
  }

  RecordReader& reader_;
  const Session& session_;
  ReplayEdits& edits_;
  const std::string map_;
  Counts& counts_;
  Pace pace_;
  ReplayStreams streams_;
  client::Status status_;
};

void Print(const Counts& counts, const RecordReader& reader, const std::string& map) {
  std::cout << "replayed " << counts.num_fused << " frames of " << counts.sessions.size() << " sessions into " << map;
  if (counts.num_finished > 0) std::cout << ", finished " << counts.num_finished << " times";
  std::cout << "\n";
  if (counts.num_skipped > 0) std::cout << counts.num_skipped << " frames were refused then, and are left out\n";
  if (counts.num_refused > 0) {
    std::cout << counts.num_refused << " frames were refused now, the first of them: " << counts.first_refusal << "\n";
  }
  if (counts.num_edits > 0) std::cout << counts.num_edits << " edits were made again in between\n";
  if (counts.num_edits_refused > 0) {
    std::cout << counts.num_edits_refused << " edits were refused now, the first of them: " << counts.first_edit_refusal
              << "\n";
  }
  if (counts.num_edits_missing > 0) {
    std::cout << counts.num_edits_missing << " edits were made in between, which the record lacks\n";
  }
  if (counts.is_full) std::cout << "the record ends where there was no room for more\n";
  if (reader.is_torn()) std::cout << "the record ends with one that was not written as a whole\n";
}

void PrintCountsAsJson(const Counts& counts, const RecordReader& reader) {
  std::cout << "{\"frames\": " << counts.num_fused << ", \"refused\": " << counts.num_refused
            << ", \"leftOut\": " << counts.num_skipped << ", \"sessions\": " << counts.sessions.size()
            << ", \"edits\": " << counts.num_edits << ", \"editsRefused\": " << counts.num_edits_refused
            << ", \"editsMissing\": " << counts.num_edits_missing << ", \"finished\": " << counts.num_finished
            << ", \"full\": " << (counts.is_full ? "true" : "false")
            << ", \"torn\": " << (reader.is_torn() ? "true" : "false") << "}\n";
}

ExitCode RunReplay(const Session& session, const ReplayOptions& options) {
  auto reader = RecordReader::Open(options.file);
  if (!reader.ok()) return ReportLocalError(reader.status().message());
  const auto request = RequestOf(reader->start(), options);
  if (!request.ok()) return ReportLocalError(request.status().message(), ExitCode::kUsage);
  if (const std::int64_t num_before = reader->start().map().num_frames(); num_before > 0) {
    std::cerr << "dhpmap: the record goes on from a map of " << num_before << " frames, which it lacks\n";
  }
  client::Status status = Ask(session, &v1::MapService::Stub::CreateMap, *request).status();
  if (!status.ok()) return ReportError(session, status);
  Counts counts;
  ReplayEdits edits(session.caller, reader->start().map().name(), MapName(options.map));
  status = edits.KeepClear(reader->start());
  if (status.ok()) status = Replay(*reader, session, edits, options, counts).Run();
  if (session.json) PrintCountsAsJson(counts, *reader);
  else Print(counts, *reader, MapName(options.map));
  if (!status.ok()) return ReportError(session, status);
  return counts.num_refused + counts.num_edits_refused > 0 ? ExitCode::kPartly : ExitCode::kOk;
}

}  // namespace

void AddReplayCommand(CLI::App& app, Session& session) {
  auto options = std::make_shared<ReplayOptions>();
  CLI::App* command = app.add_subcommand("replay", "Feed a server's recording (mapping.record_dir) into a new map");
  command->add_option("file", options->file, "The record")->required();
  command->add_option("--map", options->map, "Name of the map, which must not be there")->required();
  command->add_option("--set", options->settings, "KEY=VALUE in place of the recorded map's, may be repeated")
      ->allow_extra_args(false);
  command->add_option("--rate", options->rate, "So many times as fast as it came; 0: as fast as the server takes it")
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str();
  command->callback([options, &session] { session.exit_code = RunReplay(session, *options); });
}

}  // namespace dhpmap

// SPDX-License-Identifier: BSD-3-Clause
#include "server/record/map_recorder.h"

#include <chrono>
#include <exception>
#include <utility>

#include "mapping/base/utf8.h"
#include "server/wire/edit_conversion.h"
#include "server/wire/map_conversion.h"

namespace dhpmap {
namespace {

std::int64_t SystemNow() {
  const auto now = std::chrono::system_clock::now().time_since_epoch();
  return std::chrono::duration_cast<std::chrono::nanoseconds>(now).count();
}

class MapRecorder final : public FrameRecorder {
 public:
  MapRecorder(std::string map, RecordDir& dir, RecordWriter writer, RecorderOptions options)
      : map_(std::move(map)), dir_(dir), writer_(std::move(writer)), options_(std::move(options)) {}

  void Start(const MapInfo& map) {
    Write([&](v1::Record& record) {
      v1::RecordStart& start = *record.mutable_start();
      *start.mutable_map() = ToProto(MapSummary{.info = map});
      start.set_server_version(DHPMAP_VERSION);
      start.set_is_reproducible(options_.is_reproducible);
      for (const KeptClearRegion& region : map.kept_clear.list()) *start.add_ignored_regions() = ToProto(region);
    });
  }
  void OnFrame(const std::string& session, std::int64_t sequence, ArrivedMessage message,
               std::int64_t num_frames) override {
    Write([&](v1::Record& record) {
      record.set_time_ns(message.arrived_ns);
      v1::RecordedFrame& frame = *record.mutable_frame();
      frame.set_session(session);
      frame.set_sequence(sequence);
      frame.set_request(std::move(message.bytes));
      frame.set_num_frames(num_frames);
    });
  }
  void OnRefused(const Status& why) override {
    Write([&](v1::Record& record) {
      record.mutable_refused()->set_code(static_cast<int>(why.code()));
      record.mutable_refused()->set_message(ToValidUtf8(why.message()));
    });
  }
  void OnRefined() override {
    Write([](v1::Record& record) { record.mutable_refined(); });
  }
  void OnEdited(std::int64_t revision, const ArrivedEdit& edit) override {
    Write([&](v1::Record& record) {
      v1::RecordedEdit& edited = *record.mutable_edited();
      edited.set_revision(revision);
      edited.set_method(edit.method);
      edited.set_request(edit.bytes);
    });
  }
  void OnFinished() override {
    Write([](v1::Record& record) { record.mutable_finished(); });
  }

 private:
  /// Its failures never reach the map.
  template <typename Fill>
  void Write(Fill&& fill) {
    if (has_stopped_) return;
    try {
      v1::Record record;
      record.set_time_ns(options_.now_ns());
      fill(record);
      if (!dir_.Take(BytesInFile(record))) return Stop(true, "the folder of records is full");
      if (const Status written = writer_.Append(record); !written.ok()) Stop(false, written.message());
    } catch (const std::exception& error) {
      Stop(false, error.what());
    }
  }

  void Stop(bool is_full, const std::string& why) {
    has_stopped_ = true;
    if (is_full) {
      v1::Record last;
      last.set_time_ns(options_.now_ns());
      last.mutable_full();
      (void)writer_.Append(last);  // a few bytes above the limit
    }
    if (options_.on_stopped) options_.on_stopped("no more frames of map '" + map_ + "' are recorded: " + why);
  }

  const std::string map_;
  RecordDir& dir_;
  RecordWriter writer_;
  const RecorderOptions options_;
  bool has_stopped_ = false;
};

}  // namespace

std::unique_ptr<FrameRecorder> RecordMap(const MapInfo& map, RecordDir& dir, RecorderOptions options) {
  if (!options.now_ns) options.now_ns = SystemNow;
  const auto tell = options.on_stopped;
  std::string why;
  try {
    auto writer = dir.Begin(map.name, options.now_ns());
    if (writer.ok()) {
      auto recorder = std::make_unique<MapRecorder>(map.name, dir, *std::move(writer), std::move(options));
      recorder->Start(map);
      return recorder;
    }
    why = writer.status().message();
  } catch (const std::exception& error) {
    why = error.what();
  }
  if (tell) tell("map '" + map.name + "' is not recorded: " + why);
  return nullptr;
}

}  // namespace dhpmap

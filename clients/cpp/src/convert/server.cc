// SPDX-License-Identifier: BSD-3-Clause
#include "clients/cpp/src/convert/server.h"

#include <string_view>

namespace dhpmap::client {
namespace {

ServerStatus::Time TimeOf(const google::protobuf::Timestamp& time) {
  const auto since = std::chrono::seconds(time.seconds()) + std::chrono::nanoseconds(time.nanos());
  return ServerStatus::Time(std::chrono::duration_cast<ServerStatus::Time::duration>(since));
}

ActiveFeed FeedOf(const v1::ActiveFeed& proto) {
  ActiveFeed feed{.silent_s = proto.silent_s(),
                  .num_frames = proto.num_frames(),
                  .num_refused = proto.num_refused(),
                  .frames_per_s = proto.frames_per_s(),
                  .num_implausible = proto.num_implausible(),
                  .num_plausible_since = proto.num_plausible_since()};
  if (proto.has_last_warning()) {
    feed.last_fault = v1::FrameWarning::Fault_Name(proto.last_warning().fault());
    feed.last_warning = proto.last_warning().message();
  }
  constexpr std::string_view kMaps = "maps/", kSessions = "/sessions/";
  const std::string& name = proto.name();
  const std::size_t sessions = name.find(kSessions);
  if (!name.starts_with(kMaps) || sessions == std::string::npos) return feed;
  feed.map = name.substr(kMaps.size(), sessions - kMaps.size());
  feed.session = name.substr(sessions + kSessions.size());
  return feed;
}

}  // namespace

ServerStatus FromProto(const v1::GetServerStatusResponse& proto) {
  ServerStatus status{.version = proto.version(),
                      .is_ready = proto.ready(),
                      .time = TimeOf(proto.current_time()),
                      .start_time = TimeOf(proto.start_time()),
                      .database_bytes = proto.database_bytes(),
                      .disk_free_bytes = proto.disk_free_bytes(),
                      .disk_total_bytes = proto.disk_total_bytes(),
                      .behind_s = proto.behind_s(),
                      .max_behind_s = proto.max_behind_s()};
  for (const v1::ActiveFeed& feed : proto.feeds()) status.feeds.push_back(FeedOf(feed));
  return status;
}

}  // namespace dhpmap::client

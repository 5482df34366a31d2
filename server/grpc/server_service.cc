// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <chrono>
#include <filesystem>
#include <string>

#include "dhpmap/v1/server_service.grpc.pb.h"
#include "server/grpc/counted_service.h"
#include "server/grpc/services.h"
#include "server/wire/mapping_conversion.h"

namespace dhpmap {
namespace {

namespace fs = std::filesystem;

constexpr std::int64_t kSecond_ns = 1'000'000'000;

std::int64_t UtcNow_ns() {
  const auto now = std::chrono::system_clock::now().time_since_epoch();
  return std::chrono::duration_cast<std::chrono::nanoseconds>(now).count();
}

void SetTime(std::int64_t time_ns, google::protobuf::Timestamp& time) {
  time.set_seconds(time_ns / kSecond_ns);
  time.set_nanos(static_cast<int>(time_ns % kSecond_ns));
}

/// 0 if the file does not exist.
std::int64_t FileBytes(const std::string& path) {
  std::error_code error;
  const auto size = fs::file_size(path, error);
  return error ? 0 : static_cast<std::int64_t>(size);
}

void TellDisk(const std::string& database, v1::GetServerStatusResponse& response) {
  response.set_database_bytes(FileBytes(database) + FileBytes(database + "-wal"));
  std::error_code error;
  const fs::space_info space = fs::space(database, error);
  response.set_disk_free_bytes(error ? -1 : static_cast<std::int64_t>(space.available));
  response.set_disk_total_bytes(error ? -1 : static_cast<std::int64_t>(space.capacity));
}

void TellFeed(const std::string& map, const SessionStatus& session, std::int64_t now_ns, v1::ActiveFeed& feed) {
  feed.set_name("maps/" + map + "/sessions/" + session.session);
  const FeedCounts& counts = session.counts;
  if (counts.last_seen_ns > 0) {
    feed.set_silent_s(std::max(0.0, static_cast<double>(now_ns - counts.last_seen_ns) / kSecond_ns));
  }
  feed.set_num_frames(counts.num_fused);
  feed.set_num_refused(counts.num_refused);
  feed.set_frames_per_s(counts.frames_per_s);
  feed.set_num_implausible(counts.num_implausible);
  if (counts.last_warning) *feed.mutable_last_warning() = ToProto(*counts.last_warning);
  feed.set_num_plausible_since(counts.num_plausible_since);
}

class ServerService final : public CountedService<v1::ServerService> {
 public:
  explicit ServerService(const ServiceContext& context) : CountedService(context), context_(context) {
    Take(&ServerService::GetServerStatus);
  }

  grpc::ServerUnaryReactor* GetServerStatus(grpc::CallbackServerContext* call,
                                            const v1::GetServerStatusRequest* request,
                                            v1::GetServerStatusResponse* response) override {
    return Run(context_, {"ServerService/GetServerStatus", request, response},
               [=, this, caller = CallerOf(*call)]() -> Status {
                 Tell(caller, *response);
                 return Status::Ok();
               });
  }

 private:
  void Tell(const Caller& caller, v1::GetServerStatusResponse& response) const {
    const std::int64_t now_ns = UtcNow_ns();
    double behind_s = 0;
    for (const auto& open_map : context_.registry.OpenMaps()) {
      behind_s = std::max(behind_s, open_map->BehindSeconds());
      const std::string map = open_map->View()->snapshot().info().name;
      if (!caller.MaySee(map) || open_map->num_feeds() == 0) continue;
      for (const SessionStatus& session : open_map->Sessions()) {
        if (session.is_feeding) TellFeed(map, session, now_ns, *response.add_feeds());
      }
    }
    const GrpcOptions& options = context_.options;
    response.set_version(options.version);
    response.set_behind_s(behind_s);
    response.set_max_behind_s(options.max_behind_s);
    response.set_ready(context_.is_serving != nullptr && *context_.is_serving && behind_s <= options.max_behind_s);
    SetTime(start_ns_, *response.mutable_start_time());
    TellDisk(options.database, response);
    SetTime(UtcNow_ns(), *response.mutable_current_time());
  }

  const ServiceContext& context_;
  const std::int64_t start_ns_ = UtcNow_ns();
};

}  // namespace

std::unique_ptr<grpc::Service> MakeServerService(const ServiceContext& context) {
  return std::make_unique<ServerService>(context);
}

}  // namespace dhpmap

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <grpcpp/alarm.h>
#include <grpcpp/support/server_callback.h>

#include <memory>
#include <stop_token>

#include "dhpmap/v1/map_service.pb.h"
#include "mapping/base/mutex.h"
#include "server/app/maps/map_import.h"
#include "server/base/byte_budget.h"
#include "server/grpc/call_runner.h"
#include "server/grpc/client_lag.h"
#include "server/grpc/door_call.h"
#include "server/grpc/map_quota.h"

namespace dhpmap {

/// A client's upload of a map file. The next part is read once the previous one is on disk, so parts never pile up:
/// gRPC's flow control holds the client back. The work runs on the bulk lane. The last step runs on the quick lane,
/// because other maps' commits wait for it and a low-priority thread would delay them. The upload ends if the client
/// disconnects or falls too far behind the minimum rate. Owns itself: lives until gRPC is done with the call and no
/// task uses it.
class ImportStream final : public grpc::ServerReadReactor<grpc::ByteBuffer> {
 public:
  static ImportStream* Start(const ServiceContext& context, Caller caller, v1::ImportMapResponse* response);

  void OnReadDone(bool ok) override;
  void OnCancel() override;
  void OnDone() override;

 private:
  using Clock = ClientLag::Clock;
  /// Room for a part of the file, and the buffers that read and write it.
  static constexpr std::size_t kKept_bytes = 1u << 20;

  ImportStream(const ServiceContext& context, Caller caller, v1::ImportMapResponse* response)
      : context_(context),
        caller_(std::move(caller)),
        response_(response),
        record_(context, "MapService/ImportMap"),
        share_(&BudgetHere(*context.options.inflight)) {}

  void Read() DHPMAP_EXCLUDES(mutex_);
  /// Checks for a silent client after this time.
  void Watch(Clock::duration after) DHPMAP_REQUIRES(mutex_);
  void OnAlarm() DHPMAP_EXCLUDES(mutex_);

  /// Makes `request_` of the bytes just read, if there is room for it.
  Status TakeMessage();
  // These run on the lanes.
  Status TakePart();
  void Prepare();
  void Show();

  /// Called by the task that works on the stream.
  void End(const Status& status) DHPMAP_EXCLUDES(mutex_);
  /// Runs after the end: deletes what was stored of the file before the client receives the status.
  void LetGo(const Status& status);

  const ServiceContext& context_;
  const Caller caller_;
  v1::ImportMapResponse* const response_;
  CallRecord record_;
  ByteShare share_;  ///< of the part that was read; empty before the first
  std::shared_ptr<ImportStream> self_;
  std::stop_source stop_;

  // Used by gRPC while it reads, else by the task that works on the part.
  grpc::ByteBuffer arrived_;
  v1::ImportMapRequest request_;
  std::unique_ptr<MapQuota::Making> making_;  ///< null before the first message, and without keys
  std::unique_ptr<IncomingMap> incoming_;     ///< null before the first message
  std::string map_id_;

  Mutex mutex_;
  bool is_reading_ DHPMAP_GUARDED_BY(mutex_) = false;
  bool is_over_ DHPMAP_GUARDED_BY(mutex_) = false;
  ClientLag lag_ DHPMAP_GUARDED_BY(mutex_);
  std::unique_ptr<grpc::Alarm> alarm_ DHPMAP_GUARDED_BY(mutex_);
};

}  // namespace dhpmap

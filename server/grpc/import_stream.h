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

/// One client's file with a map. The next part is read once the one before is on the disk, so none pile up: gRPC's flow
/// control holds the client back. All of it is done on the bulk lane but for the last step, which other maps' commits
/// wait for: that is the quick lane's, as a thread that is nice would keep them waiting for a core. A client that goes
/// away, or gets too far behind the least rate, ends it. Owns itself: lives until gRPC is done with the call and
/// nobody uses it.
class ImportStream final : public grpc::ServerReadReactor<grpc::ByteBuffer> {
 public:
  static ImportStream* Start(const ServiceContext& context, Caller caller, v1::ImportMapResponse* response);

  void OnReadDone(bool ok) override;
  void OnCancel() override;
  void OnDone() override;

 private:
  using Clock = ClientLag::Clock;
  /// A part of the file, and what is read and written of it at a time.
  static constexpr std::size_t kKept_bytes = 1u << 20;

  ImportStream(const ServiceContext& context, Caller caller, v1::ImportMapResponse* response)
      : context_(context),
        caller_(std::move(caller)),
        response_(response),
        record_(context, "MapService/ImportMap"),
        share_(&BudgetHere(*context.options.inflight)) {}

  void Read() DHPMAP_EXCLUDES(mutex_);
  /// Looks again whether the client is silent when it may be so.
  void Watch(Clock::duration after) DHPMAP_REQUIRES(mutex_);
  void OnAlarm() DHPMAP_EXCLUDES(mutex_);

  /// Makes `request_` of the bytes just read, if there is room for it.
  Status TakeMessage();
  // On the lanes.
  Status TakePart();
  void Prepare();
  void Show();

  /// By whoever works on it.
  void End(const Status& status) DHPMAP_EXCLUDES(mutex_);
  /// Once it is over: what is kept of the file is gone before the client knows.
  void LetGo(const Status& status);

  const ServiceContext& context_;
  const Caller caller_;
  v1::ImportMapResponse* const response_;
  CallRecord record_;
  ByteShare share_;  ///< of the part that was read; nothing before the first
  std::shared_ptr<ImportStream> self_;
  std::stop_source stop_;

  // Of gRPC while it reads, else of the one who works on it.
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

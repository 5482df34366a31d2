// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <grpcpp/alarm.h>
#include <grpcpp/support/server_callback.h>

#include <functional>
#include <memory>
#include <set>
#include <stop_token>
#include <string_view>

#include "dhpmap/v1/query_service.pb.h"
#include "mapping/base/byte_budget.h"
#include "mapping/base/mutex.h"
#include "server/grpc/call_runner.h"
#include "server/grpc/map_pin.h"

namespace dhpmap {

class QueryStream;

/// The streams of queries that are open, so that a shutdown can end them. Thread-safe.
class QueryStreams {
 public:
  /// Ends every stream once it has answered what it has read, and those that come later, with UNAVAILABLE.
  void StopAll() DHPMAP_EXCLUDES(mutex_);

 private:
  friend class QueryStream;
  /// False if it is too late.
  bool Add(QueryStream* stream) DHPMAP_EXCLUDES(mutex_);
  void Remove(QueryStream* stream) DHPMAP_EXCLUDES(mutex_);

  Mutex mutex_;
  std::set<QueryStream*> streams_ DHPMAP_GUARDED_BY(mutex_);
  bool is_stopped_ DHPMAP_GUARDED_BY(mutex_) = false;
};

/// One client's stream of queries, answered one by one in their order, each in the lane that it would be in as a call
/// of its own. The next is read once the answer before it is on its way, so none pile up here: gRPC's flow control
/// holds the client back. Deletes itself when the call is over.
class QueryStream final : public grpc::ServerBidiReactor<v1::QueryStreamRequest, v1::QueryStreamResponse> {
 public:
  static QueryStream* Start(const ServiceContext& context, QueryStreams& streams);

  /// Reads no more, and ends with `reason` once what was read is answered.
  void Stop(const Status& reason) DHPMAP_EXCLUDES(mutex_);

  void OnReadDone(bool ok) override;
  void OnWriteDone(bool ok) override;
  void OnCancel() override { stop_.request_stop(); }
  void OnDone() override;

 private:
  QueryStream(const ServiceContext& context, QueryStreams& streams)
      : context_(context),
        streams_(streams),
        record_(context, "QueryService/QueryStream"),
        share_(context.options.inflight.get()) {}

  void Read() DHPMAP_EXCLUDES(mutex_);
  void ReadLater();
  void ReadIfThereIsRoom();
  [[nodiscard]] bool IsToEnd() DHPMAP_EXCLUDES(mutex_);
  void End(const Status& status) DHPMAP_REQUIRES(mutex_);

  /// The message just read, whichever query it holds.
  void Handle();
  template <typename Request, typename Response>
  void Handle(const Request& request, Response& response);
  Status HandlePin();
  /// Answers with what `work`, done in a lane, returns.
  void AnswerInLane(bool is_quick, std::string_view opens, const std::function<Status()>& work);
  void Answer(const Status& status);

  const ServiceContext& context_;
  QueryStreams& streams_;
  CallRecord record_;
  ByteShare share_;  ///< of the request and its answer
  std::stop_source stop_;
  MapPin pin_;

  // Of gRPC while it reads or writes, else of the one who answers.
  v1::QueryStreamRequest request_;
  v1::QueryStreamResponse response_;
  bool has_had_no_room_ = false;  ///< for the last answer
  std::size_t last_bytes_ = 0;    ///< of the last question
  std::unique_ptr<grpc::Alarm> pause_;

  Mutex mutex_;
  bool is_reading_ DHPMAP_GUARDED_BY(mutex_) = false;
  bool is_over_ DHPMAP_GUARDED_BY(mutex_) = false;
  Status reason_ DHPMAP_GUARDED_BY(mutex_);  ///< not OK: no more is read
};

}  // namespace dhpmap

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <grpcpp/alarm.h>
#include <grpcpp/support/server_callback.h>

#include <functional>
#include <memory>
#include <stop_token>
#include <string_view>

#include "dhpmap/v1/query_service.pb.h"
#include "mapping/base/mutex.h"
#include "server/grpc/call_runner.h"
#include "server/grpc/door_call.h"
#include "server/grpc/map_pin.h"
#include "server/grpc/open_streams.h"
#include "server/grpc/room_ahead.h"

namespace dhpmap {

/// A client's stream of queries. They are answered in order, each on the lane that it would use as a unary call. The
/// next query is read once the previous answer is being written, so queries never pile up: gRPC's flow control holds
/// the client back. Messages arrive as bytes and are parsed once they fit into the budget. After an answer that did not
/// fit, the stream reserves room before it reads on. Bytes that are no message end the stream. Deletes itself when the
/// call is over.
class QueryStream final : public grpc::ServerBidiReactor<grpc::ByteBuffer, v1::StreamQueriesResponse>,
                          public OpenStream {
 public:
  static QueryStream* Start(const ServiceContext& context, Caller caller, OpenStreams& streams);

  /// Reads no more, and ends with `reason` once what was read is answered.
  void Stop(const Status& reason) override DHPMAP_EXCLUDES(mutex_);

  void OnReadDone(bool ok) override;
  void OnWriteDone(bool ok) override;
  void OnCancel() override { stop_.request_stop(); }
  void OnDone() override;

 private:
  QueryStream(const ServiceContext& context, Caller caller, OpenStreams& streams)
      : context_(context),
        caller_(std::move(caller)),
        streams_(streams),
        record_(context, "QueryService/StreamQueries"),
        budget_(caller_.budget() != nullptr ? caller_.budget() : context.options.inflight),
        room_(std::make_shared<RoomAhead>(budget_)) {}

  void Read() DHPMAP_EXCLUDES(mutex_);
  void ReadLater();
  void ReadIfThereIsRoom();
  /// Returns the room reserved for the next question, unless the question comes soon.
  void GiveRoomBackLater();
  [[nodiscard]] bool IsToEnd() DHPMAP_EXCLUDES(mutex_);
  void End(const Status& status) DHPMAP_REQUIRES(mutex_);

  /// Makes `request_` of the bytes just read, if there is room for it.
  Status TakeMessage();
  /// Answers the last message, whatever query it holds.
  void Handle();
  template <typename Request, typename Response>
  void Handle(const Request& request, Response& response);
  /// The same for a query that is answered in pieces.
  template <typename Request, typename Response>
  void HandleCheck(const Request& request, Response& response);
  /// The state that a message is answered from.
  template <typename Request>
  Result<std::shared_ptr<const MapView>> ViewOf(const Request& request);
  Status HandlePin();
  /// Answers with the result of `work`, which runs on a lane.
  void AnswerInLane(bool is_quick, std::string_view opens, const std::function<Status()>& work);
  void Answer(const Status& status);

  const ServiceContext& context_;
  const Caller caller_;
  OpenStreams& streams_;
  CallRecord record_;
  const std::shared_ptr<ByteBudget> budget_;
  const std::shared_ptr<RoomAhead> room_;  ///< of the request and its answer; shared with an alarm
  std::stop_source stop_;
  MapPin pin_;

  // Used by gRPC while it reads or writes, else by the task that answers.
  grpc::ByteBuffer incoming_;
  v1::StreamQueriesRequest request_;
  v1::StreamQueriesResponse response_;
  bool has_had_no_room_ = false;    ///< for the last answer
  std::size_t question_bytes_ = 0;  ///< of the last question
  std::size_t wanted_bytes_ = 0;    ///< for the last question and its answer
  int num_pauses_ = 0;              ///< since the last question was refused
  std::unique_ptr<grpc::Alarm> pause_;

  Mutex mutex_;
  bool is_reading_ DHPMAP_GUARDED_BY(mutex_) = false;
  bool is_over_ DHPMAP_GUARDED_BY(mutex_) = false;
  Status reason_ DHPMAP_GUARDED_BY(mutex_);  ///< not OK: reading has ended
};

}  // namespace dhpmap

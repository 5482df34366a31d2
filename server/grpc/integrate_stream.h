// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <grpcpp/support/server_callback.h>

#include <deque>
#include <memory>
#include <optional>
#include <set>
#include <string>

#include "dhpmap/v1/mapping_service.pb.h"
#include "mapping/base/byte_budget.h"
#include "mapping/base/mutex.h"
#include "server/app/map_session.h"
#include "server/grpc/call_runner.h"
#include "server/grpc/stream_turns.h"

namespace dhpmap {

class IntegrateStream;

/// The streams of frames that are open, so that a shutdown can end them, and what their frames hold in memory.
/// Thread-safe.
class IntegrateStreams {
 public:
  /// Frames have room of their own, so that no other call can take it from a robot: `max_frame_bytes` for all streams.
  explicit IntegrateStreams(std::size_t max_frame_bytes) : frame_bytes_(max_frame_bytes) {}

  /// Ends every stream, and those that come later, with UNAVAILABLE: see IntegrateStream::Stop.
  void StopAll() DHPMAP_EXCLUDES(mutex_);

 private:
  friend class IntegrateStream;
  /// False if it is too late.
  bool Add(IntegrateStream* stream) DHPMAP_EXCLUDES(mutex_);
  void Remove(IntegrateStream* stream) DHPMAP_EXCLUDES(mutex_);

  ByteBudget frame_bytes_;
  Mutex mutex_;
  std::set<IntegrateStream*> streams_ DHPMAP_GUARDED_BY(mutex_);
  bool is_stopped_ DHPMAP_GUARDED_BY(mutex_) = false;
};

/// One client's stream of frames. Reads a message only while fewer than `max_frames_in_flight` frames are read and not
/// yet acknowledged to the client, so that neither frames nor acknowledgements pile up: gRPC's flow control then holds
/// the client back. Frames are decoded on the lane for frames while the map's writer fuses those before them. Whose
/// turn it is says StreamTurns. When the client has no more, everything is stored before the last answer: that is one
/// for no frame in a session; else the last frame's, if the client had half-closed by the time it was fused. A frame
/// for which there is no room in memory is refused like any that cannot be fused. Owns itself:
/// lives until gRPC is done with the call and no callback is left.
class IntegrateStream final : public grpc::ServerBidiReactor<v1::IntegrateFramesRequest, v1::IntegrateFramesResponse> {
 public:
  /// How many messages the client will send.
  enum class Messages {
    kAny,
    kOne,  ///< then there is one answer, when all is stored, or the error that refuses it
  };

  static IntegrateStream* Start(const ServiceContext& context, IntegrateStreams& streams, Messages messages);

  /// Reads no more; what was read is fused (or refused, if the map takes no more from us), stored and acknowledged,
  /// then the stream ends with `reason`.
  void Stop(const Status& reason) DHPMAP_EXCLUDES(mutex_);

  void OnReadDone(bool ok) override;
  void OnWriteDone(bool ok) override;
  void OnDone() override;

 private:
  using Ack = v1::IntegrateFramesResponse;
  /// A map that is open, and our turn at feeding it.
  struct Place {
    std::shared_ptr<MapSession> map;
    std::shared_ptr<Feed> feed;
  };

  IntegrateStream(const ServiceContext& context, IntegrateStreams& streams, Messages messages)
      : context_(context),
        streams_(streams),
        messages_(messages),
        record_(context, "MappingService/IntegrateFrames"),
        arrived_(&streams.frame_bytes_),
        turns_(context.options.max_frames_in_flight) {}

  /// Accounts for the message just read; one that there is no room for loses its frame at once.
  void TakeRoomForRequest();
  /// The frame of the message just read, with its room until it is fused.
  /// The frame of the message just read, or why there is none; `share` grows by what it takes.
  ArrivedFrame Decode(bool is_recorded, ByteShare& share);
  /// The message just read: takes a place at the map if it is the first, and hands its frame to the writer.
  void HandleRequest() DHPMAP_EXCLUDES(mutex_);
  /// The place that the message just read is for: taken by the first message.
  Result<Place> PlaceForRequest() DHPMAP_EXCLUDES(mutex_);
  Result<Place> TakePlace() DHPMAP_EXCLUDES(mutex_);
  /// INVALID_ARGUMENT unless a later message is for the same map and session as the first.
  [[nodiscard]] Status CheckSamePlace() const DHPMAP_REQUIRES(mutex_);

  void OnFrameDone(std::int64_t sequence, const FrameOutcome& outcome) DHPMAP_EXCLUDES(mutex_);
  /// The answer to a message: goes to the client, or is kept for the end.
  void Answer(Ack ack) DHPMAP_EXCLUDES(mutex_);
  /// Whether the next answer to a message is kept as the stream's last one.
  [[nodiscard]] bool IsLastAnswer() const DHPMAP_REQUIRES(mutex_);

  /// Asks for no more messages, because of `reason`; the first reason counts.
  void StopReading(const Status& reason) DHPMAP_REQUIRES(mutex_);
  void Do(StreamTurns::Todo todo) DHPMAP_REQUIRES(mutex_);

  void CommitAndEnd() DHPMAP_EXCLUDES(mutex_);
  void End(const Status& committed) DHPMAP_EXCLUDES(mutex_);

  const ServiceContext& context_;
  IntegrateStreams& streams_;
  const Messages messages_;
  CallRecord record_;
  std::shared_ptr<IntegrateStream> self_;  ///< until OnDone

  // Between StartRead and the end of HandleRequest: of the one who handles it.
  v1::IntegrateFramesRequest request_;
  ByteShare arrived_;          ///< what request_ holds
  std::size_t num_bytes_ = 0;  ///< of request_, as it came
  bool has_no_room_ = false;   ///< request_ had a frame, which was too much
  bool is_first_ = true;

  Ack conclusion_;  ///< the last answer; made by End, then gRPC's

  mutable Mutex mutex_;
  StreamTurns turns_ DHPMAP_GUARDED_BY(mutex_);
  std::string map_name_ DHPMAP_GUARDED_BY(mutex_);
  std::optional<Place> place_ DHPMAP_GUARDED_BY(mutex_);
  std::deque<Ack> acks_ DHPMAP_GUARDED_BY(mutex_);  ///< the first is being written if turns_ says so
  Ack last_ DHPMAP_GUARDED_BY(mutex_);              ///< what the last answer is made of
  bool is_kept_ DHPMAP_GUARDED_BY(mutex_) = false;  ///< it is the answer to a message, which has had none yet
  Status end_status_ DHPMAP_GUARDED_BY(mutex_);     ///< why reading ended; OK: the client has no more
};

}  // namespace dhpmap

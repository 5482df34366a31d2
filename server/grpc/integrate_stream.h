// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <grpcpp/support/byte_buffer.h>
#include <grpcpp/support/server_callback.h>

#include <deque>
#include <memory>
#include <optional>
#include <string>

#include "dhpmap/v1/mapping_service.pb.h"
#include "mapping/base/mutex.h"
#include "server/app/open_map/open_map.h"
#include "server/base/byte_budget.h"
#include "server/base/lane.h"
#include "server/grpc/call_runner.h"
#include "server/grpc/door_call.h"
#include "server/grpc/open_streams.h"
#include "server/grpc/stream_turns.h"

namespace dhpmap {

/// The streams of frames that are open, so that a shutdown can end them, and what their frames hold in memory.
/// Thread-safe.
class IntegrateStreams : public OpenStreams {
 public:
  /// Frames have room of their own, so that no other call can take it from a robot: `max_frame_bytes` for all streams.
  explicit IntegrateStreams(std::size_t max_frame_bytes) : frame_bytes_(max_frame_bytes) {}

  /// What their frames hold now.
  [[nodiscard]] std::size_t frame_bytes() const { return frame_bytes_.used_bytes(); }

 private:
  friend class IntegrateStream;
  ByteBudget frame_bytes_;
};

/// One client's stream of frames. Reads a message only while fewer than `max_frames_in_flight` frames are read and not
/// yet acknowledged to the client, so that neither frames nor acknowledgements pile up: gRPC's flow control then holds
/// the client back. Messages come as bytes, and are parsed and decoded on a lane of nice threads while the map's writer
/// fuses those before them; what they bring about is done on the lane for frames. Decoded is only what has room and a
/// place at its map, and what waits for that is given up when its client is gone or the stream is stopped: else clients
/// that begin ever new streams would fill that lane for all others. Whose turn it is says StreamTurns.
/// When the client has no more, everything is stored before the last answer: that is one for no frame in a session;
/// else the last frame's, if the client had half-closed by the time it was fused. A frame for which there is no room in
/// memory is refused like any that cannot be fused; bytes that are no message end the stream. Owns itself: lives until
/// gRPC is done with the call and no callback is left.
class IntegrateStream final : public grpc::ServerBidiReactor<grpc::ByteBuffer, grpc::ByteBuffer>, public OpenStream {
 public:
  /// How many messages the client will send.
  enum class Messages {
    kAny,
    kOne,  ///< then there is one answer, when all is stored, or the error that refuses it
  };

  static IntegrateStream* Start(const ServiceContext& context, Caller caller, IntegrateStreams& streams,
                                Messages messages);

  /// Reads no more; what was read is fused (or refused, if the map takes no more from us), stored and acknowledged,
  /// then the stream ends with `reason`.
  void Stop(const Status& reason) override DHPMAP_EXCLUDES(mutex_);

  void OnReadDone(bool ok) override;
  void OnWriteDone(bool ok) override;
  void OnCancel() override;
  void OnDone() override;

 private:
  using Ack = v1::IntegrateFramesResponse;
  /// A map that is open, and our turn at feeding it.
  struct Place {
    std::shared_ptr<OpenMap> map;
    std::shared_ptr<Feed> feed;
  };

  IntegrateStream(const ServiceContext& context, Caller caller, IntegrateStreams& streams, Messages messages)
      : context_(context),
        caller_(std::move(caller)),
        streams_(streams),
        messages_(messages),
        record_(context, "MappingService/IntegrateFrames"),
        arrived_(&streams.frame_bytes_),
        turns_(context.options.max_frames_in_flight) {}

  /// `request_` but for its frame, in next to no time. Of a message for which there is no room no more is kept.
  Status ParseHead();
  /// Takes a place at the map if the message just read is the first. Then it is handled, or decoded before that.
  Status Begin(bool& is_decoded_later) DHPMAP_EXCLUDES(mutex_);
  Status DecodeLater() DHPMAP_EXCLUDES(mutex_);
  /// Of the message just read, on a nice thread: `frame_`, or why there is none.
  Status DecodeMessage();
  /// INVALID_ARGUMENT if the message is none.
  Status Parse();
  Result<PanopticFrame> DecodeFrame();
  /// The frame of the message just read, on its way to the writer, with its bytes if they are to be kept.
  ArrivedFrame TakeFrame();
  /// Nothing of the message just read is kept while the stream waits.
  void ForgetMessage();
  /// Hands the frame of the message just read to the writer.
  void HandleRequest() DHPMAP_EXCLUDES(mutex_);
  /// The message just read is done with. If not OK no more are read.
  void EndMessage(const Status& status) DHPMAP_EXCLUDES(mutex_);
  /// Ends the message just read if it waits to be decoded.
  void GiveUpDecoding(const Status& why) DHPMAP_EXCLUDES(mutex_);
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
  const Caller caller_;
  IntegrateStreams& streams_;
  const Messages messages_;
  CallRecord record_;
  std::shared_ptr<IntegrateStream> self_;  ///< until OnDone

  // Between StartRead and EndMessage: of the one who handles it.
  grpc::ByteBuffer incoming_;
  v1::IntegrateFramesRequest request_;          ///< that as a message; without its frame once this is decoded
  ByteShare arrived_;                           ///< what both hold
  std::size_t num_bytes_ = 0;                   ///< of the message, as it came
  bool has_frame_ = false;                      ///< the message
  bool has_no_room_ = false;                    ///< for it
  bool is_recorded_ = false;                    ///< what the map takes
  std::optional<Result<PanopticFrame>> frame_;  ///< decoded
  std::shared_ptr<ByteShare> room_;             ///< of frame_; until it is fused
  bool is_first_ = true;

  Ack conclusion_;             ///< the last answer; made by End
  grpc::ByteBuffer outgoing_;  ///< the answer under way, gRPC's

  mutable Mutex mutex_;
  StreamTurns turns_ DHPMAP_GUARDED_BY(mutex_);
  std::shared_ptr<LaneTask> decoding_ DHPMAP_GUARDED_BY(mutex_);  ///< of the message just read; null: not yet, or done
  bool is_cancelled_ DHPMAP_GUARDED_BY(mutex_) = false;
  std::string map_name_ DHPMAP_GUARDED_BY(mutex_);
  std::optional<Place> place_ DHPMAP_GUARDED_BY(mutex_);
  std::deque<Ack> acks_ DHPMAP_GUARDED_BY(mutex_);  ///< the first is being written if turns_ says so
  Ack last_ DHPMAP_GUARDED_BY(mutex_);              ///< what the last answer is made of
  bool is_kept_ DHPMAP_GUARDED_BY(mutex_) = false;  ///< it is the answer to a message, which has had none yet
  Status end_status_ DHPMAP_GUARDED_BY(mutex_);     ///< why reading ended; OK: the client has no more
};

}  // namespace dhpmap

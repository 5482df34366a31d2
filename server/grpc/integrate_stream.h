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

/// The open streams of frames and the memory of their frames. A shutdown ends them. Thread-safe.
class IntegrateStreams : public OpenStreams {
 public:
  /// Frames have a budget of their own, so that other calls cannot starve a robot: `max_frame_bytes` for all streams.
  explicit IntegrateStreams(std::size_t max_frame_bytes) : frame_bytes_(max_frame_bytes) {}

  /// Memory of their frames now.
  [[nodiscard]] std::size_t frame_bytes() const { return frame_bytes_.used_bytes(); }

 private:
  friend class IntegrateStream;
  ByteBudget frame_bytes_;
};

/// A client's stream of frames. It reads a message only while fewer than `max_frames_in_flight` frames are read but not
/// acknowledged, so neither frames nor acknowledgements pile up: gRPC's flow control holds the client back.
/// Messages arrive as bytes. A lane of low-priority threads parses and decodes them while the map's writer fuses
/// earlier frames; the lane for frames does the rest. A message is decoded only if its frame fits into memory and the
/// stream has a place at its map. A message that waits for decoding is dropped when its client disconnects or the
/// stream is stopped: else clients that keep opening streams would fill that lane for all others. StreamTurns decides
/// the order.
/// After the client's last message, all frames are stored before the last answer is sent. That answer belongs to the
/// last frame if the client had half-closed before the frame was fused; else it is a separate answer without a frame. A
/// frame that does not fit into memory is refused like one that cannot be fused. Bytes that are no message end the
/// stream. Owns itself: lives until gRPC is done with the call and no callback is left.
class IntegrateStream final : public grpc::ServerBidiReactor<grpc::ByteBuffer, grpc::ByteBuffer>, public OpenStream {
 public:
  /// The number of messages that the client will send.
  enum class Messages {
    kAny,
    kOne,  ///< one answer, once all is stored, or the error that refuses the message
  };

  static IntegrateStream* Start(const ServiceContext& context, Caller caller, IntegrateStreams& streams,
                                Messages messages);

  /// Reads no more messages. Those already read are fused (or refused, if the map no longer takes them), stored and
  /// acknowledged; then the stream ends with `reason`.
  void Stop(const Status& reason) override DHPMAP_EXCLUDES(mutex_);

  void OnReadDone(bool ok) override;
  void OnWriteDone(bool ok) override;
  void OnCancel() override;
  void OnDone() override;

 private:
  using Ack = v1::IntegrateFramesResponse;
  /// An open map, and the feed by which this stream may write to it.
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

  /// Fills `request_` without its frame, quickly. Of a message that does not fit into memory only this is kept.
  Status ParseHead();
  /// Takes a place at the map if this is the first message. Then handles the message, or queues it for decoding.
  Status Begin(bool& is_decoded_later) DHPMAP_EXCLUDES(mutex_);
  Status DecodeLater() DHPMAP_EXCLUDES(mutex_);
  /// Decodes the last message on a low-priority thread: sets `frame_`, or returns the error.
  Status DecodeMessage();
  /// INVALID_ARGUMENT if the bytes are no message.
  Status Parse();
  Result<PanopticFrame> DecodeFrame();
  /// Moves out the last message's frame for the writer, with its bytes if they are to be recorded.
  ArrivedFrame TakeFrame();
  /// Frees the last message while the stream waits.
  void ForgetMessage();
  /// Hands the last message's frame to the writer.
  void HandleRequest() DHPMAP_EXCLUDES(mutex_);
  /// Ends the handling of the last message. If `status` is not OK, no more messages are read.
  void EndMessage(const Status& status) DHPMAP_EXCLUDES(mutex_);
  /// Ends the last message if it waits for decoding.
  void GiveUpDecoding(const Status& why) DHPMAP_EXCLUDES(mutex_);
  /// The place for the last message: taken by the first message.
  Result<Place> PlaceForRequest() DHPMAP_EXCLUDES(mutex_);
  Result<Place> TakePlace() DHPMAP_EXCLUDES(mutex_);
  /// INVALID_ARGUMENT unless a later message is for the same map and session as the first.
  [[nodiscard]] Status CheckSamePlace() const DHPMAP_REQUIRES(mutex_);

  void OnFrameDone(std::int64_t sequence, const FrameOutcome& outcome) DHPMAP_EXCLUDES(mutex_);
  /// Sends the answer to a message to the client, or keeps it for the end.
  void Answer(Ack ack) DHPMAP_EXCLUDES(mutex_);
  /// Whether the next answer to a message is kept as the stream's last one.
  [[nodiscard]] bool IsLastAnswer() const DHPMAP_REQUIRES(mutex_);

  /// Stops reading because of `reason`; only the first reason counts.
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

  // Used between StartRead and EndMessage by the task that handles the message.
  grpc::ByteBuffer incoming_;
  v1::IntegrateFramesRequest request_;          ///< the parsed message; without its frame once that is decoded
  ByteShare arrived_;                           ///< memory of both
  std::size_t num_bytes_ = 0;                   ///< of the message on the wire
  bool has_frame_ = false;                      ///< the message has one
  bool has_no_room_ = false;                    ///< for the frame
  bool is_recorded_ = false;                    ///< the map records its frames
  std::optional<Result<PanopticFrame>> frame_;  ///< decoded
  std::shared_ptr<ByteShare> room_;             ///< of frame_; until it is fused
  bool is_first_ = true;

  Ack conclusion_;             ///< the last answer; made by End
  grpc::ByteBuffer outgoing_;  ///< the answer that gRPC is writing

  mutable Mutex mutex_;
  StreamTurns turns_ DHPMAP_GUARDED_BY(mutex_);
  std::shared_ptr<LaneTask> decoding_ DHPMAP_GUARDED_BY(mutex_);  ///< the queued task that decodes; null: none
  bool is_cancelled_ DHPMAP_GUARDED_BY(mutex_) = false;
  std::string map_name_ DHPMAP_GUARDED_BY(mutex_);
  std::optional<Place> place_ DHPMAP_GUARDED_BY(mutex_);
  std::deque<Ack> acks_ DHPMAP_GUARDED_BY(mutex_);  ///< the first is being written if turns_ says so
  Ack last_ DHPMAP_GUARDED_BY(mutex_);              ///< source of the last answer
  bool is_kept_ DHPMAP_GUARDED_BY(mutex_) = false;  ///< `last_` answers a message that has had no answer yet
  Status end_status_ DHPMAP_GUARDED_BY(mutex_);     ///< why reading ended; OK: the client has half-closed
};

}  // namespace dhpmap

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <grpcpp/support/server_callback.h>

#include <deque>
#include <memory>
#include <mutex>
#include <set>
#include <string>

#include "dhpmap/v1/mapping_service.pb.h"
#include "server/app/map_session.h"
#include "server/grpc/call_runner.h"

namespace dhpmap {

class IntegrateStream;

/// The streams of frames that are open, so that a shutdown can end them. Thread-safe.
class IntegrateStreams {
 public:
  /// Ends every stream, and those that come later, with UNAVAILABLE: see IntegrateStream::Stop.
  void StopAll();

 private:
  friend class IntegrateStream;
  /// False if it is too late.
  bool Add(IntegrateStream* stream);
  void Remove(IntegrateStream* stream);

  std::mutex mutex_;
  std::set<IntegrateStream*> streams_;  // guarded by mutex_
  bool is_stopped_ = false;             // guarded by mutex_
};

/// One client's stream of frames. Reads a message only while fewer than `max_frames_in_flight` frames are read and not
/// yet acknowledged to the client, so that neither frames nor acknowledgements pile up: gRPC's flow control then holds
/// the client back. Frames are decoded on the handler pool while the map's writer fuses those before them.
/// Owns itself: lives until gRPC is done with the call and no callback is left.
class IntegrateStream final : public grpc::ServerBidiReactor<v1::IntegrateFramesRequest, v1::IntegrateFramesResponse> {
 public:
  static IntegrateStream* Start(const ServiceContext& context, IntegrateStreams& streams);

  /// Reads no more; what was read is fused, stored and acknowledged, then the stream ends with UNAVAILABLE.
  void Stop();

  void OnReadDone(bool ok) override;
  void OnWriteDone(bool ok) override;
  void OnDone() override;

 private:
  using Ack = v1::IntegrateFramesResponse;

  IntegrateStream(const ServiceContext& context, IntegrateStreams& streams)
      : context_(context), streams_(streams), record_(context, "MappingService/IntegrateFrames") {}

  /// The message just read: opens the map if it is the first, and hands its frame to the writer.
  void HandleRequest();
  Status OpenMap();
  void OnFrameDone(std::int64_t sequence, const FrameOutcome& outcome);

  // All with mutex_ held.
  void ReadIfThereIsRoom();
  void EndReading(const Status& reason);
  void EndIfAllIsAcknowledged();

  void End(const Status& committed);

  const ServiceContext& context_;
  IntegrateStreams& streams_;
  CallRecord record_;
  std::shared_ptr<IntegrateStream> self_;  ///< until OnDone

  // Between StartRead and the end of HandleRequest: the one who handles it.
  v1::IntegrateFramesRequest request_;

  std::mutex mutex_;
  // Guarded by mutex_.
  std::string map_name_;
  std::shared_ptr<MapSession> session_;
  std::deque<Ack> acks_;      // the first is being written if is_writing_
  int num_in_flight_ = 0;     // read, and their acknowledgement not yet written
  bool is_reading_ = false;   // a read is under way, or its message is being handled
  bool is_handling_ = false;  // the latter
  bool is_writing_ = false;
  bool has_ended_reading_ = false;
  bool is_client_gone_ = false;
  bool is_ending_ = false;
  Status end_status_;  // why reading ended; OK: the client half-closed
};

}  // namespace dhpmap

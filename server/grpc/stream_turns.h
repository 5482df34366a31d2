// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "server/base/state_machine.h"
#include "server/grpc/stream_states.h"

namespace dhpmap {

/// Decides the next step of a stream of frames: when to read, when to write, and when to end. Knows neither gRPC nor
/// frames; each event returns the next actions. Thread-compatible: the stream calls it with its mutex held.
class StreamTurns {
 public:
  using Intake = StreamIntake;
  using Outlet = StreamOutlet;

  /// The actions to take at once after an event.
  struct Todo {
    bool read = false;   ///< ask for the next message
    bool write = false;  ///< write the first waiting acknowledgement
    bool end = false;    ///< end the stream; set once
  };

  /// At most `max_in_flight` messages are read and not yet acknowledged.
  explicit StreamTurns(int max_in_flight) : max_in_flight_(max_in_flight) {}

  Todo OnStart();
  /// A message came in (or, if not `ok`, the client has half-closed). If the result is true, handle the message.
  [[nodiscard]] bool OnRead(bool ok, Todo& todo);
  /// The last message is a frame on its way to the writer. False: too late, drop it.
  [[nodiscard]] bool OnAccepted();
  /// The message is handled, whether or not it was accepted.
  Todo OnHandled();
  /// A frame was fused or refused, and its acknowledgement waits. False: the client is gone, drop it.
  [[nodiscard]] bool OnAcknowledged(Todo& todo);
  /// A frame was fused or refused, and gets no acknowledgement of its own.
  Todo OnSettled();
  /// An acknowledgement was written (`ok`), or failed; `num_waiting` others wait.
  Todo OnWritten(bool ok, int num_waiting);
  /// Stops reading: the client has half-closed or must stop, or the server ends.
  Todo OnStop();

  /// Whether the next frame to be fused or refused is the last one.
  [[nodiscard]] bool IsAtLastFrame() const { return intake_.Is(Intake::kEnded) && num_with_writer_ == 1; }
  /// Whether Todo::end has been set.
  [[nodiscard]] bool is_over() const { return intake_.Is(Intake::kOver); }

  [[nodiscard]] Intake intake() const { return intake_.state(); }
  [[nodiscard]] Outlet outlet() const { return outlet_.state(); }
  [[nodiscard]] int num_in_flight() const { return num_in_flight_; }
  /// Whether reading has ended.
  [[nodiscard]] bool has_stopped() const { return intake_.state() >= Intake::kHandlingLast; }

 private:
  /// Reads on or ends, as the states require.
  Todo Next();

  const int max_in_flight_;
  StateMachine<Intake> intake_{Intake::kPaused};
  StateMachine<Outlet> outlet_{Outlet::kIdle};
  int num_in_flight_ = 0;    // accepted, and their acknowledgement neither written nor dropped
  int num_with_writer_ = 0;  // of these, neither fused nor refused yet
};

}  // namespace dhpmap

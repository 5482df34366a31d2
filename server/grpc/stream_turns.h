// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "server/base/state_machine.h"
#include "server/grpc/stream_states.h"

namespace dhpmap {

/// Whose turn it is on a stream of frames: what may be read, what is to be written, and when it is over. Knows neither
/// gRPC nor frames; every event says what has to be done now. Thread-compatible: the stream calls it with its mutex
/// held.
class StreamTurns {
 public:
  using Intake = StreamIntake;
  using Outlet = StreamOutlet;

  /// What the caller has to do after an event, at once.
  struct Todo {
    bool read = false;   ///< ask for the next message
    bool write = false;  ///< write the first acknowledgement that waits
    bool end = false;    ///< end the stream; said once
  };

  /// At most `max_in_flight` messages are read and not yet acknowledged.
  explicit StreamTurns(int max_in_flight) : max_in_flight_(max_in_flight) {}

  Todo OnStart();
  /// A message came in (or, if not `ok`, the client has sent its last). If the answer is true it has to be handled.
  [[nodiscard]] bool OnRead(bool ok, Todo& todo);
  /// The message that is being handled is a frame on its way to the writer. False: too late, leave it.
  [[nodiscard]] bool OnAccepted();
  /// The message is handled, whether or not it was accepted.
  Todo OnHandled();
  /// A frame is fused or refused, and its acknowledgement waits; false: nobody is there to read it, drop it.
  [[nodiscard]] bool OnAcknowledged(Todo& todo);
  /// A frame is fused or refused, and is not to be acknowledged by itself.
  Todo OnSettled();
  /// The acknowledgement under way is with the client (`ok`), or will never be; `num_waiting` others wait.
  Todo OnWritten(bool ok, int num_waiting);
  /// No more messages are asked for: the client has sent its last, must not go on, or the server ends.
  Todo OnStop();

  /// Whether the next frame to be fused or refused is the last of all.
  [[nodiscard]] bool IsAtLastFrame() const { return intake_.Is(Intake::kEnded) && num_with_writer_ == 1; }
  /// Whether the end has been said.
  [[nodiscard]] bool is_over() const { return intake_.Is(Intake::kOver); }

  [[nodiscard]] Intake intake() const { return intake_.state(); }
  [[nodiscard]] Outlet outlet() const { return outlet_.state(); }
  [[nodiscard]] int num_in_flight() const { return num_in_flight_; }
  /// Whether no more messages are asked for.
  [[nodiscard]] bool has_stopped() const { return intake_.state() >= Intake::kHandlingLast; }

 private:
  /// Reads on or ends, as the states say.
  Todo Next();

  const int max_in_flight_;
  StateMachine<Intake> intake_{Intake::kPaused};
  StateMachine<Outlet> outlet_{Outlet::kIdle};
  int num_in_flight_ = 0;    // accepted, and their acknowledgement neither written nor dropped
  int num_with_writer_ = 0;  // of these, neither fused nor refused yet
};

}  // namespace dhpmap

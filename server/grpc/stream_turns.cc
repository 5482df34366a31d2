// SPDX-License-Identifier: BSD-3-Clause
#include "server/grpc/stream_turns.h"

namespace dhpmap {

StreamTurns::Todo StreamTurns::Next() {
  Todo todo;
  if (intake_.Is(Intake::kPaused) && num_in_flight_ < max_in_flight_) {
    intake_.To(Intake::kReading);
    todo.read = true;
  } else if (intake_.Is(Intake::kEnded) && num_in_flight_ == 0) {
    intake_.To(Intake::kOver);
    todo.end = true;
  }
  return todo;
}

StreamTurns::Todo StreamTurns::OnStart() { return Next(); }

bool StreamTurns::OnRead(bool ok, Todo& todo) {
  todo = {};
  if (!intake_.Is(Intake::kReading)) return false;  // stopped meanwhile: the message is not handled
  intake_.To(ok ? Intake::kHandling : Intake::kEnded);
  if (!ok) todo = Next();
  return ok;
}

bool StreamTurns::OnAccepted() {
  if (!intake_.Is(Intake::kHandling)) return false;
  ++num_in_flight_;
  ++num_with_writer_;
  return true;
}

StreamTurns::Todo StreamTurns::OnHandled() {
  intake_.To(intake_.Is(Intake::kHandling) ? Intake::kPaused : Intake::kEnded);
  return Next();
}

bool StreamTurns::OnAcknowledged(Todo& todo) {
  todo = {};
  if (outlet_.Is(Outlet::kBroken)) {
    todo = OnSettled();
    return false;
  }
  --num_with_writer_;
  if (outlet_.Is(Outlet::kIdle)) {
    outlet_.To(Outlet::kWriting);
    todo.write = true;
  }
  return true;
}

StreamTurns::Todo StreamTurns::OnSettled() {
  --num_with_writer_;
  --num_in_flight_;
  return Next();
}

StreamTurns::Todo StreamTurns::OnWritten(bool ok, int num_waiting) {
  if (!ok) {
    outlet_.To(Outlet::kBroken);
    num_in_flight_ -= 1 + num_waiting;
    return OnStop();
  }
  --num_in_flight_;
  outlet_.To(Outlet::kIdle);
  Todo todo = Next();
  if (num_waiting > 0) {
    outlet_.To(Outlet::kWriting);
    todo.write = true;
  }
  return todo;
}

StreamTurns::Todo StreamTurns::OnStop() {
  if (intake_.Is(Intake::kHandling)) intake_.To(Intake::kHandlingLast);
  else if (intake_.IsAnyOf({Intake::kPaused, Intake::kReading})) intake_.To(Intake::kEnded);
  return Next();
}

}  // namespace dhpmap

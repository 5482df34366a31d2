// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace dhpmap::http {

/// Progress of reading a request.
enum class Intake {
  kHead,      ///< waiting for the next request's head
  kInviting,  ///< writing "100 Continue", which the client waits for before it sends the body
  kPaused,    ///< more of the body follows, but the exchange does not want it yet
  kReading,   ///< reading a part of the body for the exchange
  kDropping,  ///< reading a part of the body to drop it
  kDone,      ///< the body is complete, or its rest is unreadable
};

constexpr bool IsLegal(Intake from, Intake to) {
  switch (from) {
    case Intake::kHead: return to == Intake::kPaused || to == Intake::kDone;
    case Intake::kInviting: return to == Intake::kPaused;
    case Intake::kPaused:
      return to == Intake::kInviting || to == Intake::kReading || to == Intake::kDropping || to == Intake::kDone;
    case Intake::kReading: return to == Intake::kPaused || to == Intake::kDropping || to == Intake::kDone;
    case Intake::kDropping: return to == Intake::kDone;
    case Intake::kDone: return to == Intake::kHead;
  }
  return false;
}

/// Progress of writing the answer.
enum class Answer {
  kNone,       ///< not started
  kStreaming,  ///< started; more follows
  kEnding,     ///< the last part is being written
  kEnded,      ///< written; the rest of the request's body is being dropped
};

constexpr bool IsLegal(Answer from, Answer to) {
  switch (from) {
    case Answer::kNone: return to == Answer::kStreaming || to == Answer::kEnding;
    case Answer::kStreaming: return to == Answer::kEnding;
    case Answer::kEnding: return to == Answer::kEnded;
    case Answer::kEnded: return to == Answer::kNone;
  }
  return false;
}

/// Life cycle of the connection.
enum class Life {
  kOpen,
  kDraining,  ///< closes after the current request
  kClosed,
};

constexpr bool IsLegal(Life from, Life to) { return from < to; }

}  // namespace dhpmap::http

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace dhpmap::http {

/// How far a request has been read.
enum class Intake {
  kHead,      ///< the next request's head is awaited
  kInviting,  ///< the client wants "100 Continue" before it sends the body: that is being written
  kPaused,    ///< there is more of the body, and nobody wants it yet
  kReading,   ///< a part of the body is being read, for the exchange
  kDropping,  ///< a part of the body is being read, for nobody
  kDone,      ///< all of it has been read, or the rest cannot be understood
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

/// How far its answer has been written.
enum class Answer {
  kNone,       ///< not begun
  kStreaming,  ///< begun; more follows
  kEnding,     ///< its last part is being written
  kEnded,      ///< written; what is left of the request's body is being dropped
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

/// How long the connection lasts.
enum class Life {
  kOpen,
  kDraining,  ///< the request under way is the last
  kClosed,
};

constexpr bool IsLegal(Life from, Life to) { return from < to; }

}  // namespace dhpmap::http

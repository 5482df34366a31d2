// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace dhpmap {

// A stream of frames has two independent flows, each with its own state. This file lists all legal transitions.

/// State of the client's messages.
enum class StreamIntake {
  kPaused,        ///< not reading: too many frames are unacknowledged
  kReading,       ///< waiting for a message
  kHandling,      ///< decoding a message
  kHandlingLast,  ///< decoding the last message
  kEnded,         ///< no more reads; acknowledgements may be outstanding
  kOver,          ///< all acknowledged; the stream is ending
};

constexpr bool IsLegal(StreamIntake from, StreamIntake to) {
  switch (from) {
    case StreamIntake::kPaused: return to == StreamIntake::kReading || to == StreamIntake::kEnded;
    case StreamIntake::kReading: return to == StreamIntake::kHandling || to == StreamIntake::kEnded;
    case StreamIntake::kHandling: return to == StreamIntake::kPaused || to == StreamIntake::kHandlingLast;
    case StreamIntake::kHandlingLast: return to == StreamIntake::kEnded;
    case StreamIntake::kEnded: return to == StreamIntake::kOver;
    case StreamIntake::kOver: return false;
  }
  return false;
}

/// State of the acknowledgements.
enum class StreamOutlet {
  kIdle,
  kWriting,  ///< one is being written
  kBroken,   ///< the client is gone; the rest is dropped
};

constexpr bool IsLegal(StreamOutlet from, StreamOutlet to) {
  switch (from) {
    case StreamOutlet::kIdle: return to == StreamOutlet::kWriting;
    case StreamOutlet::kWriting: return to != StreamOutlet::kWriting;
    case StreamOutlet::kBroken: return false;
  }
  return false;
}

}  // namespace dhpmap

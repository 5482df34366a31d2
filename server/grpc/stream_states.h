// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace dhpmap {

// A stream of frames is two flows beside each other, each with its own state. All legal changes stand here.

/// Where the messages of the client stand.
enum class StreamIntake {
  kPaused,        ///< none is asked for: too many are not acknowledged yet
  kReading,       ///< one is asked for
  kHandling,      ///< one is being decoded
  kHandlingLast,  ///< one is being decoded, and no more are asked for
  kEnded,         ///< no more are asked for; acknowledgements may be outstanding
  kOver,          ///< all is acknowledged, and the stream is being ended
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

/// Where the acknowledgements stand.
enum class StreamOutlet {
  kIdle,
  kWriting,  ///< one is under way
  kBroken,   ///< the client is gone: what is left is dropped
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

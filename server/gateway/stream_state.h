// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace dhpmap::gateway {

// A stream has three independent flows, each with its own state.

/// Messages of the body, to the RPC.
enum class Sending {
  kIdle,      ///< the next message may be sent
  kBusy,      ///< a message is being converted or sent
  kBusyHeld,  ///< the same, and the connection does not read the body meanwhile
  kEnded,     ///< half-closed, or sending was given up
};

constexpr bool IsLegal(Sending from, Sending to) {
  switch (from) {
    case Sending::kIdle: return to == Sending::kBusy || to == Sending::kEnded;
    case Sending::kBusy: return to != Sending::kBusy;
    case Sending::kBusyHeld: return to == Sending::kIdle || to == Sending::kEnded;
    case Sending::kEnded: return false;
  }
  return false;
}

/// Messages of the RPC, to the gateway.
enum class Receiving {
  kNoCall,  ///< the RPC has not been started
  kIdle,    ///< the next message may be requested
  kBusy,    ///< a message was requested
  kEnded,   ///< no more messages; waiting for the status
  kDone,    ///< the status is known, or no call was started
};

constexpr bool IsLegal(Receiving from, Receiving to) {
  switch (from) {
    case Receiving::kNoCall: return to == Receiving::kIdle || to == Receiving::kDone;
    case Receiving::kIdle: return to == Receiving::kBusy;
    case Receiving::kBusy: return to == Receiving::kIdle || to == Receiving::kEnded;
    case Receiving::kEnded: return to == Receiving::kDone;
    case Receiving::kDone: return false;
  }
  return false;
}

/// The answer, to the client.
enum class Answering {
  kNone,   ///< not started
  kIdle,   ///< started; the next part may be written
  kBusy,   ///< a part is being written
  kEnded,  ///< nothing more is written
};

constexpr bool IsLegal(Answering from, Answering to) {
  switch (from) {
    case Answering::kNone: return to == Answering::kIdle || to == Answering::kEnded;
    case Answering::kIdle: return to == Answering::kBusy || to == Answering::kEnded;
    case Answering::kBusy: return to == Answering::kIdle || to == Answering::kEnded;
    case Answering::kEnded: return false;
  }
  return false;
}

}  // namespace dhpmap::gateway

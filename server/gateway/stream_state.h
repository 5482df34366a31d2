// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace dhpmap::gateway {

// A stream is three flows beside each other, each with its own state.

/// Messages of the body, to the RPC.
enum class Sending {
  kIdle,      ///< the next message may go
  kBusy,      ///< one is being converted, or on its way
  kBusyHeld,  ///< the same, and the connection reads no more of the body until it has gone
  kEnded,     ///< half-closed, or never to send again
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

/// Messages of the RPC, to us.
enum class Receiving {
  kNoCall,  ///< the RPC has not been started
  kIdle,    ///< the next message may be asked for
  kBusy,    ///< it has been asked for
  kEnded,   ///< there are no more; the status is awaited
  kDone,    ///< the status is known, or there never was a call
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
  kNone,   ///< not begun
  kIdle,   ///< begun; the next part may go
  kBusy,   ///< a part is on its way
  kEnded,  ///< nothing more goes to the connection
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

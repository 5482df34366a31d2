// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string_view>

namespace dhpmap::net {

/// Why a connection was ended at the door.
enum class Refusal {
  kNone,
  kTooManyStreams,        ///< open at once
  kTooManyResets,         ///< of streams, by the client or because of what it sent
  kTooManyControlFrames,  ///< PING, SETTINGS, PRIORITY, empty DATA, WINDOW_UPDATE that nothing asked for
  kHeaderTooLarge,        ///< a header block: bytes, frames or fields
  kBadHeader,             ///< an HPACK integer or length beyond all bounds
  kFrameTooLarge,
  kMalformed,               ///< frames that RFC 9113 forbids, and that would hide others from the counts
  kSettingsUnacknowledged,  ///< the server's limits hold for those only who acknowledge them
  kNotHttp2,                ///< the first bytes are not the preface of HTTP/2
  kSilent,                  ///< the handshake or preface has not come in time
  kTooManyNew,              ///< of those that have not said enough yet, the oldest goes
  kHandshake,               ///< TLS: no common version, cipher or protocol, or a certificate that does not hold
  kTooManyConnections,      ///< of one peer
  kOutOfDescriptors,
};

/// "too_many_streams": for metrics and logs.
std::string_view RefusalName(Refusal refusal);

}  // namespace dhpmap::net

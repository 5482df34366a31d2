// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string_view>

namespace dhpmap::net {

/// Why the door ended a connection.
enum class Refusal {
  kNone,
  kTooManyStreams,        ///< open at once
  kTooManyResets,         ///< of streams, by the client or because of what it sent
  kTooManyControlFrames,  ///< PING, SETTINGS, PRIORITY, empty DATA, unsolicited WINDOW_UPDATE
  kHeaderTooLarge,        ///< a header block has too many bytes, frames or fields
  kBadHeader,             ///< an HPACK integer or length above the limit
  kFrameTooLarge,
  kMalformed,               ///< frames that RFC 9113 forbids, and that could hide others from the counts
  kSettingsUnacknowledged,  ///< the server's limits bind only clients that acknowledge its SETTINGS
  kNotHttp2,                ///< the first bytes are not the preface of HTTP/2
  kSilent,                  ///< handshake or preface did not arrive in time
  kTooManyNew,              ///< limit of pending connections: the oldest is closed
  kHandshake,               ///< TLS: no common version, cipher or protocol, or an invalid certificate
  kTooManyConnections,      ///< of one peer
  kOutOfDescriptors,
};

/// "too_many_streams": for metrics and logs.
std::string_view RefusalName(Refusal refusal);

}  // namespace dhpmap::net

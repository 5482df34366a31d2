// SPDX-License-Identifier: BSD-3-Clause
#include "server/net/refusal.h"

namespace dhpmap::net {

std::string_view RefusalName(Refusal refusal) {
  switch (refusal) {
    case Refusal::kNone: return "none";
    case Refusal::kTooManyStreams: return "too_many_streams";
    case Refusal::kTooManyResets: return "too_many_resets";
    case Refusal::kTooManyControlFrames: return "too_many_control_frames";
    case Refusal::kHeaderTooLarge: return "header_too_large";
    case Refusal::kBadHeader: return "bad_header";
    case Refusal::kFrameTooLarge: return "frame_too_large";
    case Refusal::kMalformed: return "malformed";
    case Refusal::kSettingsUnacknowledged: return "settings_unacknowledged";
    case Refusal::kNotHttp2: return "not_http2";
    case Refusal::kSilent: return "silent";
    case Refusal::kTooManyNew: return "too_many_new";
    case Refusal::kHandshake: return "handshake";
    case Refusal::kTooManyConnections: return "too_many_connections";
    case Refusal::kOutOfDescriptors: return "out_of_descriptors";
  }
  return "unknown";
}

}  // namespace dhpmap::net

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <grpcpp/security/credentials.h>

#include <array>
#include <cstdint>
#include <memory>

#include "mapping/base/result.h"
#include "server/grpc/relay/peer_tls.h"

namespace dhpmap {

/// Credentials of the files as they are now. UNAVAILABLE, reason OWNER_UNREACHABLE, if one cannot be read: without
/// `fleet.ca` the system's CAs would be trusted in its place.
Result<std::shared_ptr<grpc::ChannelCredentials>> PeerCredentials(const PeerTls& tls);

/// When each of the files was last changed, 0 for one that is not there: differs after a renewal.
using PeerFileTimes = std::array<std::int64_t, 3>;
PeerFileTimes PeerFileTimesOf(const PeerTls& tls);

}  // namespace dhpmap

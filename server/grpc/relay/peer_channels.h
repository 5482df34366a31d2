// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <grpcpp/channel.h>

#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "mapping/base/mutex.h"
#include "mapping/base/result.h"
#include "server/grpc/relay/peer_credentials.h"
#include "server/grpc/relay/peer_tls.h"

namespace dhpmap {

/// Connections to other servers, a few for each, closed while they are idle. Thread-safe.
class PeerChannels {
 public:
  static constexpr std::size_t kMostPeers = 64;
  /// A server takes 128 streams of a connection (kMaxStreamsPerConnection of grpc_server.cc).
  static constexpr int kMostCallsPerChannel = 100;
  static constexpr std::size_t kMostChannelsPerPeer = 16;

  explicit PeerChannels(PeerTls tls) : tls_(std::move(tls)) {}

  /// A connection for one call, which holds it as long as it goes on. RESOURCE_EXHAUSTED, reason TOO_BUSY, for more
  /// calls than the peer's connections take; UNAVAILABLE as of PeerCredentials. Does not wait: the call meets the
  /// server or not. After a renewal of the TLS files new calls use new connections.
  Result<std::shared_ptr<grpc::Channel>> Get(const std::string& address) DHPMAP_EXCLUDES(mutex_);

  [[nodiscard]] std::size_t num_channels() const DHPMAP_EXCLUDES(mutex_);

 private:
  struct Connection;
  using Peer = std::vector<std::shared_ptr<Connection>>;

  [[nodiscard]] Result<std::shared_ptr<Connection>> Open(const std::string& address, const PeerFileTimes& times) const;
  /// Of peers that no call goes to.
  void MakeRoom() DHPMAP_REQUIRES(mutex_);

  const PeerTls tls_;
  mutable Mutex mutex_;
  std::map<std::string, Peer> peers_ DHPMAP_GUARDED_BY(mutex_);
};

}  // namespace dhpmap

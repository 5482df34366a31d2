// SPDX-License-Identifier: BSD-3-Clause
#include "server/grpc/relay/peer_channels.h"

#include <grpcpp/create_channel.h>

#include <algorithm>
#include <atomic>
#include <utility>

#include "server/grpc/call_runner.h"

namespace dhpmap {
namespace {

constexpr int kIdle_ms = 300'000;
constexpr int kSilence_ms = 10'000, kSilenceTimeout_ms = 5'000;  // then a peer that has frozen is given up
constexpr int kLeastBackoff_ms = 100, kMostBackoff_ms = 1'000;
constexpr int kConnect_ms = 3'000;  // for one attempt

}  // namespace

struct PeerChannels::Connection {
  std::shared_ptr<grpc::Channel> channel;
  PeerFileTimes times;  ///< of the files when it was made
  std::atomic<int> num_calls = 0;
};

Result<std::shared_ptr<PeerChannels::Connection>> PeerChannels::Open(const std::string& address,
                                                                     const PeerFileTimes& times) const {
  DHPMAP_ASSIGN_OR_RETURN(const auto credentials, PeerCredentials(tls_));
  grpc::ChannelArguments arguments;
  arguments.SetMaxReceiveMessageSize(-1);
  arguments.SetInt(GRPC_ARG_USE_LOCAL_SUBCHANNEL_POOL, 1);  // else all channels to an address share one connection
  // Else a stream whose client does not read keeps megabytes here that no budget counts.
  arguments.SetInt(GRPC_ARG_HTTP2_BDP_PROBE, 0);
  arguments.SetInt(GRPC_ARG_CLIENT_IDLE_TIMEOUT_MS, kIdle_ms);
  arguments.SetInt(GRPC_ARG_KEEPALIVE_TIME_MS, kSilence_ms);
  arguments.SetInt(GRPC_ARG_KEEPALIVE_TIMEOUT_MS, kSilenceTimeout_ms);
  arguments.SetInt(GRPC_ARG_INITIAL_RECONNECT_BACKOFF_MS, kLeastBackoff_ms);
  arguments.SetInt(GRPC_ARG_MIN_RECONNECT_BACKOFF_MS, kConnect_ms);
  arguments.SetInt(GRPC_ARG_MAX_RECONNECT_BACKOFF_MS, kMostBackoff_ms);
  arguments.SetInt(GRPC_ARG_ENABLE_RETRIES, 0);  // who knows the owner tries again, and gRPC does not
  arguments.SetInt(GRPC_ARG_ENABLE_HTTP_PROXY, 0);
  auto connection = std::make_shared<Connection>();
  connection->channel = grpc::CreateCustomChannel(address, credentials, arguments);
  connection->times = times;
  return connection;
}

void PeerChannels::MakeRoom() {
  std::erase_if(peers_, [](const auto& peer) {
    return std::all_of(peer.second.begin(), peer.second.end(),
                       [](const auto& connection) { return connection->num_calls == 0; });
  });
}

Result<std::shared_ptr<grpc::Channel>> PeerChannels::Get(const std::string& address) {
  const PeerFileTimes times = PeerFileTimesOf(tls_);
  const MutexLock lock(mutex_);
  if (!peers_.contains(address) && peers_.size() >= kMostPeers) MakeRoom();
  if (!peers_.contains(address) && peers_.size() >= kMostPeers) return TooBusy();
  Peer& peer = peers_[address];
  // gRPC would show an old certificate at each new handshake for as long as the channel lives.
  std::erase_if(peer, [&](const auto& old) { return old->times != times && old->num_calls == 0; });
  auto found = std::find_if(peer.begin(), peer.end(), [&](const auto& connection) {
    return connection->times == times && connection->num_calls < kMostCallsPerChannel;
  });
  if (found == peer.end()) {
    if (peer.size() >= kMostChannelsPerPeer) return TooBusy();
    DHPMAP_ASSIGN_OR_RETURN(auto opened, Open(address, times));
    found = peer.insert(peer.end(), std::move(opened));
  }
  const std::shared_ptr<Connection> connection = *found;
  ++connection->num_calls;
  return std::shared_ptr<grpc::Channel>(connection->channel.get(),
                                        [connection](grpc::Channel*) { --connection->num_calls; });
}

std::size_t PeerChannels::num_channels() const {
  const MutexLock lock(mutex_);
  std::size_t count = 0;
  for (const auto& peer : peers_) count += peer.second.size();
  return count;
}

}  // namespace dhpmap

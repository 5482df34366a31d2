// SPDX-License-Identifier: BSD-3-Clause
#include "server/grpc/relay/peer_channels.h"

#include <grpcpp/create_channel.h>
#include <grpcpp/security/credentials.h>

#include <algorithm>
#include <atomic>
#include <fstream>
#include <iterator>
#include <utility>

#include "server/grpc/call_runner.h"

namespace dhpmap {
namespace {

constexpr int kIdle_ms = 300'000;
constexpr int kSilence_ms = 10'000, kSilenceTimeout_ms = 5'000;  // then a peer that has frozen is given up
constexpr int kLeastBackoff_ms = 100, kMostBackoff_ms = 1'000;
constexpr int kConnect_ms = 3'000;  // for one attempt

std::string TextOfFile(const std::string& path) {
  if (path.empty()) return {};
  std::ifstream file(path);
  return {std::istreambuf_iterator<char>(file), {}};
}

std::shared_ptr<grpc::ChannelCredentials> CredentialsOf(const PeerTls& tls) {
  if (!tls.is_on) return grpc::InsecureChannelCredentials();
  return grpc::SslCredentials({.pem_root_certs = TextOfFile(tls.ca),
                               .pem_private_key = TextOfFile(tls.key),
                               .pem_cert_chain = TextOfFile(tls.cert)});
}

}  // namespace

struct PeerChannels::Connection {
  std::shared_ptr<grpc::Channel> channel;
  std::atomic<int> num_calls = 0;
};

std::shared_ptr<PeerChannels::Connection> PeerChannels::Open(const std::string& address) const {
  grpc::ChannelArguments arguments;
  arguments.SetMaxReceiveMessageSize(-1);
  arguments.SetInt(GRPC_ARG_USE_LOCAL_SUBCHANNEL_POOL, 1);  // else all channels to an address share one connection
  arguments.SetInt(GRPC_ARG_CLIENT_IDLE_TIMEOUT_MS, kIdle_ms);
  arguments.SetInt(GRPC_ARG_KEEPALIVE_TIME_MS, kSilence_ms);
  arguments.SetInt(GRPC_ARG_KEEPALIVE_TIMEOUT_MS, kSilenceTimeout_ms);
  arguments.SetInt(GRPC_ARG_INITIAL_RECONNECT_BACKOFF_MS, kLeastBackoff_ms);
  arguments.SetInt(GRPC_ARG_MIN_RECONNECT_BACKOFF_MS, kConnect_ms);
  arguments.SetInt(GRPC_ARG_MAX_RECONNECT_BACKOFF_MS, kMostBackoff_ms);
  arguments.SetInt(GRPC_ARG_ENABLE_RETRIES, 0);  // who knows the owner tries again, and gRPC does not
  arguments.SetInt(GRPC_ARG_ENABLE_HTTP_PROXY, 0);
  auto connection = std::make_shared<Connection>();
  connection->channel = grpc::CreateCustomChannel(address, CredentialsOf(tls_), arguments);
  return connection;
}

void PeerChannels::MakeRoom() {
  std::erase_if(peers_, [](const auto& peer) {
    return std::all_of(peer.second.begin(), peer.second.end(),
                       [](const auto& connection) { return connection->num_calls == 0; });
  });
}

Result<std::shared_ptr<grpc::Channel>> PeerChannels::Get(const std::string& address) {
  const MutexLock lock(mutex_);
  if (!peers_.contains(address) && peers_.size() >= kMostPeers) MakeRoom();
  if (!peers_.contains(address) && peers_.size() >= kMostPeers) return TooBusy();
  Peer& peer = peers_[address];
  auto found = std::find_if(peer.begin(), peer.end(),
                            [](const auto& connection) { return connection->num_calls < kMostCallsPerChannel; });
  if (found == peer.end()) {
    if (peer.size() >= kMostChannelsPerPeer) return TooBusy();
    found = peer.insert(peer.end(), Open(address));
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

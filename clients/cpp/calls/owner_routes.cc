// SPDX-License-Identifier: BSD-3-Clause
#include "clients/cpp/calls/owner_routes.h"

#include <utility>

#include "proto/types/metadata_keys.h"

namespace dhpmap::client {

std::shared_ptr<Stubs> OwnerRoutes::To(const std::string& map, Clock::time_point end) const {
  std::shared_ptr<Stubs> server;
  {
    const MutexLock lock(mutex_);
    const auto address = addresses_.find(map);
    if (address == addresses_.end()) return nullptr;
    const auto found = servers_.find(address->second);
    if (found == servers_.end()) return nullptr;
    server = found->second;
  }
  grpc::Channel& channel = server->channel();
  if (channel.GetState(/*try_to_connect=*/true) == GRPC_CHANNEL_READY) return server;
  const bool is_connected = Clock::now() < end && channel.WaitForConnected(GrpcTime(end));
  return is_connected ? server : nullptr;
}

void OwnerRoutes::Learn(const std::string& map, const grpc::ClientContext& context) {
  if (dial_ == nullptr || map.empty()) return;
  const auto& head = context.GetServerInitialMetadata();
  const auto told = head.find(kOwnerKey);
  if (told == head.end()) return;
  const std::string text(told->second.data(), told->second.size());
  const std::string address = text.substr(0, text.find(' '));
  const MutexLock lock(mutex_);
  if (const auto known = addresses_.find(map); known != addresses_.end() && known->second == address) return;
  if (ServerAt(address) == nullptr) return;
  if (addresses_.size() >= kMostMaps) addresses_.clear();  // later answers fill it again
  addresses_[map] = address;
}

std::shared_ptr<Stubs> OwnerRoutes::ServerAt(const std::string& address) {
  if (const auto found = servers_.find(address); found != servers_.end()) return found->second;
  const std::shared_ptr<grpc::Channel> channel = dial_(address);
  if (channel == nullptr) return nullptr;
  if (servers_.size() >= kMostServers) servers_.clear();  // calls in progress keep their server
  (void)channel->GetState(/*try_to_connect=*/true);
  return servers_[address] = std::make_shared<Stubs>(channel);
}

void OwnerRoutes::Forget(const std::string& map) {
  const MutexLock lock(mutex_);
  addresses_.erase(map);
}

std::string MapOfName(const std::string& name) {
  constexpr std::size_t kPrefixBytes = 5;  // "maps/"
  if (!name.starts_with("maps/") || name.size() == kPrefixBytes) return {};
  return name.substr(0, name.find('/', kPrefixBytes));
}

}  // namespace dhpmap::client

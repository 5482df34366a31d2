// SPDX-License-Identifier: BSD-3-Clause
#include "tests/rig/watched/watched_maps.h"

#include <algorithm>

#include "dhpmap/v1/watch_service.grpc.pb.h"
#include "tests/rig/clients/lone_channel.h"

namespace dhpmap::rig {

WatchedMaps::WatchedMaps(const std::string& address, const std::vector<v1::Map>& maps) : reports_(maps.size()) {
  constexpr std::size_t kWatchesAConnection = 16;
  std::shared_ptr<grpc::Channel> channel;
  for (std::size_t i = 0; i < maps.size(); ++i) {
    if (i % kWatchesAConnection == 0) channel = LoneChannel(address);
    contexts_.push_back(std::make_unique<grpc::ClientContext>());
    threads_.emplace_back([this, i, channel, from = maps[i]] { Read(i, channel, from); });
  }
}

WatchedMaps::~WatchedMaps() {
  for (const auto& context : contexts_) context->TryCancel();
  for (std::thread& thread : threads_) thread.join();
}

void WatchedMaps::Read(std::size_t map, const std::shared_ptr<grpc::Channel>& channel, const v1::Map& from) {
  v1::WatchMapRequest request;
  request.set_map(from.name());
  request.set_start_revision(from.revision() + 1);
  request.set_history_id(from.history_id());
  const auto stream = v1::WatchService::NewStub(channel)->WatchMap(contexts_[map].get(), request);
  v1::WatchMapResponse answer;
  while (stream->Read(&answer)) {
    if (!answer.has_change()) continue;
    const MutexLock lock(mutex_);
    reports_[map].push_back({answer.change().last_revision(), Clock::now()});
    changed_.NotifyAll();
  }
  (void)stream->Finish();
  const MutexLock lock(mutex_);
  ++num_ended_;
  changed_.NotifyAll();
}

const WatchedMaps::Report* WatchedMaps::Find(std::size_t map, std::int64_t revision) const {
  const auto& all = reports_[map];
  const auto found = std::find_if(all.begin(), all.end(), [&](const Report& r) { return r.revision >= revision; });
  return found == all.end() ? nullptr : &*found;
}

bool WatchedMaps::WaitFor(std::size_t map, std::int64_t revision, double patience_s) {
  const auto patience = std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(patience_s));
  const MutexLock lock(mutex_);
  changed_.WaitUntil(mutex_, Clock::now() + patience,
                     [&]() DHPMAP_REQUIRES(mutex_) { return num_ended_ > 0 || Find(map, revision) != nullptr; });
  return Find(map, revision) != nullptr;
}

WatchedMaps::Clock::time_point WatchedMaps::TimeOf(std::size_t map, std::int64_t revision) const {
  const MutexLock lock(mutex_);
  const Report* found = Find(map, revision);
  return found == nullptr ? Clock::time_point::max() : found->time;
}

int WatchedMaps::num_ended() const {
  const MutexLock lock(mutex_);
  return num_ended_;
}

}  // namespace dhpmap::rig

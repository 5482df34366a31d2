// SPDX-License-Identifier: BSD-3-Clause
#include "server/net/door.h"

#include <sys/socket.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <unordered_map>
#include <utility>
#include <vector>

#include "mapping/base/mutex.h"
#include "server/net/connection_acceptor.h"
#include "server/net/frame_reader.h"
#include "server/net/greeter.h"
#include "server/net/named_pair.h"
#include "server/net/peer_table.h"
#include "server/net/refusal_log.h"
#include "server/net/relay.h"
#include "server/net/socket_names.h"

namespace dhpmap::net {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::chrono::seconds kLastWordsOfAll{1};
constexpr std::size_t kFewConnections = 64;

/// Limit of one address, so that it cannot occupy all connections.
std::size_t MostPerPeer(int max_connections) {
  const auto most = static_cast<std::size_t>(std::max(max_connections, 1));
  return std::max(std::min(most, kFewConnections), most - most / 4);
}

/// Shared by all doors of the process, because the names of pairs are.
std::uint64_t NextNumber() {
  static std::atomic<std::uint64_t> last = 0;
  return ++last;
}

GreeterOptions GreeterOptionsOf(const DoorOptions& options) {
  const auto half = static_cast<std::size_t>(std::max(options.max_connections / 2, 1));
  GreeterOptions greeter{.protocol = options.protocol, .tls = options.tls};
  greeter.max_new = std::min(greeter.max_new, half);
  greeter.max_new_per_peer = std::min(greeter.max_new_per_peer, half);
  return greeter;
}

}  // namespace

struct Door::Impl {
  struct Running {
    PeerIdentity peer;
    std::shared_ptr<PeerCounts> counts;  ///< counts as a connection; null if FrameLimits hold it
    std::string name;                    ///< of the other end of the pair
  };

  Impl(const DoorOptions& how, std::unique_ptr<ConnectionAcceptor> listening)
      : options(how),
        refusals(how.name, how.on_refused),
        peers(MostPerPeer(how.max_connections)),
        acceptor(std::move(listening)) {
    for (int i = 0; i < std::max(options.num_relays, 1); ++i) {
      relays.push_back(std::make_unique<Relay>([this](std::uint64_t number, Refusal why) { Ended(number, why); }));
    }
  }

  void Accepted(int socket);
  void PassOn(Greeted greeted);
  void Ended(std::uint64_t number, Refusal why);

  const DoorOptions options;
  RefusalLog refusals;
  PeerTable peers;
  std::function<void(Passed)> take;
  mutable Mutex mutex;
  std::unordered_map<std::uint64_t, Running> running DHPMAP_GUARDED_BY(mutex);
  // Last, so that their threads end in this order, those that hand over connections before those that take them.
  std::vector<std::unique_ptr<Relay>> relays;
  std::unique_ptr<Greeter> greeter;
  std::unique_ptr<ConnectionAcceptor> acceptor;
};

void Door::Impl::Accepted(int descriptor) {
  Descriptor socket(descriptor);
  PeerIdentity peer = IdentityOf(descriptor);
  std::shared_ptr<PeerCounts> counts = peers.Join(PeerKey(peer), Clock::now());
  if (counts == nullptr) return refusals.Note(Refusal::kTooManyConnections, peer);
  greeter->Add(std::move(socket), std::move(peer), std::move(counts));
}

void Door::Impl::PassOn(Greeted greeted) {
  const std::uint64_t number = NextNumber();
  auto pair = MakeNamedPair(number);
  if (!pair) return refusals.Note(Refusal::kOutOfDescriptors, greeted.peer);
  std::unique_ptr<FrameLimits> limits;
  if (options.protocol == Protocol::kHttp2) {
    limits = std::make_unique<FrameLimits>(std::move(greeted.counts));
    (void)::send(pair->ours.get(), kHttp2Preface.data(), kHttp2Preface.size(), 0);  // fits: the first write
  }
  {
    const MutexLock lock(mutex);
    running[number] = {.peer = greeted.peer, .counts = std::move(greeted.counts), .name = std::move(pair->our_name)};
  }
  relays[number % relays.size()]->Add(number, std::move(greeted.socket), std::move(pair->ours), std::move(limits));
  take({.socket = pair->theirs.Release(),
        .peer = std::move(greeted.peer),
        .local_address = std::move(greeted.local_address)});
}

void Door::Impl::Ended(std::uint64_t number, Refusal why) {
  PeerIdentity peer;
  {
    const MutexLock lock(mutex);
    const auto found = running.find(number);
    if (found == running.end()) return;
    peer = std::move(found->second.peer);
    running.erase(found);
  }
  if (why != Refusal::kNone) refusals.Note(why, peer);
}

Result<std::unique_ptr<Door>> Door::Open(const DoorOptions& options) {
  DHPMAP_ASSIGN_OR_RETURN(auto acceptor, ConnectionAcceptor::Listen({.address = options.address,
                                                                     .sockets = options.sockets,
                                                                     .max_connections = options.max_connections}));
  return std::unique_ptr<Door>(new Door(std::make_unique<Impl>(options, std::move(acceptor))));
}

Door::Door(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}

Door::~Door() {
  StopAccepting();
  impl_->greeter.reset();
  const auto end = Clock::now() + kLastWordsOfAll;
  for (const auto& relay : impl_->relays) relay->WaitUntilEmpty(end - Clock::now());
}

int Door::port() const { return impl_->acceptor->port(); }

void Door::Start(std::function<void(Passed)> take) {
  impl_->take = std::move(take);
  impl_->greeter = std::make_unique<Greeter>(
      GreeterOptionsOf(impl_->options),
      Greeter::Events{.on_greeted = [impl = impl_.get()](Greeted greeted) { impl->PassOn(std::move(greeted)); },
                      .on_refused = [impl = impl_.get()](
                                        Refusal why, const PeerIdentity& peer) { impl->refusals.Note(why, peer); }});
  impl_->acceptor->Start([impl = impl_.get()](int socket) { impl->Accepted(socket); });
}

void Door::StopAccepting() { impl_->acceptor->Stop(); }

std::optional<PeerIdentity> Door::Find(std::string_view peer) const {
  const auto number = NumberOfPair(peer);
  if (!number) return std::nullopt;
  const MutexLock lock(impl_->mutex);
  const auto found = impl_->running.find(*number);
  if (found == impl_->running.end() || !peer.ends_with(found->second.name)) return std::nullopt;
  return found->second.peer;
}

std::size_t Door::num_connections() const {
  const MutexLock lock(impl_->mutex);
  return impl_->running.size();
}

}  // namespace dhpmap::net

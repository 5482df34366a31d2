// SPDX-License-Identifier: BSD-3-Clause
#include "server/net/greeter.h"

#include <openssl/ssl.h>
#include <sys/epoll.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <list>
#include <map>
#include <thread>
#include <utility>
#include <vector>

#include "mapping/base/mutex.h"
#include "mapping/base/this_thread.h"
#include "server/net/frame_reader.h"
#include "server/net/pipe_signal.h"
#include "server/net/poller.h"
#include "server/net/socket_names.h"

namespace dhpmap::net {
namespace {

using Clock = std::chrono::steady_clock;
using Outcome = ClientSocket::Outcome;

/// A connection whose handshake or preface is incomplete.
struct Newcomer {
  ClientSocket socket;
  PeerIdentity peer;
  std::shared_ptr<PeerCounts> counts;
  std::string peer_key;
  Clock::time_point until;
  bool is_shaken = false;
  std::size_t num_said = 0;  // bytes of the preface received
  bool waits_to_write = false;
};
using Newcomers = std::list<Newcomer>;  // the oldest first

}  // namespace

struct Greeter::Impl {
  Impl(const GreeterOptions& how, Events whom) : options(how), events(std::move(whom)) {}

  void Run();
  void TakeIn();
  void Begin(Newcomer newcomer);
  void Listen(Newcomers::iterator one);
  /// Continues handshake and preface: kDone when complete, kLater if more is needed.
  Outcome Hear(Newcomer& one, Refusal& refusal) const;
  Outcome HearPreface(Newcomer& one, Refusal& refusal) const;
  void Refuse(Newcomers::iterator one, Refusal refusal);
  Newcomer Remove(Newcomers::iterator one);
  void MakeRoomFor(const std::string& peer_key);
  Newcomers::iterator OldestOf(const std::string& peer_key);
  void EndLate();

  const GreeterOptions options;
  const Events events;
  Poller poller;
  Mutex mutex;
  std::vector<Newcomer> arrived DHPMAP_GUARDED_BY(mutex);
  std::atomic<bool> is_stopping = false;

  // Used by the thread only.
  Newcomers newcomers;
  std::map<std::string, std::size_t> num_by_peer;
  std::map<int, Newcomers::iterator> by_descriptor;
  std::thread thread;
};

Greeter::Greeter(const GreeterOptions& options, Events events)
    : impl_(std::make_unique<Impl>(options, std::move(events))) {
  impl_->thread = std::thread([impl = impl_.get()] { impl->Run(); });
}

Greeter::~Greeter() {
  impl_->is_stopping = true;
  impl_->poller.Wake();
  impl_->thread.join();
}

void Greeter::Add(Descriptor socket, PeerIdentity peer, std::shared_ptr<PeerCounts> counts) {
  SslSession session;
  if (impl_->options.tls != nullptr) {
    session = impl_->options.tls->NewSession(impl_->options.protocol);
    if (session == nullptr) return;
  }
  std::string key = PeerKey(peer);
  {
    const MutexLock lock(impl_->mutex);
    impl_->arrived.push_back({.socket = ClientSocket(std::move(socket), std::move(session)),
                              .peer = std::move(peer),
                              .counts = std::move(counts),
                              .peer_key = std::move(key),
                              .until = Clock::now() + impl_->options.within});
  }
  impl_->poller.Wake();
}

void Greeter::Impl::Run() {
  NameThisThread("greet");
  BlockPipeSignal();
  (void)TakeTurns(Turns::kShort);
  while (!is_stopping) {
    int wait_ms = -1;
    if (!newcomers.empty()) {
      const auto left = std::chrono::ceil<std::chrono::milliseconds>(newcomers.front().until - Clock::now());
      wait_ms = static_cast<int>(std::max<std::chrono::milliseconds::rep>(left.count(), 0));
    }
    for (const Poller::Ready& ready : poller.Wait(wait_ms)) {
      const auto found = by_descriptor.find(ready.descriptor);
      if (found != by_descriptor.end()) Listen(found->second);
    }
    TakeIn();
    EndLate();
  }
}

void Greeter::Impl::TakeIn() {
  std::vector<Newcomer> taken;
  {
    const MutexLock lock(mutex);
    taken.swap(arrived);
  }
  for (Newcomer& newcomer : taken) Begin(std::move(newcomer));
}

void Greeter::Impl::Begin(Newcomer newcomer) {
  MakeRoomFor(newcomer.peer_key);
  const int descriptor = newcomer.socket.descriptor();
  ++num_by_peer[newcomer.peer_key];
  newcomers.push_back(std::move(newcomer));
  const auto one = std::prev(newcomers.end());
  by_descriptor[descriptor] = one;
  if (!poller.Add(descriptor, EPOLLIN)) return Refuse(one, Refusal::kOutOfDescriptors);
  Listen(one);  // most have sent everything already
}

void Greeter::Impl::Listen(Newcomers::iterator one) {
  Refusal refusal = Refusal::kNone;
  switch (Hear(*one, refusal)) {
    case Outcome::kLater:
      if (one->waits_to_write != one->socket.wants_to_write()) {
        one->waits_to_write = one->socket.wants_to_write();
        poller.Change(one->socket.descriptor(), one->waits_to_write ? EPOLLIN | EPOLLOUT : EPOLLIN);
      }
      return;
    case Outcome::kDone: {
      Newcomer done = Remove(one);
      std::string local_address = LocalAddress(done.socket.descriptor());
      return events.on_greeted({.socket = std::move(done.socket),
                                .peer = std::move(done.peer),
                                .counts = std::move(done.counts),
                                .local_address = std::move(local_address)});
    }
    case Outcome::kEnd:
    case Outcome::kFailed: return Refuse(one, refusal);
  }
}

Outcome Greeter::Impl::Hear(Newcomer& one, Refusal& refusal) const {
  if (!one.is_shaken) {
    const Outcome shaken = one.socket.Handshake();
    if (shaken != Outcome::kDone) {
      refusal = Refusal::kHandshake;
      return shaken;
    }
    one.is_shaken = true;
    if (ssl_st* session = one.socket.session(); session != nullptr) {
      one.peer.certificate_name = CertificateName(session);
      const unsigned char* selected = nullptr;
      unsigned int num_bytes = 0;
      SSL_get0_alpn_selected(session, &selected, &num_bytes);
      if (options.protocol == Protocol::kHttp2 && num_bytes == 0) {  // the client offered no protocol
        refusal = Refusal::kHandshake;
        return Outcome::kFailed;
      }
    }
  }
  return options.protocol == Protocol::kHttp2 ? HearPreface(one, refusal) : Outcome::kDone;
}

Outcome Greeter::Impl::HearPreface(Newcomer& one, Refusal& refusal) const {
  std::array<char, kHttp2Preface.size()> bytes;
  while (one.num_said < kHttp2Preface.size()) {
    const ClientSocket::Moved read = one.socket.Read(bytes.data(), kHttp2Preface.size() - one.num_said);
    if (read.outcome != Outcome::kDone) return read.outcome;  // disconnected before any byte: no refusal
    if (kHttp2Preface.substr(one.num_said, read.num_bytes) != std::string_view(bytes.data(), read.num_bytes)) {
      refusal = Refusal::kNotHttp2;
      return Outcome::kFailed;
    }
    one.num_said += read.num_bytes;
  }
  return Outcome::kDone;
}

void Greeter::Impl::Refuse(Newcomers::iterator one, Refusal refusal) {
  const Newcomer gone = Remove(one);
  if (refusal != Refusal::kNone) events.on_refused(refusal, gone.peer);
}

Newcomer Greeter::Impl::Remove(Newcomers::iterator one) {
  poller.Remove(one->socket.descriptor());
  by_descriptor.erase(one->socket.descriptor());
  const auto count = num_by_peer.find(one->peer_key);
  if (--count->second == 0) num_by_peer.erase(count);
  Newcomer removed = std::move(*one);
  newcomers.erase(one);
  return removed;
}

void Greeter::Impl::MakeRoomFor(const std::string& peer_key) {
  if (const auto found = num_by_peer.find(peer_key);
      found != num_by_peer.end() && found->second >= options.max_new_per_peer) {
    Refuse(OldestOf(peer_key), Refusal::kTooManyNew);
  } else if (newcomers.size() >= options.max_new) {
    const auto most = std::max_element(num_by_peer.begin(), num_by_peer.end(),
                                       [](const auto& a, const auto& b) { return a.second < b.second; });
    Refuse(OldestOf(most->first), Refusal::kTooManyNew);
  }
}

Newcomers::iterator Greeter::Impl::OldestOf(const std::string& peer_key) {
  return std::find_if(newcomers.begin(), newcomers.end(),
                      [&peer_key](const Newcomer& one) { return one.peer_key == peer_key; });
}

void Greeter::Impl::EndLate() {
  const auto now = Clock::now();
  while (!newcomers.empty() && newcomers.front().until <= now) Refuse(newcomers.begin(), Refusal::kSilent);
}

}  // namespace dhpmap::net

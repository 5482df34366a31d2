// SPDX-License-Identifier: BSD-3-Clause
#include "server/net/relay.h"

#include <atomic>
#include <thread>
#include <unordered_map>
#include <utility>
#include <vector>

#include "mapping/base/mutex.h"
#include "mapping/base/this_thread.h"
#include "server/net/pipe_signal.h"
#include "server/net/poller.h"
#include "server/net/relayed_connection.h"

namespace dhpmap::net {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::size_t kScratch_bytes = 128u << 10;
constexpr std::chrono::milliseconds kLookAtTime{1'000};

struct Running {
  Running(std::uint64_t its_number, ClientSocket client, Descriptor inner, std::unique_ptr<FrameLimits> limits,
          Poller& poller)
      : number(its_number), connection(std::move(client), std::move(inner), std::move(limits), poller) {}

  const std::uint64_t number;
  RelayedConnection connection;
  bool is_to_continue = false;
};

}  // namespace

struct Relay::Impl {
  explicit Impl(OnEnded tell) : on_ended(std::move(tell)) {}

  void WaitUntilEmpty(std::chrono::duration<double> at_most) DHPMAP_EXCLUDES(mutex);
  void Run();
  void TakeIn();
  void ContinueThose();
  void LookAtTime(Clock::time_point now);
  void After(Running& running);
  void End(Running& running);

  const OnEnded on_ended;
  Poller poller;
  std::atomic<bool> is_stopping = false;
  Mutex mutex;
  CondVar changed;
  std::vector<std::unique_ptr<Running>> arrived DHPMAP_GUARDED_BY(mutex);
  std::size_t count DHPMAP_GUARDED_BY(mutex) = 0;

  // Used by the thread only.
  std::unordered_map<std::uint64_t, std::unique_ptr<Running>> by_number;
  std::unordered_map<int, Running*> by_descriptor;
  std::vector<std::uint64_t> to_continue;  // by number, because a connection may have ended by then
  std::vector<char> scratch = std::vector<char>(kScratch_bytes);
  Clock::time_point next_look;
  std::thread thread;
};

Relay::Relay(OnEnded on_ended) : impl_(std::make_unique<Impl>(std::move(on_ended))) {
  impl_->thread = std::thread([impl = impl_.get()] { impl->Run(); });
}

Relay::~Relay() {
  impl_->is_stopping = true;
  impl_->poller.Wake();
  impl_->thread.join();
}

void Relay::Add(std::uint64_t number, ClientSocket client, Descriptor inner, std::unique_ptr<FrameLimits> limits) {
  {
    const MutexLock lock(impl_->mutex);
    impl_->arrived.push_back(
        std::make_unique<Running>(number, std::move(client), std::move(inner), std::move(limits), impl_->poller));
    ++impl_->count;
  }
  impl_->poller.Wake();
}

void Relay::WaitUntilEmpty(std::chrono::duration<double> at_most) { impl_->WaitUntilEmpty(at_most); }

void Relay::Impl::WaitUntilEmpty(std::chrono::duration<double> at_most) {
  const MutexLock lock(mutex);
  (void)changed.WaitFor(mutex, std::chrono::duration_cast<CondVar::Clock::duration>(at_most),
                        [this]() DHPMAP_REQUIRES(mutex) { return count == 0; });
}

void Relay::Impl::Run() {
  NameThisThread("relay");
  BlockPipeSignal();
  (void)TakeTurns(Turns::kShort);
  while (!is_stopping) {
    const int wait_ms = !to_continue.empty() ? 0 : by_number.empty() ? -1 : static_cast<int>(kLookAtTime.count());
    for (const Poller::Ready& ready : poller.Wait(wait_ms)) {
      const auto found = by_descriptor.find(ready.descriptor);
      if (found == by_descriptor.end()) continue;
      Running& running = *found->second;
      running.connection.OnReady(ready.descriptor, ready.events, scratch);
      After(running);
    }
    ContinueThose();
    TakeIn();
    if (const auto now = Clock::now(); now >= next_look) LookAtTime(now);
  }
}

void Relay::Impl::TakeIn() {
  std::vector<std::unique_ptr<Running>> taken;
  {
    const MutexLock lock(mutex);
    taken.swap(arrived);
  }
  for (std::unique_ptr<Running>& one : taken) {
    Running& running = *one;
    by_descriptor[running.connection.client()] = by_descriptor[running.connection.inner()] = &running;
    by_number[running.number] = std::move(one);
    if (!running.connection.Begin()) {
      End(running);
      continue;
    }
    running.connection.Continue(scratch);
    After(running);
  }
}

void Relay::Impl::ContinueThose() {
  for (const std::uint64_t number : std::exchange(to_continue, {})) {
    const auto found = by_number.find(number);
    if (found == by_number.end()) continue;
    found->second->is_to_continue = false;
    found->second->connection.Continue(scratch);
    After(*found->second);
  }
}

void Relay::Impl::LookAtTime(Clock::time_point now) {
  next_look = now + kLookAtTime;
  std::vector<Running*> over;
  for (const auto& [number, running] : by_number) {
    running->connection.AtTime(now);
    if (running->connection.is_over()) over.push_back(running.get());
  }
  for (Running* running : over) End(*running);
}

void Relay::Impl::After(Running& running) {
  if (running.connection.is_over()) return End(running);
  if (running.connection.has_more() && !std::exchange(running.is_to_continue, true))
    to_continue.push_back(running.number);
}

void Relay::Impl::End(Running& running) {
  const std::uint64_t number = running.number;
  const Refusal why = running.connection.refusal();
  by_descriptor.erase(running.connection.client());
  by_descriptor.erase(running.connection.inner());
  by_number.erase(number);
  on_ended(number, why);
  const MutexLock lock(mutex);
  --count;
  changed.NotifyAll();
}

}  // namespace dhpmap::net

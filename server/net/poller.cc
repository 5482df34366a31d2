// SPDX-License-Identifier: BSD-3-Clause
#include "server/net/poller.h"

#include <sys/eventfd.h>

namespace dhpmap::net {

Poller::Poller() : epoll_(::epoll_create1(EPOLL_CLOEXEC)), bell_(::eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK)) {
  Add(bell_.get(), EPOLLIN);
}

bool Poller::Add(int descriptor, std::uint32_t events) {
  epoll_event event{.events = events, .data = {.fd = descriptor}};
  return ::epoll_ctl(epoll_.get(), EPOLL_CTL_ADD, descriptor, &event) == 0;
}

void Poller::Change(int descriptor, std::uint32_t events) {
  epoll_event event{.events = events, .data = {.fd = descriptor}};
  (void)::epoll_ctl(epoll_.get(), EPOLL_CTL_MOD, descriptor, &event);
}

void Poller::Remove(int descriptor) { (void)::epoll_ctl(epoll_.get(), EPOLL_CTL_DEL, descriptor, nullptr); }

std::span<const Poller::Ready> Poller::Wait(int wait_ms) {
  const int count = ::epoll_wait(epoll_.get(), events_.data(), static_cast<int>(events_.size()), wait_ms);
  std::size_t num_ready = 0;
  for (int i = 0; i < count; ++i) {
    const epoll_event& event = events_[static_cast<std::size_t>(i)];
    if (event.data.fd == bell_.get()) {
      eventfd_t rung = 0;
      (void)::eventfd_read(bell_.get(), &rung);
    } else {
      ready_[num_ready++] = {.descriptor = event.data.fd, .events = event.events};
    }
  }
  return std::span(ready_).first(num_ready);
}

void Poller::Wake() { (void)::eventfd_write(bell_.get(), 1); }

}  // namespace dhpmap::net

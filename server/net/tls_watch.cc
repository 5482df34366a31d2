// SPDX-License-Identifier: BSD-3-Clause
#include "server/net/tls_watch.h"

#include <thread>
#include <utility>

#include "mapping/base/this_thread.h"

namespace dhpmap::net {

struct TlsWatch::Impl {
  void Run() DHPMAP_EXCLUDES(mutex) {
    NameThisThread("tls files");
    MutexLock lock(mutex);
    while (!changed.WaitFor(mutex, period, [this]() DHPMAP_REQUIRES(mutex) { return is_stopping; })) {
      lock.Unlock();
      if (const auto status = tls->ReloadIfChanged()) on_reload(*status);
      lock.Lock();
    }
  }

  std::shared_ptr<TlsContext> tls;
  std::chrono::milliseconds period;
  std::function<void(const Status&)> on_reload;
  Mutex mutex;
  CondVar changed;
  bool is_stopping DHPMAP_GUARDED_BY(mutex) = false;
  std::thread thread;
};

TlsWatch::TlsWatch(std::shared_ptr<TlsContext> tls, std::chrono::milliseconds period,
                   std::function<void(const Status&)> on_reload)
    : impl_(std::make_unique<Impl>()) {
  impl_->tls = std::move(tls);
  impl_->period = period;
  impl_->on_reload = std::move(on_reload);
  impl_->thread = std::thread([impl = impl_.get()] { impl->Run(); });
}

TlsWatch::~TlsWatch() {
  {
    const MutexLock lock(impl_->mutex);
    impl_->is_stopping = true;
    impl_->changed.NotifyAll();
  }
  impl_->thread.join();
}

}  // namespace dhpmap::net

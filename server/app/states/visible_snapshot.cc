// SPDX-License-Identifier: BSD-3-Clause
#include "server/app/states/visible_snapshot.h"

#include <utility>

#include "mapping/base/guarded.h"

namespace dhpmap {

VisibleSnapshot::VisibleSnapshot(std::shared_ptr<const MapView> first, Prepare prepare)
    : prepare_(std::move(prepare)), shown_(std::move(first)) {}

std::shared_ptr<const MapView> VisibleSnapshot::Get() const {
  const MutexLock lock(mutex_);
  return shown_;
}

std::shared_ptr<const MapView> VisibleSnapshot::Newest() const {
  const MutexLock lock(mutex_);
  return waiting_ != nullptr ? waiting_ : shown_;
}

bool VisibleSnapshot::IsWaiting() const {
  const MutexLock lock(mutex_);
  return waiting_ != nullptr;
}

void VisibleSnapshot::Show(std::shared_ptr<const MapView> next) {
  const auto state = next->shared_snapshot();
  std::shared_ptr<const MapView> waiting;
  {
    const MutexLock lock(mutex_);
    if (shown_->shared_snapshot() == state) return;  // the existing view has more cached data
    shown_.swap(next);
    waiting_.swap(waiting);
  }
  if (prepare_) TellSafely([&] { (void)prepare_(state, {}); });
}

void VisibleSnapshot::ShowPrepared(std::shared_ptr<const MapView> next) {
  if (Newest() == next) return;
  ShowNewest();
  {
    const MutexLock lock(mutex_);
    waiting_ = next;
  }
  const std::weak_ptr<const MapView> view = next;
  bool is_taken = false;
  if (prepare_) {
    TellSafely([&] {
      is_taken = prepare_(next->shared_snapshot(), [self = weak_from_this(), view] {
        if (const auto shown = self.lock()) shown->OnPrepared(view);
      });
    });
  }
  if (!is_taken) OnPrepared(view);
}

void VisibleSnapshot::ShowNewest() { OnPrepared(Newest()); }

void VisibleSnapshot::OnPrepared(const std::weak_ptr<const MapView>& view) {
  auto prepared = view.lock();
  std::shared_ptr<const MapView> before;
  const MutexLock lock(mutex_);
  if (prepared == nullptr || waiting_ != prepared) return;
  before = std::exchange(shown_, std::move(waiting_));
  waiting_ = nullptr;
}

}  // namespace dhpmap

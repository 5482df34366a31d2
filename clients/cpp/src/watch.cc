// SPDX-License-Identifier: BSD-3-Clause
#include "dhpmap/watch.h"

#include <algorithm>
#include <utility>

#include "clients/cpp/src/convert/changes.h"
#include "clients/cpp/src/convert/geometry.h"
#include "clients/cpp/src/watch_impl.h"

namespace dhpmap::client {
namespace {

constexpr double kProgress_s = 5;  // short, to detect a lost connection soon
constexpr double kForever_s = 3e7;

v1::WatchMapRequest RequestOf(const std::string& map, const WatchOptions& options) {
  v1::WatchMapRequest request;
  request.set_map(map);
  request.set_progress_interval_s(kProgress_s);
  request.set_resume_after(options.resume_after);
  if (options.after_revision) request.set_start_revision(*options.after_revision + 1);
  v1::WatchFilter& filter = *request.mutable_filter();
  for (const std::int64_t id : options.objects) filter.add_instance_ids(id);
  for (const std::string& name : options.classes) filter.add_class_names(name);
  if (options.region) *filter.mutable_region() = ToProto(*options.region);
  return request;
}

}  // namespace

Watch::Impl::Impl(std::shared_ptr<Caller> caller, const std::string& map, const WatchOptions& options)
    : messages_(std::move(caller), RequestOf(map, options), options.reconnect_s, [this](const Status&) {
        unfinished_.clear();  // the server sends these again
        return true;
      }) {}

Result<std::optional<Change>> Watch::Impl::Next(double idle_s) {
  const Clock::time_point end = Clock::now() + Seconds(idle_s < 0 ? kForever_s : idle_s);
  while (told_.empty()) {
    const auto message = messages_.Next(end);
    if (!message.ok()) return message.status();
    if (!*message) return std::optional<Change>();
    Take(**message);
  }
  std::optional<Change> change = std::move(told_.front());
  told_.pop_front();
  return change;
}

void Watch::Impl::Take(const v1::WatchMapResponse& message) {
  const bool is_last = !message.position().empty();
  for (const v1::SubmapEvent& event : message.change().submaps()) {
    unfinished_.push_back(ChangeOf(event, message.change().last_revision()));
  }
  if (message.has_progress()) revision_ = std::max(revision_, message.progress().revision());
  if (!is_last) return;
  if (message.has_change()) revision_ = message.change().last_revision();
  for (Change& change : unfinished_) {
    change.position = message.position();
    told_.push_back(std::move(change));
  }
  unfinished_.clear();
}

Watch::Watch(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
Watch::Watch(Watch&&) noexcept = default;
Watch& Watch::operator=(Watch&&) noexcept = default;
Watch::~Watch() = default;
Result<std::optional<Change>> Watch::Next(double idle_s) { return impl_->Next(idle_s); }
std::int64_t Watch::revision() const { return impl_->revision(); }
void Watch::Close() { impl_->Close(); }

}  // namespace dhpmap::client

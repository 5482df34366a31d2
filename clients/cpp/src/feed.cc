// SPDX-License-Identifier: BSD-3-Clause
#include "dhpmap/feed.h"

#include <algorithm>
#include <utility>

#include "clients/cpp/calls/error.h"
#include "clients/cpp/calls/pages.h"
#include "clients/cpp/src/convert/frames.h"
#include "clients/cpp/src/feed_impl.h"

namespace dhpmap::client {
namespace {

/// The last sequence that the session has accepted; 0: none.
Result<std::int64_t> LastTaken(Caller& caller, const std::string& map, const std::string& session) {
  v1::ListSessionsRequest request;
  request.set_parent(map);
  const auto all = ReadAllPages(caller, &v1::MappingService::Stub::ListSessions, request);
  if (!all.ok()) return all.status();
  std::int64_t last = 0;
  for (const v1::FeedSession& its : all->sessions()) {
    if (its.session() == session) last = std::max(last, its.accepted_sequence());
  }
  return last;
}

}  // namespace

Result<std::unique_ptr<Feed::Impl>> Feed::Impl::Open(const std::shared_ptr<Caller>& caller, const std::string& map,
                                                     const FeedOptions& options) {
  if (options.session.empty()) return BadArgument("session", "is missing: the robot's name");
  auto impl = std::make_unique<Impl>();
  impl->options = options;
  impl->stream = std::make_unique<FrameStream>(caller, map, options);
  if (Status status = impl->stream->WaitUntilGreeted(); !status.ok()) return status;
  const Result<std::int64_t> taken = LastTaken(*caller, map, options.session);
  if (!taken.ok()) return taken.status();
  impl->next = 1 + std::max(impl->stream->state().stored_sequence.value_or(0), *taken);
  return impl;
}

Result<std::int64_t> Feed::Impl::Push(Result<v1::Frame> frame, std::int64_t stamp_ns) {
  if (!frame.ok()) return frame.status();
  frame->set_persistent_ids(options.persistent_ids);
  if (Status status = stream->Push(next, *std::move(frame)); !status.ok()) return status;
  last_stamp_ns = stamp_ns;
  return next++;
}

Feed::Feed(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
Feed::Feed(Feed&&) noexcept = default;
Feed& Feed::operator=(Feed&&) noexcept = default;
Feed::~Feed() = default;

Result<std::int64_t> Feed::Push(const RgbdFrame& frame) {
  if (Status status = CheckCamera(impl_->options.camera); !status.ok()) return status;
  return impl_->Push(ToProto(frame, impl_->options.camera, impl_->last_stamp_ns), frame.stamp_ns);
}

Result<std::int64_t> Feed::Push(const LidarFrame& frame) {
  return impl_->Push(ToProto(frame, impl_->last_stamp_ns), frame.stamp_ns);
}

Status Feed::Close() { return impl_->stream->Close(); }
FeedState Feed::state() const { return impl_->stream->state(); }
std::vector<FrameNote> Feed::TakeNotes() { return impl_->stream->TakeNotes(); }

}  // namespace dhpmap::client

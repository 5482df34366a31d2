// SPDX-License-Identifier: BSD-3-Clause
#include "server/grpc/revision_waits.h"

#include <grpcpp/alarm.h>

#include <algorithm>
#include <utility>

#include "server/app/states/etag.h"
#include "server/grpc/passing_time.h"

namespace dhpmap {

/// Owns itself: its alarm or the lane holds it until it is done.
class RevisionWaits::Wait : public std::enable_shared_from_this<Wait> {
 public:
  Wait(const RevisionWaits& waits, Wanted wanted, TimePoint deadline, std::stop_token stop,
       std::function<void(const Status&)> done)
      : context_(waits.context_),
        num_waiting_(waits.num_waiting_),
        wanted_(std::move(wanted)),
        deadline_(deadline),
        stop_(std::move(stop)),
        done_(std::move(done)) {}
  ~Wait() { --*num_waiting_; }

  void Look() {
    alarm_.reset();  // it holds a reference to this
    bool is_over = true;
    const Status status = RunGuarded([&]() -> Status {
      if (stop_.stop_requested()) return Cancelled("the client went away, or its deadline has passed");
      MapRegistry& maps = context_.registry;
      DHPMAP_ASSIGN_OR_RETURN(const auto view,
                              wanted_.is_eventual ? maps.EventualViewOf(wanted_.map) : maps.ViewOf(wanted_.map));
      const std::int64_t now = view->snapshot().revision();
      is_over = now >= wanted_.revision;
      if (is_over) {
        return CheckNotLost(wanted_.revision, *maps.LostRevisionsOf(wanted_.map), view->snapshot().info(),
                            "options.min_revision");
      }
      if (TimePoint::clock::now() < deadline_) return Status::Ok();
      is_over = true;
      return Status(StatusCode::kDeadlineExceeded, "the map is at revision " + std::to_string(now))
          .WithViolation("options.min_revision", "was not reached in time");
    });
    if (is_over) return done_(status);
    constexpr std::chrono::milliseconds kBetween{10};
    alarm_ = std::make_unique<grpc::Alarm>();
    alarm_->Set(GrpcTimeIn(kBetween),
                [self = shared_from_this()](bool) { self->context_.lanes.quick.Post([self] { self->Look(); }); });
  }

 private:
  const ServiceContext& context_;
  const std::shared_ptr<std::atomic<int>> num_waiting_;
  const Wanted wanted_;
  const TimePoint deadline_;
  const std::stop_token stop_;
  const std::function<void(const Status&)> done_;
  std::unique_ptr<grpc::Alarm> alarm_;
};

void RevisionWaits::Await(Wanted wanted, TimePoint deadline, std::stop_token stop,
                          std::function<void(const Status&)> done) {
  if (num_waiting_->fetch_add(1) >= kMost) {
    --*num_waiting_;
    return done(TooBusy());
  }
  const TimePoint latest = TimePoint::clock::now() + kLongest;
  std::make_shared<Wait>(*this, std::move(wanted), std::min(deadline, latest), std::move(stop), std::move(done))
      ->Look();
}

}  // namespace dhpmap

// SPDX-License-Identifier: BSD-3-Clause
#include "server/gateway/page_exchange.h"

#include <utility>

#include "mapping/base/guarded.h"
#include "mapping/base/result.h"
#include "server/base/lane.h"
#include "server/gateway/error_body.h"

namespace dhpmap::gateway {
namespace {

class PageExchange final : public http::Exchange, public std::enable_shared_from_this<PageExchange> {
 public:
  explicit PageExchange(std::shared_ptr<http::Responder> responder) : responder_(std::move(responder)) {}

  void Start(std::function<http::Response()> make, Lane& lane) {
    making_ = std::make_shared<LaneTask>([self = shared_from_this(), make = std::move(make)] {
      auto page = Guarded<Result<http::Response>>(make);
      if (!page.ok()) page = ErrorResponse(page.status(), AnswerFormat::kAny);
      self->responder_->Post([self, page = *std::move(page)]() mutable {
        if (!self->is_closed_) self->responder_->Reply(std::move(page));
      });
    });
    lane.Post(making_);  // at most one per connection
  }

  bool OnBody(std::string_view) override { return true; }
  void OnBodyEnd() override {}
  void OnWritten() override {}
  void OnClosed() override {
    is_closed_ = true;
    making_->GiveUp();
  }

 private:
  const std::shared_ptr<http::Responder> responder_;
  std::shared_ptr<LaneTask> making_;
  bool is_closed_ = false;  // on the connection's sequence of execution
};

}  // namespace

std::shared_ptr<http::Exchange> MakePageExchange(std::function<http::Response()> make, Lane& lane,
                                                 std::shared_ptr<http::Responder> responder) {
  auto exchange = std::make_shared<PageExchange>(std::move(responder));
  exchange->Start(std::move(make), lane);
  return exchange;
}

}  // namespace dhpmap::gateway

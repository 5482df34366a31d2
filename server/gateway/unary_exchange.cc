// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/base/byte_budget.h"
#include "server/gateway/call_options.h"
#include "server/gateway/error_body.h"
#include "server/gateway/rpc_call.h"
#include "server/gateway/rpc_exchange.h"
#include "server/gateway/rpc_request.h"
#include "server/gateway/transcoder.h"

namespace dhpmap::gateway {
namespace {

class UnaryExchange final : public http::Exchange, public std::enable_shared_from_this<UnaryExchange> {
 public:
  UnaryExchange(RpcRequest request, ByteShare share, RpcCaller* caller, std::shared_ptr<http::Responder> responder)
      : request_(std::move(request)), share_(std::move(share)), caller_(caller), responder_(std::move(responder)) {}

  bool OnBody(std::string_view data) override {
    if (finished_) return true;
    if (body_.size() + data.size() > request_.max_body_bytes) {
      Reply(ErrorResponse(
          ResourceExhausted("the body is larger than " + std::to_string(request_.max_body_bytes) + " bytes")
              .WithReason("BODY_TOO_LARGE"),
          request_.answer_format));
      return true;
    }
    if (body_.size() + data.size() > share_.bytes() && !share_.Resize(body_.size() + data.size())) {
      Reply(ErrorResponse(TooManyBytes(), request_.answer_format));
      return true;
    }
    body_ += data;
    return true;
  }

  void OnBodyEnd() override {
    if (finished_) return;
    auto message = request_.transcoder.ToRequest(request_.body_format, body_);
    std::string().swap(body_);
    if (!message.ok()) return Reply(ErrorResponse(message.status(), request_.answer_format));
    if (!share_.Resize(message->size())) return Reply(ErrorResponse(TooManyBytes(), request_.answer_format));
    call_ = caller_->StartUnary(request_.call, std::move(*message),
                                [self = shared_from_this()](const RpcStatus& status, std::string response) {
                                  // On gRPC's thread: the JSON is made here, the connections' thread stays free.
                                  auto answer = self->MakeAnswer(status, std::move(response));
                                  self->responder_->Post([self, answer = std::move(answer)]() mutable {
                                    if (self->finished_) return;
                                    if (!self->share_.Resize(answer.body.size())) {
                                      answer = ErrorResponse(TooManyBytes(), self->request_.answer_format);
                                    }
                                    self->Reply(std::move(answer));
                                  });
                                });
  }

  void OnWritten() override {}
  void OnClosed() override {
    finished_ = true;
    if (call_) call_->Cancel();
    call_.reset();
  }

 private:
  http::Response MakeAnswer(const RpcStatus& status, std::string message) const {
    if (!status.ok()) return ErrorResponse(status, request_.answer_format);
    auto body = ToAnswer(*request_.route, std::move(message), request_.answer_format);
    if (!body.ok()) return ErrorResponse(body.status(), request_.answer_format);
    http::Response response;
    const bool is_protobuf = request_.answer_format == AnswerFormat::kProtobuf;
    response.headers.emplace_back("Content-Type", is_protobuf ? kProtobufType : kJsonType);
    response.body = std::move(*body);
    if (!is_protobuf) response.body += '\n';
    return response;
  }

  void Reply(http::Response response) {
    finished_ = true;
    call_.reset();
    response.headers.emplace_back("X-Request-Id", RequestIdOf(request_.call));
    responder_->Reply(std::move(response));
  }

  const RpcRequest request_;
  ByteShare share_;  // of the body, the message, then the answer until it is written
  RpcCaller* const caller_;
  const std::shared_ptr<http::Responder> responder_;
  std::string body_;
  std::shared_ptr<UnaryCall> call_;
  bool finished_ = false;
};

}  // namespace

std::shared_ptr<http::Exchange> MakeUnaryExchange(RpcRequest request, ByteShare share, RpcCaller* caller,
                                                  std::shared_ptr<http::Responder> responder) {
  return std::make_shared<UnaryExchange>(std::move(request), std::move(share), caller, std::move(responder));
}

}  // namespace dhpmap::gateway

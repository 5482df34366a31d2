// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/base/guarded.h"
#include "server/base/byte_budget.h"
#include "server/base/lane.h"
#include "server/gateway/body_room.h"
#include "server/gateway/call_options.h"
#include "server/gateway/error_body.h"
#include "server/gateway/rpc_call.h"
#include "server/gateway/rpc_exchange.h"
#include "server/gateway/rpc_request.h"
#include "server/gateway/stream_encoder.h"
#include "server/gateway/transcoder.h"

namespace dhpmap::gateway {
namespace {

class UnaryExchange final : public http::Exchange, public std::enable_shared_from_this<UnaryExchange> {
 public:
  UnaryExchange(RpcRequest request, ByteShare share, RpcBackend backend, std::shared_ptr<http::Responder> responder)
      : request_(std::move(request)), share_(std::move(share)), backend_(backend), responder_(std::move(responder)) {
    body_.reserve(share_.bytes());  // the announced size; growing would hold two copies
  }

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
    if (body_.size() <= kMostQuickBytes) return Start(MakeMessage(std::move(body_)));
    parsing_ = std::make_shared<LaneTask>([self = shared_from_this(), body = std::move(body_)]() mutable {
      auto message = self->MakeMessage(std::move(body));
      self->responder_->Post([self, message = std::move(message)]() mutable { self->Start(std::move(message)); });
    });
    backend_.bulk->Post(parsing_);  // at most one per connection
  }

  void OnWritten() override {}
  void OnClosed() override {
    finished_ = true;
    if (parsing_) parsing_->GiveUp();
    if (call_) call_->Cancel();
    call_.reset();
  }

 private:
  /// On any thread. Frees the body before it returns.
  [[nodiscard]] Result<std::string> MakeMessage(std::string body) const {
    BodyRoom room(share_.Another(), body.size());
    return Guarded<Result<std::string>>([&] {
      return request_.transcoder.ToRequest(request_.body_format, body,
                                           [&room](std::size_t num_bytes) { return room.Hold(num_bytes); });
    });
  }

  void Start(Result<std::string> message) {
    if (finished_) return;
    if (!message.ok()) return Reply(ErrorResponse(message.status(), request_.answer_format));
    if (!share_.Resize(message->size())) return Reply(ErrorResponse(TooManyBytes(), request_.answer_format));
    call_ = backend_.caller->StartUnary(
        request_.call, std::move(*message),
        [self = shared_from_this()](RpcStatus status, std::string response) {  // on gRPC's thread
          if (response.size() <= kMostQuickBytes) return self->Ended(status, std::move(response));
          if (!self->share_.Resize(response.size())) return self->Ended(ToRpcStatus(TooManyBytes()), "");
          self->backend_.bulk->Post([self, status = std::move(status), response = std::move(response)]() mutable {
            self->Ended(status, std::move(response));
          });
        });
  }

  /// On any thread except the connection's, so that making JSON does not block that.
  void Ended(const RpcStatus& status, std::string response) {
    responder_->Post([self = shared_from_this(), answer = AnswerOrWhyNot(status, std::move(response))]() mutable {
      if (self->finished_) return;
      if (!self->share_.Resize(answer.body.size())) {
        answer = ErrorResponse(TooManyBytes(), self->request_.answer_format);
      }
      self->Reply(std::move(answer));
    });
  }

  http::Response AnswerOrWhyNot(const RpcStatus& status, std::string message) const {
    auto answer = Guarded<Result<http::Response>>([&] { return MakeAnswer(status, std::move(message)); });
    return answer.ok() ? *std::move(answer) : ErrorResponse(answer.status(), request_.answer_format);
  }

  http::Response MakeAnswer(const RpcStatus& status, std::string message) const {
    if (!status.ok()) return ErrorResponse(status, request_.answer_format);
    if (request_.route->file && request_.answer_format == AnswerFormat::kAny) {
      auto file = FilePartOf(*request_.route, message);
      if (!file.ok()) return ErrorResponse(file.status(), request_.answer_format);
      const Status accepted = file->type.empty() ? Status::Ok() : CheckAccepted(request_.accept, *file);
      if (!accepted.ok()) return ErrorResponse(accepted, request_.answer_format);
      if (!file->type.empty()) return FileAnswer(std::move(*file));
    }
    auto body = ToAnswer(*request_.route, std::move(message), request_.answer_format);
    if (!body.ok()) return ErrorResponse(body.status(), request_.answer_format);
    http::Response response;
    const bool is_protobuf = request_.answer_format == AnswerFormat::kProtobuf;
    response.headers.emplace_back("Content-Type", is_protobuf ? kProtobufType : kJsonType);
    response.body = std::move(*body);
    if (!is_protobuf) response.body += '\n';
    return response;
  }

  [[nodiscard]] http::Response FileAnswer(FilePart file) const {
    http::Response response;
    response.headers = FileHead(std::move(file.type), request_.file_stem);
    response.body = std::move(file.data);
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
  const RpcBackend backend_;
  const std::shared_ptr<http::Responder> responder_;
  std::string body_;
  std::shared_ptr<LaneTask> parsing_;  // of a large body; null: none
  std::shared_ptr<UnaryCall> call_;
  bool finished_ = false;
};

}  // namespace

std::shared_ptr<http::Exchange> MakeUnaryExchange(RpcRequest request, ByteShare share, RpcBackend backend,
                                                  std::shared_ptr<http::Responder> responder) {
  return std::make_shared<UnaryExchange>(std::move(request), std::move(share), backend, std::move(responder));
}

}  // namespace dhpmap::gateway

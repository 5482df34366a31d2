// SPDX-License-Identifier: BSD-3-Clause
#include "server/rest/call_options.h"
#include "server/rest/message_splitter.h"
#include "server/rest/rpc_exchange.h"
#include "server/rest/stream_encoder.h"

namespace dhpmap::rest {
namespace {

/// Answers kept while the connection is busy, before the RPC has to wait. More while the body is still coming: a client
/// that reads only after it has sent everything must not block itself.
constexpr std::size_t kWindow_bytes = 256u << 10;
constexpr std::size_t kWindowWhileReceiving_bytes = 16u << 20;

/// All members are used on the connection's sequence of execution, but for the encoder: that is gRPC's.
class StreamExchange final : public Exchange,
                             public StreamListener,
                             public std::enable_shared_from_this<StreamExchange> {
 public:
  StreamExchange(RpcRequest request, RpcCaller* caller, std::shared_ptr<Responder> responder)
      : request_(std::move(request)),
        caller_(caller),
        responder_(std::move(responder)),
        splitter_(request_.body_format, request_.route->client_streams(), request_.max_body_bytes),
        encoder_(*request_.route, request_.answer_format, request_.file_stem) {}

  // From the connection.
  bool OnBody(std::string_view data) override;
  void OnBodyEnd() override;
  void OnWritten() override;
  void OnClosed() override;

  // From gRPC, on its threads.
  void OnMessage(std::string message) override {
    auto part = encoder_.Encode(message);
    PostToConnection([part = std::move(part)](StreamExchange& self) mutable { self.Answered(std::move(part)); });
  }
  void OnReadEnd() override {
    PostToConnection([](StreamExchange& self) { self.ReadEnded(); });
  }
  void OnSent(bool ok) override {
    PostToConnection([ok](StreamExchange& self) { self.Sent(ok); });
  }
  void OnDone(RpcStatus status) override {
    PostToConnection([status = std::move(status)](StreamExchange& self) mutable { self.Done(std::move(status)); });
  }

 private:
  template <typename Task>
  void PostToConnection(Task task) {
    responder_->Post([self = shared_from_this(), task = std::move(task)]() mutable { task(*self); });
  }

  void StartCall();
  void Pump();
  bool SendNext();
  void StopSending(Status why, int http_status);
  void Sent(bool ok);
  void Answered(Result<StreamPart> part);
  void ReadEnded();
  void Done(RpcStatus status);
  void ReadMore();
  void Deliver();
  void EndIfDone();
  void Abandon();

  const RpcRequest request_;
  RpcCaller* const caller_;
  const std::shared_ptr<Responder> responder_;

  MessageSplitter splitter_;
  StreamEncoder encoder_;
  std::shared_ptr<StreamCall> call_;
  std::int64_t num_messages_ = 0;
  bool sending_ = false;
  bool send_ended_ = false;  // half-closed, or never to send again
  bool reading_ = false;
  bool read_ended_ = false;
  bool wants_body_ = false;  // OnBody returned false

  HttpResponse head_;
  std::optional<std::uint64_t> length_;
  std::string pending_;  // encoded, not handed to the connection yet
  std::uint64_t num_answered_bytes_ = 0;
  bool begun_ = false;
  bool writing_ = false;
  bool rpc_done_ = false;
  bool ended_ = false;  // nothing more goes to the connection
  RpcStatus final_;
  std::optional<std::pair<Status, int>> own_error_;  // what is wrong with the body, and its HTTP status or 0
};

bool StreamExchange::OnBody(std::string_view data) {
  if (ended_ || send_ended_) return true;  // an answer is on its way: the rest is let go
  splitter_.Add(data);
  Pump();
  wants_body_ = sending_;
  return !sending_;
}

void StreamExchange::OnBodyEnd() {
  splitter_.AddEnd();
  if (!ended_ && !send_ended_) Pump();
}

void StreamExchange::StartCall() {
  call_ = caller_->StartStream(request_.call, shared_from_this());
  ReadMore();
}

/// Sends the next message, or the end, if there is one and the last has gone.
void StreamExchange::Pump() {
  if (sending_ || send_ended_ || SendNext()) return;
  if (splitter_.is_too_large()) {
    StopSending(ResourceExhausted("message " + std::to_string(num_messages_ + 1) + " of the body is larger than " +
                                  std::to_string(request_.max_body_bytes) + " bytes")
                    .WithReason("BODY_TOO_LARGE"),
                413);
  } else if (splitter_.is_broken()) {
    StopSending(InvalidArgument("message " + std::to_string(num_messages_ + 1) + " of the body is cut off")
                    .WithReason("MALFORMED_PROTOBUF"),
                0);
  } else if (splitter_.ended()) {
    if (!call_) StartCall();
    send_ended_ = true;
    call_->SendEnd();
  }
}

/// False if there is no complete message; true if it went, or was no good.
bool StreamExchange::SendNext() {
  auto body = splitter_.Next();
  if (!body) return false;
  ++num_messages_;
  auto message = request_.transcoder.ToRequest(request_.body_format, *body);
  if (!message.ok()) {
    Status status = message.status();
    if (request_.route->client_streams()) {
      Status numbered(status.code(), "message " + std::to_string(num_messages_) + ": " + status.message());
      numbered.WithReason(status.reason());
      for (const auto& violation : status.violations()) numbered.AddViolation(violation.field, violation.description);
      status = std::move(numbered);
    }
    StopSending(std::move(status), 0);
    return true;
  }
  if (!call_) StartCall();
  sending_ = true;
  call_->Send(std::move(*message));
  return true;
}

/// The body is no good from here on. What the RPC took before stands: it ends in good order, then comes the error.
void StreamExchange::StopSending(Status why, int http_status) {
  own_error_.emplace(std::move(why), http_status);
  send_ended_ = true;
  if (call_) return call_->SendEnd();
  rpc_done_ = read_ended_ = true;
  final_ = ToRpcStatus(own_error_->first);
  EndIfDone();
}

void StreamExchange::Sent(bool ok) {
  sending_ = false;
  if (!ok) send_ended_ = true;  // the RPC has ended; its status says why
  if (ended_) return;
  Pump();
  if (wants_body_ && !sending_) {
    wants_body_ = false;
    responder_->ResumeBody();
  }
}

void StreamExchange::ReadMore() {
  if (reading_ || read_ended_) return;
  const std::size_t window = splitter_.ended() ? kWindow_bytes : kWindowWhileReceiving_bytes;
  if (!ended_ && pending_.size() >= window) return;
  reading_ = true;
  call_->Read();
}

void StreamExchange::Answered(Result<StreamPart> part) {
  reading_ = false;
  if (ended_) return ReadMore();
  if (!part.ok()) {
    own_error_.emplace(part.status(), 0);
    call_->Cancel();
    return ReadMore();
  }
  if (part->head) {
    head_.headers = std::move(part->head->headers);
    length_ = part->head->length;
  }
  num_answered_bytes_ += part->data.size();
  if (length_ && num_answered_bytes_ > *length_) {  // the announced size was wrong: cut the answer off
    own_error_.emplace(Internal("the answer is larger than announced"), 0);
    call_->Cancel();
    return ReadMore();
  }
  if (part->head && !begun_) {
    begun_ = true;
    head_.headers.emplace_back("X-Request-Id", RequestIdOf(request_.call));
    responder_->BeginStream(std::move(head_), length_);
    if (request_.is_head) {
      ended_ = true;
      responder_->EndStream(true);
      call_->Cancel();
      return ReadMore();
    }
  }
  pending_ += part->data;
  Deliver();
  ReadMore();
}

void StreamExchange::Deliver() {
  if (writing_ || ended_ || pending_.empty()) return;
  writing_ = true;
  std::string data;
  data.swap(pending_);
  responder_->Chunk(std::move(data));
}

void StreamExchange::OnWritten() {
  writing_ = false;
  Deliver();
  if (call_) ReadMore();
  EndIfDone();
}

void StreamExchange::ReadEnded() {
  reading_ = false;
  read_ended_ = send_ended_ = true;
  call_->Finish();
}

void StreamExchange::Done(RpcStatus status) {
  rpc_done_ = true;
  call_.reset();
  if (ended_) return;
  // Not ours to overrule what the RPC itself found wrong, unless we made it fail.
  const bool ours = own_error_ && (status.ok() || status.code == static_cast<int>(StatusCode::kCancelled));
  final_ = ours ? ToRpcStatus(own_error_->first) : std::move(status);
  if (!ours) own_error_.reset();
  if (begun_ && !final_.ok() && encoder_.is_text()) pending_ += ErrorLine(final_);
  Deliver();
  EndIfDone();
}

void StreamExchange::EndIfDone() {
  if (!rpc_done_ || ended_ || writing_ || !pending_.empty()) return;
  ended_ = true;
  if (begun_) {
    const bool whole = !length_ || num_answered_bytes_ == *length_;
    return responder_->EndStream(whole && (final_.ok() || encoder_.is_text()));
  }
  if (!final_.ok()) {
    HttpResponse error = ErrorResponse(final_, request_.answer_format, own_error_ ? own_error_->second : 0);
    error.headers.emplace_back("X-Request-Id", RequestIdOf(request_.call));
    return responder_->Reply(std::move(error));
  }
  HttpResponse empty;
  empty.headers = encoder_.EmptyHead();
  empty.headers.emplace_back("X-Request-Id", RequestIdOf(request_.call));
  responder_->Reply(std::move(empty));
}

void StreamExchange::OnClosed() {
  ended_ = send_ended_ = true;
  std::string().swap(pending_);
  if (!call_) return;
  call_->Cancel();
  ReadMore();  // until the end of reads: the RPC cannot go before
}

}  // namespace

std::shared_ptr<Exchange> MakeStreamExchange(RpcRequest request, RpcCaller* caller,
                                             std::shared_ptr<Responder> responder) {
  return std::make_shared<StreamExchange>(std::move(request), caller, std::move(responder));
}

}  // namespace dhpmap::rest

// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/base/guarded.h"
#include "proto/types/metadata_keys.h"
#include "server/base/byte_budget.h"
#include "server/base/lane.h"
#include "server/base/state_machine.h"
#include "server/gateway/body_room.h"
#include "server/gateway/call_options.h"
#include "server/gateway/content_encoding.h"
#include "server/gateway/error_body.h"
#include "server/gateway/message_splitter.h"
#include "server/gateway/rpc_call.h"
#include "server/gateway/rpc_exchange.h"
#include "server/gateway/rpc_request.h"
#include "server/gateway/stream_encoder.h"
#include "server/gateway/stream_state.h"

namespace dhpmap::gateway {
namespace {

/// Bytes of answers to buffer while the connection is busy, before the RPC has to wait. The limit is higher while the
/// body is still arriving: a client that reads only after it has sent everything must not block itself.
constexpr std::size_t kWindow_bytes = 256u << 10;
constexpr std::size_t kWindowWhileReceiving_bytes = 16u << 20;

/// The error with the number of the message that caused it.
Status Numbered(std::int64_t message, const Status& error) {
  Status numbered(error.code(), "message " + std::to_string(message) + ": " + error.message());
  numbered.WithReason(error.reason());
  for (const auto& violation : error.violations()) numbered.AddViolation(violation.field, violation.description);
  return numbered;
}

/// Members are used on the connection's sequence of execution, except the request, which is constant, and the encoder:
/// it is used by the thread that holds the current message, gRPC's or the lane's, one at a time.
class StreamExchange final : public http::Exchange,
                             public StreamListener,
                             public std::enable_shared_from_this<StreamExchange> {
 public:
  StreamExchange(RpcRequest request, ByteShare share, RpcBackend backend, std::shared_ptr<http::Responder> responder)
      : request_(std::move(request)),
        share_(std::move(share)),
        backend_(backend),
        responder_(std::move(responder)),
        splitter_(request_.body_format, request_.route->client_streams(), request_.max_body_bytes),
        encoder_(*request_.route, request_.answer_format, request_.file_stem, backend_.shared, request_.accept,
                 request_.takes_gzip) {}

  // Called by the connection.
  bool OnBody(std::string_view data) override;
  void OnBodyEnd() override;
  void OnWritten() override;
  void OnPeerEnded() override;
  void OnClosed() override;

  // Called by gRPC, on its threads.
  void OnMessage(std::string message) override {
    if (message.size() <= kMostQuickBytes) return Encode(message);
    backend_.bulk->Post([self = shared_from_this(), message = std::move(message)] { self->Encode(message); });
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
  void Encode(const std::string& message) {
    auto part = encoder_.Encode(message);
    PostToConnection([part = std::move(part)](StreamExchange& self) mutable { self.Answered(std::move(part)); });
  }

  template <typename Task>
  void PostToConnection(Task task) {
    responder_->Post([self = shared_from_this(), task = std::move(task)]() mutable { task(*self); });
  }

  void StartCall(bool is_one_message);
  void Pump();
  bool SendNext();
  std::optional<std::string> NextMessage();
  [[nodiscard]] Result<std::string> MakeMessage(const std::string& body) const;
  void ConvertOnLane(std::string body, bool is_only);
  void Converted(Result<std::string> message, bool is_only);
  void Send(Result<std::string> message, bool is_only);
  void StopSending(Status why);
  void EndSending();
  void Sent(bool ok);
  void Answered(Result<StreamPart> part);
  void Take(Result<StreamPart> part);
  void NotModified(http::Headers headers);
  void Fail(Status why);
  void ReadEnded();
  void Done(RpcStatus status);
  void ReadMore();
  bool FitsShare();
  void Deliver();
  void EndIfDone();

  const RpcRequest request_;
  ByteShare share_;  // of the buffered parts of body and answer
  const RpcBackend backend_;
  const std::shared_ptr<http::Responder> responder_;

  MessageSplitter splitter_;
  std::uint64_t num_received_bytes_ = 0;
  std::optional<std::string> first_;  // complete, but more messages may follow
  StreamEncoder encoder_;
  std::shared_ptr<LaneTask> converting_;  // a large message; null: none
  std::size_t converting_bytes_ = 0;      // bytes of its body while it is held
  std::shared_ptr<StreamCall> call_;
  StateMachine<Sending> sending_{Sending::kIdle};
  std::int64_t num_messages_ = 0;

  StateMachine<Receiving> receiving_{Receiving::kNoCall};
  RpcStatus final_;                  // valid once receiving is done
  std::optional<Status> own_error_;  // an error of the body, or of the RPC's answer

  StateMachine<Answering> answering_{Answering::kNone};
  http::Response head_;
  std::optional<std::uint64_t> length_;  // of the file
  std::string pending_;                  // encoded, not yet passed to the connection
  std::size_t writing_bytes_ = 0;        // passed to the connection, not yet written
  std::uint64_t num_answered_bytes_ = 0;
};

bool StreamExchange::OnBody(std::string_view data) {
  if (answering_.Is(Answering::kEnded) || sending_.Is(Sending::kEnded)) return true;  // drop the rest
  splitter_.Add(data);
  num_received_bytes_ += data.size();
  if (request_.announced_bytes > 0 && num_received_bytes_ >= request_.announced_bytes) splitter_.AddEnd();
  Pump();
  if (!FitsShare() && sending_.Is(Sending::kIdle)) StopSending(TooManyBytes());
  if (!sending_.Is(Sending::kBusy)) return true;
  sending_.To(Sending::kBusyHeld);
  return false;
}

void StreamExchange::OnBodyEnd() {
  splitter_.AddEnd();
  if (!answering_.Is(Answering::kEnded)) Pump();
}

void StreamExchange::StartCall(bool is_one_message) {
  CallOptions options = request_.call;
  if (is_one_message && request_.route->client_streams()) options.metadata.emplace_back(kOneMessageKey, "1");
  if (request_.route->file && !request_.if_none_match.empty()) {
    std::string held = EtagsNamed(request_.if_none_match, request_.takes_gzip);
    if (!held.empty()) options.metadata.emplace_back(kHeldEtagsKey, std::move(held));
  }
  call_ = backend_.caller->StartStream(options, shared_from_this());
  receiving_.To(Receiving::kIdle);
  ReadMore();
}

/// Sends the next message or the half-close, if the previous one has been sent.
void StreamExchange::Pump() {
  if (!sending_.Is(Sending::kIdle) || SendNext()) return;
  if (splitter_.is_too_large()) {
    StopSending(ResourceExhausted("message " + std::to_string(num_messages_ + 1) + " of the body is larger than " +
                                  std::to_string(request_.max_body_bytes) + " bytes")
                    .WithReason("BODY_TOO_LARGE"));
  } else if (splitter_.is_broken()) {
    StopSending(InvalidArgument("message " + std::to_string(num_messages_ + 1) + " of the body is cut off")
                    .WithReason("MALFORMED_PROTOBUF"));
  } else if (splitter_.ended()) {
    if (!call_) StartCall(false);
    sending_.To(Sending::kEnded);
    call_->SendEnd();
  }
}

/// Nothing if no message is complete. If the body should be one value, the first message waits until it is known to be
/// the only one: then the answer is a single value, too.
std::optional<std::string> StreamExchange::NextMessage() {
  auto message = first_ ? std::exchange(first_, std::nullopt) : splitter_.Next();
  const bool is_unclear = request_.is_one_value && request_.route->client_streams() && !call_ && !splitter_.ended() &&
                          !splitter_.is_too_large() && splitter_.has_nothing_left();
  if (message && is_unclear) {
    first_ = std::move(message);
    return std::nullopt;
  }
  return message;
}

/// False if there is no complete message; true if one is being sent, or was invalid.
bool StreamExchange::SendNext() {
  auto body = NextMessage();
  if (!body) return false;
  ++num_messages_;
  const bool is_only = !call_ && splitter_.ended() && splitter_.has_nothing_left();
  sending_.To(Sending::kBusy);
  // Parts of a file are bounded and only copied.
  const bool is_quick = body->size() <= kMostQuickBytes || request_.body_format == BodyFormat::kFile;
  if (is_quick) {
    Send(MakeMessage(*body), is_only);
  } else {
    ConvertOnLane(std::move(*body), is_only);
  }
  return true;
}

/// On any thread.
Result<std::string> StreamExchange::MakeMessage(const std::string& body) const {
  BodyRoom room(share_.Another(), body.size());
  return request_.transcoder.ToRequest(request_.body_format, body,
                                       [&room](std::size_t num_bytes) { return room.Hold(num_bytes); });
}

void StreamExchange::ConvertOnLane(std::string body, bool is_only) {
  converting_bytes_ = body.size();
  if (!FitsShare()) {
    converting_bytes_ = 0;
    return StopSending(TooManyBytes());
  }
  converting_ = std::make_shared<LaneTask>([self = shared_from_this(), body = std::move(body), is_only]() mutable {
    auto message = Guarded<Result<std::string>>([&] { return self->MakeMessage(body); });
    std::string().swap(body);
    self->PostToConnection([message = std::move(message), is_only](StreamExchange& exchange) mutable {
      exchange.Converted(std::move(message), is_only);
    });
  });
  const bool is_frame = request_.route->rpc_path.ends_with("/IntegrateFrames");
  Lane* const lane = is_frame && backend_.frames != nullptr ? backend_.frames : backend_.bulk;
  lane->Post(converting_);  // at most one per stream
}

void StreamExchange::Converted(Result<std::string> message, bool is_only) {
  converting_.reset();
  converting_bytes_ = 0;
  (void)FitsShare();
  if (!sending_.Is(Sending::kEnded)) Send(std::move(message), is_only);
}

/// Sends the next message of the RPC, or stops with its error. `is_only`: the body has no others.
void StreamExchange::Send(Result<std::string> message, bool is_only) {
  if (!message.ok()) {
    return StopSending(request_.route->client_streams() ? Numbered(num_messages_, message.status()) : message.status());
  }
  if (!call_) StartCall(is_only);
  call_->Send(std::move(*message));
}

/// The rest of the body is unusable. Messages that the RPC took before stand: half-close it, then report the error.
void StreamExchange::StopSending(Status why) {
  own_error_ = std::move(why);
  EndSending();
  if (call_) return call_->SendEnd();
  receiving_.To(Receiving::kDone);
  final_ = ToRpcStatus(*own_error_);
  EndIfDone();
}

void StreamExchange::Sent(bool ok) {
  if (sending_.Is(Sending::kEnded)) return;
  if (!ok) return EndSending();  // the RPC has ended; its status has the reason
  const bool was_held = sending_.Is(Sending::kBusyHeld);
  sending_.To(Sending::kIdle);
  if (answering_.Is(Answering::kEnded)) return;
  Pump();
  if (!was_held) return;
  if (sending_.Is(Sending::kBusy)) return sending_.To(Sending::kBusyHeld);
  responder_->ResumeBody();
}

/// Sends nothing more to the RPC; the rest of the body is read and dropped.
void StreamExchange::EndSending() {
  if (sending_.Is(Sending::kEnded)) return;
  if (converting_ && converting_->GiveUp()) {
    converting_bytes_ = 0;
    (void)FitsShare();
  }
  const bool was_held = sending_.Is(Sending::kBusyHeld);
  sending_.To(Sending::kEnded);
  if (was_held && !answering_.Is(Answering::kEnded)) responder_->ResumeBody();
}

/// Whether the buffered bytes fit into the budget.
bool StreamExchange::FitsShare() {
  const std::size_t first_bytes = first_ ? first_->size() : 0;
  return share_.Resize(first_bytes + splitter_.buffered_bytes() + converting_bytes_ + pending_.size() + writing_bytes_);
}

void StreamExchange::ReadMore() {
  if (!receiving_.Is(Receiving::kIdle)) return;
  const std::size_t window = splitter_.ended() ? kWindow_bytes : kWindowWhileReceiving_bytes;
  const bool is_full = pending_.size() >= window || (!FitsShare() && !pending_.empty());
  if (!answering_.Is(Answering::kEnded) && is_full) return;
  receiving_.To(Receiving::kBusy);
  call_->Read();
}

void StreamExchange::Answered(Result<StreamPart> part) {
  receiving_.To(Receiving::kIdle);
  if (!answering_.Is(Answering::kEnded)) Take(std::move(part));
  ReadMore();
}

void StreamExchange::Take(Result<StreamPart> part) {
  if (!part.ok()) return Fail(part.status());
  if (part->head) {
    if (IsEtagNamed(request_.if_none_match, part->head->etag)) return NotModified(std::move(part->head->headers));
    head_.headers = std::move(part->head->headers);
    length_ = part->head->length;
  }
  num_answered_bytes_ += part->num_bytes;
  if (length_ && num_answered_bytes_ > *length_) {  // the announced size was wrong: truncate the answer
    return Fail(Internal("the answer is larger than announced"));
  }
  if (answering_.Is(Answering::kNone)) {
    answering_.To(Answering::kIdle);
    head_.headers.emplace_back("X-Request-Id", RequestIdOf(request_.call));
    responder_->BeginStream(std::move(head_), encoder_.is_gzip() ? std::nullopt : length_);
    if (request_.is_head) {
      answering_.To(Answering::kEnded);
      responder_->EndStream(true);
      return call_->Cancel();
    }
  }
  pending_ += part->data;
  Deliver();
}

/// The client has this file already: stops making it.
void StreamExchange::NotModified(http::Headers headers) {
  answering_.To(Answering::kEnded);
  headers.emplace_back("X-Request-Id", RequestIdOf(request_.call));
  responder_->Reply({.status = 304, .headers = std::move(headers), .body = {}});
  call_->Cancel();
}

void StreamExchange::Fail(Status why) {
  own_error_ = std::move(why);
  call_->Cancel();
}

void StreamExchange::Deliver() {
  if (!answering_.Is(Answering::kIdle) || pending_.empty()) return;
  answering_.To(Answering::kBusy);
  std::string data;
  data.swap(pending_);
  writing_bytes_ = data.size();
  responder_->Chunk(std::move(data));
}

void StreamExchange::OnWritten() {
  answering_.To(Answering::kIdle);
  writing_bytes_ = 0;
  Deliver();
  ReadMore();
  EndIfDone();
}

/// If the client is gone, writing resets the connection.
void StreamExchange::OnPeerEnded() {
  if (!answering_.Is(Answering::kIdle)) return;
  pending_ += encoder_.Silence();
  Deliver();
}

void StreamExchange::ReadEnded() {
  receiving_.To(Receiving::kEnded);
  EndSending();
  call_->Finish();
}

void StreamExchange::Done(RpcStatus status) {
  receiving_.To(Receiving::kDone);
  call_.reset();
  if (answering_.Is(Answering::kEnded)) return;
  // An error of the RPC itself takes precedence, unless our cancellation caused it.
  const bool ours = own_error_ && (status.ok() || status.code == static_cast<int>(StatusCode::kCancelled));
  final_ = ours ? ToRpcStatus(*own_error_) : std::move(status);
  if (!ours) own_error_.reset();
  if (!answering_.Is(Answering::kNone) && !final_.ok() && encoder_.is_text()) pending_ += encoder_.ErrorText(final_);
  if (!answering_.Is(Answering::kNone) && final_.ok()) pending_ += encoder_.End();
  Deliver();
  EndIfDone();
}

void StreamExchange::EndIfDone() {
  if (!receiving_.Is(Receiving::kDone) || !pending_.empty()) return;
  if (!answering_.IsAnyOf({Answering::kNone, Answering::kIdle})) return;
  const bool has_begun = answering_.Is(Answering::kIdle);
  answering_.To(Answering::kEnded);
  if (has_begun) {
    const bool whole = !length_ || num_answered_bytes_ == *length_;
    return responder_->EndStream(whole && (final_.ok() || encoder_.is_text()));
  }
  http::Response answer;
  if (final_.ok()) {
    answer.headers = encoder_.EmptyHead();
  } else {
    answer =
        own_error_ ? ErrorResponse(*own_error_, request_.answer_format) : ErrorResponse(final_, request_.answer_format);
  }
  answer.headers.emplace_back("X-Request-Id", RequestIdOf(request_.call));
  responder_->Reply(std::move(answer));
}

void StreamExchange::OnClosed() {
  if (!answering_.Is(Answering::kEnded)) answering_.To(Answering::kEnded);
  EndSending();
  std::string().swap(pending_);
  if (!call_) return;
  call_->Cancel();
  ReadMore();  // until OnReadEnd: the RPC cannot end before
}

}  // namespace

std::shared_ptr<http::Exchange> MakeStreamExchange(RpcRequest request, ByteShare share, RpcBackend backend,
                                                   std::shared_ptr<http::Responder> responder) {
  return std::make_shared<StreamExchange>(std::move(request), std::move(share), backend, std::move(responder));
}

}  // namespace dhpmap::gateway

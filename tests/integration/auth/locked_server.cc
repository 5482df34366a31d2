// SPDX-License-Identifier: BSD-3-Clause
#include "tests/integration/auth/locked_server.h"

#include <grpcpp/generic/generic_stub.h>

#include <utility>

namespace dhpmap::testing {

LockedServer::LockedServer(const auth::CallLimits& limits, std::vector<std::string> allowed_origins) {
  (void)auth::ChangeKeyFile(file_, [](std::vector<auth::KeyRecord>&) { return Status::Ok(); });
  auto gate = auth::Gate::WithKeys({.key_file = file_, .limits = limits, .look_s = 0});
  EXPECT_OK(gate);
  gate_ = *gate;
  for (const auth::Role role : auth::kRoles) {
    const std::string name(auth::NameOf(role));
    keys_[name] = MakeKey({.name = name, .role = role, .sessions = {"*"}});
  }
  server_ = std::make_unique<TestServer>(*store_, OpenMapOptions{}, GrpcOptions{.gate = gate_});
  auto gateway = Gateway::Start({.address = "127.0.0.1:0", .allowed_origins = std::move(allowed_origins)},
                                server_->grpc().InProcessChannel(), {.gate = gate_});
  EXPECT_OK(gateway);
  gateway_ = *std::move(gateway);
}

std::string LockedServer::MakeKey(const auth::NewKey& key) {
  std::string text;
  EXPECT_OK(auth::ChangeKeyFile(file_, [&](std::vector<auth::KeyRecord>& records) -> Status {
    DHPMAP_ASSIGN_OR_RETURN(const auth::ShownKey shown, AddKey(key, 0, auth::SystemRandomness(), records));
    text = shown.text;
    return Status::Ok();
  }));
  gate_->Look();
  return text;
}

void LockedServer::Revoke(const std::string& name) {
  EXPECT_OK(auth::ChangeKeyFile(
      file_, [&](std::vector<auth::KeyRecord>& records) { return auth::RevokeKeys(name, 1, records).status(); }));
  gate_->Look();
}

http::HttpAnswer LockedServer::Ask(const std::string& key, std::string_view method, std::string_view target,
                                   std::string_view body, http::HttpClient::Headers headers) const {
  http::HttpClient client(http_port());
  if (!key.empty()) headers.emplace_back("Authorization", "Bearer " + key);
  return client.Ask(method, target, body, std::move(headers));
}

grpc::Status CallRawAs(const std::shared_ptr<grpc::Channel>& channel, const std::string& path, const std::string& key,
                       const std::map<std::string, std::string>& metadata) {
  grpc::ClientContext context;
  if (!key.empty()) LockedServer::Show(key, context);
  for (const auto& [name, value] : metadata) context.AddMetadata(name, value);
  grpc::CompletionQueue queue;
  grpc::GenericStub stub(channel);
  const auto stream = stub.PrepareCall(&context, path, &queue);
  const auto wait = [&queue] {
    void* tag = nullptr;
    bool ok = false;
    return queue.Next(&tag, &ok) && ok;
  };
  stream->StartCall(nullptr);
  wait();
  const grpc::Slice nothing;
  stream->WriteLast(grpc::ByteBuffer(&nothing, 1), grpc::WriteOptions(), nullptr);
  wait();
  grpc::ByteBuffer answer;
  for (stream->Read(&answer, nullptr); wait(); stream->Read(&answer, nullptr)) answer.Clear();
  grpc::Status status;
  stream->Finish(&status, nullptr);
  wait();
  return status;
}

}  // namespace dhpmap::testing

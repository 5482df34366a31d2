// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <grpcpp/grpcpp.h>

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "server/auth/gate.h"
#include "server/auth/keys/key_book.h"
#include "server/gateway/gateway.h"
#include "storage/sqlite_store.h"
#include "tests/integration/test_server.h"
#include "tests/support/scenes.h"
#include "tests/unit/server/http/http_client.h"

namespace dhpmap::testing {

/// Both doors of a server with keys: one key per role, named after the role, and further ones that a test makes. The
/// gate reloads its file only on request.
class LockedServer {
 public:
  explicit LockedServer(const auth::CallLimits& limits = {}, std::vector<std::string> allowed_origins = {});

  /// Makes a key that is valid at once.
  std::string MakeKey(const auth::NewKey& key);
  /// Revokes a key; takes effect at once, in place of within a second.
  void Revoke(const std::string& name);

  [[nodiscard]] const std::string& key_of(const std::string& role) const { return keys_.at(role); }
  TestServer& server() { return *server_; }
  auth::Gate& gate() { return *gate_; }
  [[nodiscard]] int http_port() const { return gateway_->port(); }

  /// Adds the key to a call's metadata.
  static void Show(const std::string& key, grpc::ClientContext& context) {
    context.AddMetadata("authorization", "Bearer " + key);
  }
  /// One unary call with a key; empty: none.
  template <typename Stub, typename Request, typename Response>
  Answer<Response> Call(const std::string& key,
                        grpc::Status (Stub::*method)(grpc::ClientContext*, const Request&, Response*),
                        const std::type_identity_t<Request>& request = Request()) {
    grpc::ClientContext context;
    if (!key.empty()) Show(key, context);
    Response response;
    Stub stub(server_->channel());
    grpc::Status status = (stub.*method)(&context, request, &response);
    return {std::move(status), std::move(response)};
  }
  /// One request over REST with a key; empty: none.
  http::HttpAnswer Ask(const std::string& key, std::string_view method, std::string_view target,
                       std::string_view body = {}, http::HttpClient::Headers headers = {}) const;

 private:
  TempDir folder_;
  const std::string file_ = (folder_.path() / "keys").string();
  std::map<std::string, std::string> keys_;
  std::unique_ptr<MapStore> store_ = OpenSqliteStore((folder_.path() / "maps.db").string()).value();
  std::shared_ptr<auth::Gate> gate_;
  std::unique_ptr<TestServer> server_;
  std::unique_ptr<Gateway> gateway_;
};

/// Calls any method with one message of raw bytes, and returns its status.
grpc::Status CallRawAs(const std::shared_ptr<grpc::Channel>& channel, const std::string& path, const std::string& key,
                       const std::map<std::string, std::string>& metadata = {});

}  // namespace dhpmap::testing

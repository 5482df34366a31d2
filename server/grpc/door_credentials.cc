// SPDX-License-Identifier: BSD-3-Clause
#include "server/grpc/door_credentials.h"

#include <grpcpp/security/auth_metadata_processor.h>

#include <string_view>
#include <utility>
#include <vector>

#include "mapping/base/guarded.h"
#include "server/auth/fleet_key.h"
#include "server/auth/rights.h"

namespace dhpmap {
namespace {

/// gRPC transmits only a code and a message, no details. So the reason precedes the message.
grpc::Status Refusal(const Status& status) {
  return {static_cast<grpc::StatusCode>(status.code()), std::string(status.reason().name()) + ": " + status.message()};
}

class KeyProcessor final : public grpc::AuthMetadataProcessor {
 public:
  KeyProcessor(std::shared_ptr<auth::Gate> gate, std::function<std::string()> from)
      : gate_(std::move(gate)), from_(std::move(from)) {}

  /// Takes microseconds, so it runs on gRPC's own thread.
  [[nodiscard]] bool IsBlocking() const override { return false; }

  grpc::Status Process(const InputMetadata& head, grpc::AuthContext*, OutputMetadata*, OutputMetadata*) override {
    const Status status = Guarded<Status>([&] { return Check(head); });
    return status.ok() ? grpc::Status::OK : Refusal(status);
  }

 private:
  [[nodiscard]] Status Check(const InputMetadata& head) const {
    const auto path = head.find(":path");
    if (path == head.end()) return Internal("a call names no rpc");
    const auth::CallNeeds* needs = gate_->NeedsOf(ViewOf(path->second));
    if (needs != nullptr && needs->is_public) return Status::Ok();
    if (head.contains(auth::kTicketKey)) {
      return Status(StatusCode::kUnauthenticated, "tickets are for calls inside the server")
          .WithReason("BAD_CREDENTIAL");
    }
    const auto principal = WhoCalls(head);
    if (!principal.ok()) return Refused(nullptr, principal.status(), path->second);
    if (needs == nullptr) return {StatusCode::kUnimplemented, "there is no such rpc"};
    if (path->second == "/grpc.health.v1.Health/Watch") {  // gRPC's own handler does not end when the key does
      return {StatusCode::kUnimplemented, "ask for the health by Check"};
    }
    return Refused(principal->get(), auth::CheckRole(**principal, *needs), path->second);
  }
  [[nodiscard]] Result<auth::PrincipalPtr> WhoCalls(const InputMetadata& head) const {
    const auto one = [&](const char* name) {
      const auto found = head.find(name);
      return found != head.end() ? ViewOf(found->second) : std::string_view();
    };
    if (head.contains(auth::kFleetKeyKey)) {
      return gate_->AuthenticateFleet(from_(), one(auth::kFleetKeyKey), one(auth::kPrincipalKey));
    }
    std::vector<std::string_view> keys;
    const auto [begin, end] = head.equal_range("authorization");
    for (auto value = begin; value != end; ++value) keys.push_back(ViewOf(value->second));
    return gate_->AuthenticateFrom(from_(), keys);
  }
  /// Returns the status, and logs a refusal to the audit log.
  [[nodiscard]] Status Refused(const auth::Principal* principal, const Status& status, grpc::string_ref path) const {
    if (!status.ok()) (void)gate_->Audit({.principal = principal, .rpc = ViewOf(path), .map = {}, .decision = status});
    return status;
  }
  static std::string_view ViewOf(grpc::string_ref text) { return {text.data(), text.size()}; }

  const std::shared_ptr<auth::Gate> gate_;
  const std::function<std::string()> from_;
};

}  // namespace

std::shared_ptr<grpc::ServerCredentials> MakeDoorCredentials(std::shared_ptr<auth::Gate> gate,
                                                             grpc_local_connect_type kind,
                                                             std::function<std::string()> from) {
  if (gate == nullptr || !gate->has_keys()) return grpc::InsecureServerCredentials();
  auto credentials = grpc::experimental::LocalServerCredentials(kind);
  credentials->SetAuthMetadataProcessor(std::make_shared<KeyProcessor>(std::move(gate), std::move(from)));
  return credentials;
}

}  // namespace dhpmap

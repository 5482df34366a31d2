// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <google/protobuf/message.h>
#include <grpcpp/server_context.h>

#include <memory>
#include <string>
#include <string_view>

#include "mapping/base/status.h"
#include "server/auth/gate.h"

namespace dhpmap {

/// The caller of one call, and the checks of the messages that it sends. Without keys nothing is checked. Outlives the
/// call's context, as a stream may. Value type.
class Caller {
 public:
  Caller() = default;
  Caller(auth::PrincipalPtr principal, const auth::CallNeeds* needs, std::shared_ptr<ByteBudget> budget)
      : principal_(std::move(principal)), needs_(needs), budget_(std::move(budget)) {}

  /// Null: keys are off.
  [[nodiscard]] const auth::Principal* principal() const { return principal_.get(); }

  /// The budget of its requests and answers; null: the budget of all calls.
  [[nodiscard]] const std::shared_ptr<ByteBudget>& budget() const { return budget_; }

  /// PERMISSION_DENIED as of auth::CheckRequest. Fills in an empty author.
  Status Check(google::protobuf::Message& request) const;
  /// The same for a map that no request names.
  [[nodiscard]] Status CheckMap(std::string_view map_id) const;
  /// Whether lists show the map.
  [[nodiscard]] bool MaySee(std::string_view map_id) const { return CheckMap(map_id).ok(); }
  /// Whether the caller may undo that author's edits by name.
  [[nodiscard]] bool Owns(std::string_view author) const;
  [[nodiscard]] bool OwnsAll() const { return principal_ == nullptr || principal_->role == auth::Role::kAdmin; }

 private:
  auth::PrincipalPtr principal_;
  const auth::CallNeeds* needs_ = nullptr;
  std::shared_ptr<ByteBudget> budget_;
};

/// Makes the contexts of calls, with room for the caller.
std::unique_ptr<grpc::ContextAllocator> MakeCallAllocator();

/// Runs once per call, before a message is read. Identifies the caller by its ticket or key, then checks its role and
/// its limits. A stream ends when the caller's key becomes invalid. A null `needs` means an unknown method, which is
/// refused. Without keys every call is admitted. The caller gets a share of `inflight`.
Status Enter(auth::Gate& gate, const auth::CallNeeds* needs, const std::shared_ptr<ByteBudget>& inflight,
             grpc::CallbackServerContext& call);

/// The caller of a call: by its single-use ticket, by the word of another server of the fleet, or by its key. Errors as
/// of Gate::Authenticate and AuthenticateFleet.
Result<auth::PrincipalPtr> WhoCalls(auth::Gate& gate, const grpc::CallbackServerContext& call);
/// Enter for a call whose caller is known.
Status EnterAs(auth::Gate& gate, auth::PrincipalPtr principal, const auth::CallNeeds* needs,
               const std::shared_ptr<ByteBudget>& inflight, grpc::CallbackServerContext& call);

/// The caller of a call that has entered.
const Caller& CallerOf(const grpc::CallbackServerContext& call);

}  // namespace dhpmap

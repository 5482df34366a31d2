// SPDX-License-Identifier: BSD-3-Clause
#include "server/grpc/counted_service.h"

#include <stdexcept>

#include "server/auth/rights.h"
#include "server/base/request_limits.h"

namespace dhpmap {
namespace {

const google::protobuf::MethodDescriptor& MethodOf(const google::protobuf::ServiceDescriptor& service,
                                                   const google::protobuf::Descriptor& request) {
  for (int i = 0; i < service.method_count(); ++i) {
    if (service.method(i)->input_type() == &request) return *service.method(i);
  }
  throw std::logic_error("no method of " + service.full_name() + " takes " + request.name());
}

}  // namespace

RequestIntake::RequestIntake(const ServiceContext& of, const google::protobuf::ServiceDescriptor& service,
                             const google::protobuf::Descriptor& of_request, const MessageLayout& request_layout)
    : context(of), layout(request_layout), request(&of_request) {
  const google::protobuf::MethodDescriptor& method = MethodOf(service, of_request);
  path = auth::PathOf(method);
  needs = of.options.gate->NeedsOf(path);
  name = service.name() + "/" + method.name();
  index = method.index();
  most_bytes = MostRequestBytes(method, context.options.max_message_bytes);
  most_message_bytes = MostMessageBytes(method);
}

Status RequestIntake::Parse(grpc::ByteBuffer& bytes, google::protobuf::Message& message,
                            std::optional<ByteShare>& share) const {
  const CallRecord record(context, name);
  const Status status = RunGuarded([&] {
    if (bytes.Length() > most_bytes) return RequestTooLarge(bytes.Length(), most_bytes);
    ByteBudget& budget = BudgetHere(*context.options.inflight);
    share.emplace(&budget);
    std::size_t too_many_bytes = 0;
    const auto resize = [&](std::size_t num_bytes) {
      if (num_bytes > most_message_bytes) too_many_bytes = num_bytes;
      return num_bytes <= most_message_bytes && share->Resize(num_bytes);
    };
    const Status parsed = ParseWithin(budget, layout, bytes, message, resize);
    return too_many_bytes > 0 ? MessageTooLarge(too_many_bytes, most_message_bytes) : parsed;
  });
  if (status.ok()) return status;
  bytes.Clear();
  share.reset();
  record.End(status);
  return status;
}

Status RequestIntake::Enter(grpc::CallbackServerContext& call) const {
  const CallRecord record(context, name);
  const Status status = RunGuarded([&] {
    const Status entered = dhpmap::Enter(*context.options.gate, needs, context.options.inflight, call);
    const bool comes_with_messages = needs != nullptr && needs->comes_in_messages;
    return !entered.ok() || comes_with_messages ? Audit(CallerOf(call), entered, nullptr) : entered;
  });
  if (!status.ok()) record.End(status);
  return status;
}

Status RequestIntake::Take(grpc::CallbackServerContext& call, grpc::ByteBuffer& bytes,
                           google::protobuf::Message& message, std::optional<ByteShare>& share) const {
  DHPMAP_RETURN_IF_ERROR(Enter(call));
  const CallerBudget here(CallerOf(call).budget().get());
  DHPMAP_RETURN_IF_ERROR(Parse(bytes, message, share));
  const CallRecord record(context, name);
  const Status status = RunGuarded([&] {
    const Status checked = CallerOf(call).Check(message);
    return Audit(CallerOf(call), checked, &message);
  });
  if (!status.ok()) record.End(status);
  return status;
}

Status RequestIntake::Audit(const Caller& caller, const Status& decision,
                            const google::protobuf::Message* message) const {
  if (!context.options.gate->has_keys() || needs == nullptr) return decision;
  if (decision.ok() && needs->need == v1::Access::READ) return decision;
  const Status written =
      context.options.gate->Audit({.principal = caller.principal(),
                                   .rpc = path,
                                   .map = message != nullptr ? auth::MapNamed(*needs, *message) : std::string(),
                                   .decision = decision});
  return decision.ok() ? written : decision;
}

}  // namespace dhpmap

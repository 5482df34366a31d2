// SPDX-License-Identifier: BSD-3-Clause
#include "server/grpc/counted_service.h"

#include <stdexcept>

#include "server/wire/types/request_limits.h"

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
                             const google::protobuf::Descriptor& request, const MessageLayout& request_layout)
    : context(of), layout(request_layout) {
  const google::protobuf::MethodDescriptor& method = MethodOf(service, request);
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
    share.emplace(context.options.inflight.get());
    std::size_t too_many_bytes = 0;
    const auto resize = [&](std::size_t num_bytes) {
      if (num_bytes > most_message_bytes) too_many_bytes = num_bytes;
      return num_bytes <= most_message_bytes && share->Resize(num_bytes);
    };
    const Status parsed = ParseWithin(*context.options.inflight, layout, bytes, message, resize);
    return too_many_bytes > 0 ? MessageTooLarge(too_many_bytes, most_message_bytes) : parsed;
  });
  if (status.ok()) return status;
  bytes.Clear();
  share.reset();
  record.End(status);
  return status;
}

}  // namespace dhpmap

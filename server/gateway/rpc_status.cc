// SPDX-License-Identifier: BSD-3-Clause
#include "server/gateway/rpc_status.h"

#include "proto/types/status_conversion.h"

namespace dhpmap::gateway {

RpcStatus ToRpcStatus(const Status& status) {
  const google::rpc::Status proto = ToProto(status);
  return {proto.code(), proto.message(), proto.SerializeAsString()};
}

}  // namespace dhpmap::gateway

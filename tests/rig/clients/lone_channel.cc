// SPDX-License-Identifier: BSD-3-Clause
#include "tests/rig/clients/lone_channel.h"

#include <grpcpp/grpcpp.h>

namespace dhpmap::rig {

std::shared_ptr<grpc::Channel> LoneChannel(const std::string& address) {
  grpc::ChannelArguments arguments;
  arguments.SetInt(GRPC_ARG_USE_LOCAL_SUBCHANNEL_POOL, 1);
  return grpc::CreateCustomChannel(address, grpc::InsecureChannelCredentials(), arguments);
}

}  // namespace dhpmap::rig

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <grpcpp/channel.h>

#include <memory>
#include <string>

namespace dhpmap::rig {

/// A channel that shares its connection with no other channel.
std::shared_ptr<grpc::Channel> LoneChannel(const std::string& address);

}  // namespace dhpmap::rig

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <grpcpp/support/client_interceptor.h>

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "mapping/base/result.h"

namespace dhpmap {

/// The key in a file, without spaces around it. FAILED_PRECONDITION if others than its owner may read the file,
/// NOT_FOUND if it cannot be read, INVALID_ARGUMENT if it holds no one word.
Result<std::string> ReadTokenFile(const std::string& path);

/// Whether what is sent there stays on this machine: a key goes nowhere else in the clear.
bool StaysOnThisMachine(std::string_view server);

/// Has every call of a channel show the key.
std::vector<std::unique_ptr<grpc::experimental::ClientInterceptorFactoryInterface>> ShowingToken(
    const std::string& token);

}  // namespace dhpmap

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "grpc/reflection/v1/reflection.pb.h"

namespace dhpmap {

/// Answers a request of gRPC's server reflection, `response.original_request()`, from the descriptors linked into the
/// program. `services` are the full names of the served services. A file comes first, followed by all its imports. An
/// unknown name is answered with the error NOT_FOUND, an empty request with INVALID_ARGUMENT. Thread-safe.
void AnswerReflection(const std::vector<std::string>& services,
                      grpc::reflection::v1::ServerReflectionResponse& response);

}  // namespace dhpmap

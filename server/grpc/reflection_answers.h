// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "grpc/reflection/v1/reflection.pb.h"

namespace dhpmap {

/// Answers a request of gRPC's server reflection, `response.original_request()`, from the descriptors that are linked
/// in; `services` are those served, by their full names. A file comes with all that it imports, itself first. What
/// there is not is answered by an error, NOT_FOUND; a request that asks nothing by INVALID_ARGUMENT. Thread-safe.
void AnswerReflection(const std::vector<std::string>& services,
                      grpc::reflection::v1::ServerReflectionResponse& response);

}  // namespace dhpmap

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "server/gateway/http_rule_router.h"

namespace dhpmap::gateway {

/// The OpenAPI 3.0 document of all routes: each binding is an operation, each message and enum a schema.
std::string OpenApiDocument(const HttpRuleRouter& router);

/// A path template in OpenAPI form: "/v1/{name=maps/*/submaps/*}/mesh" -> "/v1/maps/{map}/submaps/{submap}/mesh". A
/// wildcard is named after the literal before it.
struct OpenApiPath {
  struct Parameter {
    std::string name;
    std::string field;  ///< path of the field that contains it
  };
  std::string text;
  std::vector<Parameter> parameters;
};
OpenApiPath ToOpenApiPath(const Route& route);

}  // namespace dhpmap::gateway

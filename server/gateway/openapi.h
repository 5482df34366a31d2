// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "server/gateway/http_rule_router.h"

namespace dhpmap::gateway {

/// OpenAPI 3.0 of everything the router finds: each binding an operation, each message and enum a schema.
std::string OpenApiDocument(const HttpRuleRouter& router);

/// A template as OpenAPI writes it: "/v1/{name=maps/*/submaps/*}/mesh" -> "/v1/maps/{map}/submaps/{submap}/mesh", a
/// wild card being named after the literal before it.
struct OpenApiPath {
  struct Parameter {
    std::string name;
    std::string field;  ///< path of the field it is part of
  };
  std::string text;
  std::vector<Parameter> parameters;
};
OpenApiPath ToOpenApiPath(const Route& route);

}  // namespace dhpmap::gateway

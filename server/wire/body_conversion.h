// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "dhpmap/v1/collision.pb.h"
#include "mapping/map/map.h"
#include "mapping/query/body_query.h"
#include "server/wire/allowed_collisions.h"

namespace dhpmap {

/// The bodies of a request, packed spheres first. INVALID_ARGUMENT for a list that is cut off, more than `max_bodies`,
/// or a body without a shape, not finite, of a negative size, or too large; it names the item.
Result<std::vector<Body>> BodiesFromProto(const v1::CheckCollisionsRequest& request, std::int64_t max_bodies);

/// How many bodies a request has, if its list is whole.
std::size_t NumBodies(const v1::CheckCollisionsRequest& request);

/// Which link each body is.
RequestedLinks LinksOf(const v1::CheckCollisionsRequest& request);

/// How many contacts of a body are asked for; 0: only whether there is any. INVALID_ARGUMENT for a number out of range
/// or options that exclude each other.
Result<std::size_t> MaxContactsFromProto(const v1::CheckCollisionsRequest& request);

/// What answering takes of memory at most: the bodies, the answer, and the answer as bytes.
std::size_t BytesOfAnswers(const v1::CheckCollisionsRequest& request);

/// Writes answers, body by body, in the form that the request asks for.
class CollisionAnswers {
 public:
  /// Of the state `map` of a map. The request and the response outlive this.
  CollisionAnswers(const v1::CheckCollisionsRequest& request, const MapInfo& map,
                   v1::CheckCollisionsResponse& response);
  void Append(const BodyAnswer& answer);

 private:
  void AppendPacked(const BodyAnswer& answer);

  const v1::CheckCollisionsRequest& request_;
  const MapInfo& map_;
  v1::CheckCollisionsResponse& response_;
};

}  // namespace dhpmap

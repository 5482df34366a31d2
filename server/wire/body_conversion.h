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

/// The bodies of a request, packed spheres first. INVALID_ARGUMENT for an incomplete list, more than `max_bodies`, or a
/// body without a shape, non-finite, of negative size, or too large; names the item.
Result<std::vector<Body>> BodiesFromProto(const v1::CheckCollisionsRequest& request, std::int64_t max_bodies);

/// Number of bodies in a request, if its list is complete.
std::size_t NumBodies(const v1::CheckCollisionsRequest& request);

/// The link of each body.
RequestedLinks LinksOf(const v1::CheckCollisionsRequest& request);

/// The requested number of contacts a body; 0: only whether there is one. INVALID_ARGUMENT for a number out of range,
/// or options that exclude each other.
Result<std::size_t> MaxContactsFromProto(const v1::CheckCollisionsRequest& request);

/// Maximum memory of answering: the bodies, the answer, and its bytes.
std::size_t BytesOfAnswers(const v1::CheckCollisionsRequest& request);

/// Writes answers, body by body, in the requested form.
class CollisionAnswers {
 public:
  /// For the state `map`. The request and the response outlive this.
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

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace dhpmap {

/// Metadata of a call from the REST door: the client's stream is a single message, so the answer is a single message or
/// an error.
inline constexpr char kOneMessageKey[] = "dhpmap-one-message";

/// Likewise: the etags of the files that the client has, with commas between them. Of one of these a single message
/// comes, with its etag and without data.
inline constexpr char kHeldEtagsKey[] = "dhpmap-held-etags";

/// Metadata of an answer about a map, of a server of a fleet: "ADDRESS EPOCH", where its owner is.
inline constexpr char kOwnerKey[] = "dhpmap-owner";

/// Metadata of a call of a stream: {map} of its first message, so that a server of a fleet knows the way before that
/// comes. A hint: nothing but speed depends on it.
inline constexpr char kRouteMapKey[] = "dhpmap-map";

/// Metadata of a call that a server of a fleet passes on: kPassedOn to the map's owner, which never passes it on again;
/// kPassedHere to itself, once it knows that it is the owner.
inline constexpr char kRelayedKey[] = "dhpmap-relayed";
inline constexpr char kPassedOn[] = "on", kPassedHere[] = "here";

}  // namespace dhpmap

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "dhpmap/geometry.h"
#include "dhpmap/object.h"

namespace dhpmap::client {

/// Where the server is, and how long to wait for it.
struct ConnectOptions {
  double connect_s = 5;    ///< how long to wait for the server
  double deadline_s = 30;  ///< of each call that names none, lost connections and repetitions included
  std::string author;      ///< who edits, unless an edit says so
  bool tls = false;        ///< talk to the server over TLS, by the system's certificates
  std::string ca_file;     ///< PEM file of the certificates to trust instead; not empty: over TLS
  std::string cert_file;  ///< PEM files of a certificate of this client's own and its key, for servers that ask for one
  std::string key_file;
  std::string token;       ///< your key, sent with each call; over TLS or to this machine only
  std::string token_file;  ///< or a file that holds it, and that nobody but its owner may read
};

/// What space that nobody has seen counts as.
enum class Unknown {
  kDefault,   ///< distances and rays tell it; it is in the way of robots
  kReport,    ///< it is told
  kFree,      ///< it is answered like all else; the inside of objects is solid all the same
  kOccupied,  ///< it is in the way; of checks only
};

/// Where an edited object was and nobody has looked since.
enum class Vacated { kDefault, kUnknown, kFree };

/// What the robot carries: it leaves its place and rides along.
struct Attached {
  std::int64_t object = 0;
  std::optional<Pose> T_robot_object;  ///< of checks of paths, which need it; p_robot = T_robot_object * p_object
};

/// What a part of the robot may touch. With neither link nor attached: all of it.
struct MayTouch {
  std::vector<ObjectOrClass> things;
  std::string link = {};
  std::optional<std::int64_t> attached = {};
};

/// By how much some surfaces are grown.
struct Padding {
  ObjectOrClass of;
  double padding_m = 0;  ///< 0 to 10
};

/// Of all queries. InvalidArgument for one that a query has no use for.
struct QueryOptions {
  std::vector<ObjectOrClass> ignore;     ///< taken as not there
  std::vector<std::string> classes;      ///< only objects of these count; empty: all
  std::optional<double> max_distance_m;  ///< above 0, up to 1,000; default 3
  Unknown unknown = Unknown::kDefault;
  Vacated vacated = Vacated::kDefault;
  std::optional<double> max_free_age_s;  ///< free space that was seen longer ago counts as unknown
  bool include_absent = false;           ///< also objects that are gone
  double padding_m = 0;                  ///< surfaces are grown by so much, 0 to 10
  std::vector<Padding> padding_of;       ///< of some, in place of padding_m
  std::vector<Attached> attached;
  std::vector<MayTouch> may_touch;
  std::optional<Pose> T_map_query;  ///< the frame in which it is asked and answered; default: the map's
  double tolerance_vox = 0;         ///< of distances: how much too long; 0.4 and more is faster
  std::int64_t min_revision = 0;    ///< wait until the map is so far
  double deadline_s = 0;            ///< 0: that of ConnectOptions
};

/// Of checks of bodies and paths.
struct CheckOptions {
  bool all_contacts = false;       ///< with each object that is touched, rather than the deepest or first one
  bool include_clearance = false;  ///< of paths: how near they come to surfaces; takes longer
  std::vector<std::string> links;  ///< of bodies: a name each, for MayTouch::link
};

}  // namespace dhpmap::client

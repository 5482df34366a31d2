// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "dhpmap/geometry.h"
#include "dhpmap/object.h"

namespace dhpmap::client {

/// The connection to a server.
struct ConnectOptions {
  double connect_s = 5;    ///< timeout of the first connection
  double deadline_s = 30;  ///< of calls without their own, including reconnects and retries
  std::string author;      ///< author of edits that name none
  bool tls = false;        ///< use TLS, with the system's CA certificates
  std::string ca_file;     ///< PEM file of trusted CA certificates instead; implies TLS if not empty
  std::string cert_file;   ///< PEM files of a client certificate and its key, for servers that require one
  std::string key_file;
  /// If several servers share a database, calls about a map go to its owner once an answer has named it, provided that
  /// it can be reached from here. All other calls go to the first server.
  bool to_owner = true;
  std::string token;       ///< your key, sent with each call; over TLS or to this machine only
  std::string token_file;  ///< or a file that holds it, readable only by its owner
};

/// How unobserved space counts.
enum class Unknown {
  kDefault,   ///< distances and rays report it; it blocks robots
  kReport,    ///< it is reported
  kFree,      ///< it counts as free; the inside of objects remains solid
  kOccupied,  ///< it blocks; for checks only
};

/// How the former space of an edited object counts until it is observed again.
enum class Vacated { kDefault, kUnknown, kFree };

/// An object that the robot carries: it leaves its place and moves with the robot.
struct Attached {
  std::int64_t object = 0;
  std::optional<Pose> T_robot_object;  ///< required for checks of paths; p_robot = T_robot_object * p_object
};

/// Allowed contacts of a part of the robot. Without link and attached: of the whole robot.
struct MayTouch {
  std::vector<ObjectOrClass> things;
  std::string link = {};
  std::optional<std::int64_t> attached = {};
};

/// Padding of some surfaces.
struct Padding {
  ObjectOrClass of;
  double padding_m = 0;  ///< 0 to 10
};

/// Options of all queries. InvalidArgument for an option that a query does not support.
struct QueryOptions {
  std::vector<ObjectOrClass> ignore;     ///< treated as missing
  std::vector<std::string> classes;      ///< only objects of these classes count; empty: all
  std::optional<double> max_distance_m;  ///< above 0, up to 1,000; default 3
  Unknown unknown = Unknown::kDefault;
  Vacated vacated = Vacated::kDefault;
  std::optional<double> max_free_age_s;  ///< free space observed longer ago counts as unobserved
  bool include_absent = false;           ///< includes absent objects
  double padding_m = 0;                  ///< grows surfaces by this, 0 to 10
  std::vector<Padding> padding_of;       ///< of some surfaces, in place of padding_m
  std::vector<Attached> attached;
  std::vector<MayTouch> may_touch;
  std::optional<Pose> T_map_query;  ///< the frame of the query and its answer; default: the map frame
  double tolerance_vox = 0;         ///< of distances: permitted excess; 0.4 and more is faster
  std::int64_t min_revision = 0;    ///< wait for this revision
  double deadline_s = 0;            ///< 0: that of ConnectOptions
};

/// Options of checks of bodies and paths.
struct CheckOptions {
  bool all_contacts = false;       ///< with each touched object, instead of only the deepest or first
  bool include_clearance = false;  ///< of paths: the smallest distance to surfaces; takes longer
  std::vector<std::string> links;  ///< of bodies: a name for each, for MayTouch::link
};

}  // namespace dhpmap::client

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <iterator>
#include <ostream>
#include <span>
#include <string_view>

#include "mapping/base/status_code.h"

namespace dhpmap {

/// One cause of errors.
struct ReasonRow {
  std::string_view name;     ///< google.rpc.ErrorInfo.reason, as clients see it
  StatusCode code;           ///< its code; kOk: that of its cause, or as the meaning says
  std::string_view meaning;  ///< for people
};

/// All reasons, by room. Names are part of the API: they never change their meaning.
inline constexpr ReasonRow kReasonTable[] = {
    // Maps.
    {"MAP_NOT_FOUND", StatusCode::kNotFound, "there is no map of this name, or no longer"},
    {"HISTORY_LOST", StatusCode::kOutOfRange, "a revision of before a restore or a crash, whose state is not stored"},
    {"REVISION_NOT_KEPT", StatusCode::kOutOfRange,
     "a revision whose state is not kept, or never was: the metadata name those kept before and after it"},
    {"SNAPSHOT_EXPIRED", StatusCode::kAborted,
     "a state was read for so long that the map, closed and changed since, no longer has it: ask for the present one"},
    {"BAD_REVISION", StatusCode::kInvalidArgument, "a revision to read is negative, or the map has not reached it"},
    {"COMPACTED", StatusCode::kOutOfRange, "changes so old are not kept; the metadata name the `oldest_revision`"},
    {"BAD_POSITION", StatusCode::kInvalidArgument, "a position to watch a map from is malformed"},
    {"TOO_MANY_WATCHERS", StatusCode::kResourceExhausted, "as many watch maps as the server allows: try again later"},
    {"MAP_EXISTS", StatusCode::kAlreadyExists, "the name of the map is taken"},
    {"MAP_IS_FED", StatusCode::kOk, "frames are streamed in: ABORTED for another stream, else FAILED_PRECONDITION"},
    {"FEED_TAKEN_OVER", StatusCode::kAborted, "another stream has taken over: no more frames are taken from this one"},
    {"FEED_IDLE", StatusCode::kAborted, "nothing came for so long that the map went to another stream, or was deleted"},
    {"SESSION_ENDED", StatusCode::kAborted, "somebody has ended the session: no more frames are taken from its stream"},
    {"SESSION_NOT_FOUND", StatusCode::kNotFound, "no stream feeds the map in this session"},
    {"TOO_MANY_FEEDS", StatusCode::kResourceExhausted, "as many streams feed the map as may at once"},
    {"BAD_MAP", StatusCode::kInvalidArgument, "a request for a new map has bad fields"},
    {"BAD_CONFIG", StatusCode::kInvalidArgument, "a configuration, of a map or the server, has bad keys or values"},
    {"BAD_LABEL_SET", StatusCode::kInvalidArgument, "a label set has bad classes"},
    {"BAD_NAME", StatusCode::kInvalidArgument, "a resource name is malformed"},
    {"DOWNLOAD_EVICTED", StatusCode::kAborted, "a file that nobody read on made place for another"},
    // Frames.
    {"BAD_FRAME", StatusCode::kInvalidArgument, "a frame has bad fields"},
    {"BAD_IMAGE", StatusCode::kInvalidArgument, "an image cannot be decoded, or is not of the size or type wanted"},
    {"BAD_CAMERA", StatusCode::kInvalidArgument, "a camera's parameters are not usable"},
    {"BAD_TRANSFORM", StatusCode::kInvalidArgument, "a pose is not finite or not rigid"},
    {"FRAME_TOO_LARGE", StatusCode::kResourceExhausted, "a frame would touch more of the map than one frame may"},
    {"IMPLAUSIBLE_FRAME", StatusCode::kInvalidArgument,
     "a frame does not fit what is known, and its stream asked to have it refused; the metadata name the `fault`"},
    {"OUT_OF_MEMORY", StatusCode::kResourceExhausted, "there is not enough memory; nothing was changed"},
    {"MAP_CHANGED", StatusCode::kInvalidArgument, "a later message of a stream names another map than the first"},
    {"BAD_SESSION", StatusCode::kInvalidArgument, "the name of a session is malformed, or changes within a stream"},
    // Objects and edits.
    {"SUBMAP_NOT_FOUND", StatusCode::kNotFound, "the map has no submap of this id"},
    {"MERGED_INTO", StatusCode::kNotFound,
     "the submap is a part of another now, which the metadata name as `merged_into`"},
    {"UNKNOWN_SUBMAP", StatusCode::kFailedPrecondition, "the submap of unknown objects cannot be edited"},
    {"ETAG_MISMATCH", StatusCode::kAborted, "the object has been edited since the etag given, or it is of another one"},
    {"BAD_EDIT", StatusCode::kInvalidArgument, "an edit has bad fields"},
    {"BAD_UPDATE_MASK", StatusCode::kInvalidArgument, "an update mask names fields that do not exist or cannot change"},
    {"EDITED_SINCE", StatusCode::kAborted, "an object was edited after the revision that the caller knows"},
    {"NOT_MERGEABLE", StatusCode::kFailedPrecondition, "the submaps are not things, or not on one grid"},
    {"IGNORED_REGION_EXISTS", StatusCode::kAlreadyExists, "there is an ignored region of this name already"},
    {"TOO_MANY_IGNORED_REGIONS", StatusCode::kResourceExhausted, "the map has as many ignored regions as it may have"},
    {"IGNORED_REGION_NOT_FOUND", StatusCode::kNotFound, "there is no ignored region of this name"},
    {"NOTHING_TO_SPLIT", StatusCode::kFailedPrecondition, "a split would leave one of its parts without a voxel"},
    {"NOT_A_THING", StatusCode::kFailedPrecondition, "what is asked for can be done to things only"},
    {"NO_SURFACE", StatusCode::kFailedPrecondition, "an object has no surface, or none where another is to be placed"},
    {"SUPPORT_MOVES", StatusCode::kFailedPrecondition,
     "an object cannot be placed on itself, or on what moves with it"},
    {"BAD_REQUEST_ID", StatusCode::kInvalidArgument, "the id of a request is no UUID"},
    {"REQUEST_ID_REUSED", StatusCode::kInvalidArgument, "another request had this id before: nothing was done"},
    {"BAD_AUTHOR", StatusCode::kInvalidArgument, "the name of an author is too long"},
    {"EDIT_NOT_FOUND", StatusCode::kNotFound, "the log of the map has no edit of this id, or no longer"},
    {"NOTHING_TO_UNDO", StatusCode::kFailedPrecondition,
     "there are not so many edits to undo, or it is undone already"},
    {"NOTHING_TO_REDO", StatusCode::kFailedPrecondition,
     "there are not so many edits to do again, or it is not undone"},
    {"UNDO_NOT_KEPT", StatusCode::kFailedPrecondition, "what it takes to undo the edit is no longer kept"},
    {"UNDO_CONFLICT", StatusCode::kAborted, "what the edit left has changed since, as the metadata say"},
    {"TOO_MANY_EDITS", StatusCode::kResourceExhausted, "the queue of edits of the map is full: try again later"},
    {"NOT_STORED", StatusCode::kOk, "what was asked for could not be stored; the code is that of the failure"},
    // Lists.
    {"BAD_PAGE_TOKEN", StatusCode::kInvalidArgument, "a page token is not one of ours, or of another request"},
    {"BAD_PAGE_SIZE", StatusCode::kInvalidArgument, "a page size is negative"},
    // Queries.
    {"BAD_FILTER", StatusCode::kInvalidArgument, "a filter of submaps has bad fields"},
    {"BAD_POINTS", StatusCode::kInvalidArgument, "the points of a query are not usable, or too many"},
    {"BAD_DISTANCE", StatusCode::kInvalidArgument, "a distance is not finite or negative"},
    {"BAD_MESH_REQUEST", StatusCode::kInvalidArgument, "a mesh is asked for in a form that is not known"},
    // The store.
    {"DAMAGED_MAP", StatusCode::kOk, "a stored map cannot be read: DATA_LOSS, or the code of the cause"},
    {"DAMAGED_CHANGES", StatusCode::kDataLoss, "what is kept of a map's changes is damaged; the map is not"},
    {"DAMAGED_EDITS", StatusCode::kDataLoss,
     "the log of a map's edits, or what undoes one, is damaged; the map is not"},
    {"NEWER_LAYER", StatusCode::kFailedPrecondition, "a stored map has a layer or an encoding of a newer version"},
    {"NEWER_CONFIG", StatusCode::kFailedPrecondition, "a stored map's config is of a newer version"},
    {"RETIRED_CONFIG", StatusCode::kFailedPrecondition, "a stored map uses a setting that this version no longer has"},
    {"STALE_REVISION", StatusCode::kFailedPrecondition, "a commit starts from another revision than the one stored"},
    {"STALE_STATE", StatusCode::kFailedPrecondition, "a commit starts from another state than the one stored"},
    {"BAD_SCHEMA", StatusCode::kDataLoss, "the database lacks a part of its schema"},
    {"NEWER_SCHEMA", StatusCode::kFailedPrecondition, "the database was written by a newer version"},
    {"OLDER_SCHEMA", StatusCode::kFailedPrecondition, "the database must be opened for writing once"},
    {"FOREIGN_DATABASE", StatusCode::kFailedPrecondition, "the file is a database of another application"},
    {"NO_DATABASE", StatusCode::kNotFound, "there is no database file"},
    {"NOT_A_FILE", StatusCode::kFailedPrecondition, "the database is not a file"},
    {"NOT_WRITABLE", StatusCode::kFailedPrecondition, "the database cannot be written"},
    {"NO_WAL", StatusCode::kFailedPrecondition, "the file system cannot hold a write-ahead log"},
    {"DATABASE_IN_USE", StatusCode::kFailedPrecondition, "another process writes to the database"},
    {"STORE_BEHIND", StatusCode::kUnavailable, "what is fused could not be stored for too long: frames are refused"},
    {"BACKUP_EXISTS", StatusCode::kAlreadyExists, "there is a file where a backup is to be written"},
    {"BAD_BACKUP_PATH", StatusCode::kInvalidArgument, "a backup cannot be written there"},
    // The server and its doors.
    {"SHUTTING_DOWN", StatusCode::kUnavailable, "the server is shutting down"},
    {"TOO_BUSY", StatusCode::kResourceExhausted, "too many calls of the kind wait, or too many bytes: try again later"},
    {"OVER_MEMORY_BUDGET", StatusCode::kResourceExhausted, "requests hold as many voxels in memory as they may"},
    {"CANNOT_BIND", StatusCode::kUnavailable, "the address to listen on is in use or not of this machine"},
    {"BAD_TIMEOUT", StatusCode::kInvalidArgument, "a timeout header is malformed"},
    {"BAD_HEADER", StatusCode::kInvalidArgument, "a header's value is not printable ASCII"},
    {"BAD_QUERY", StatusCode::kInvalidArgument, "a URL's query names no field, or has a bad value"},
    {"BAD_TARGET", StatusCode::kInvalidArgument, "a request's target is not a path"},
    {"BAD_FIELD", StatusCode::kInvalidArgument, "a field of a JSON body is unknown or has a bad value"},
    {"MALFORMED_JSON", StatusCode::kInvalidArgument, "a body is not JSON"},
    {"MALFORMED_PROTOBUF", StatusCode::kInvalidArgument, "what was sent is not a message of the type wanted"},
    {"MALFORMED_HTTP", StatusCode::kInvalidArgument, "a request is not HTTP"},
    {"UNEXPECTED_BODY", StatusCode::kInvalidArgument, "the request takes no body"},
    {"UNKNOWN_PATH", StatusCode::kNotFound, "there is nothing at this path"},
    {"FOREIGN_ORIGIN", StatusCode::kPermissionDenied, "the request comes from a web page of another origin"},
    {"METHOD_NOT_ALLOWED", StatusCode::kUnimplemented, "the path takes other HTTP methods"},
    {"BODY_TOO_LARGE", StatusCode::kResourceExhausted, "the body is larger than the server takes"},
    {"UNSUPPORTED_MEDIA_TYPE", StatusCode::kInvalidArgument, "the body is of a type that is not taken"},
    {"NOT_ACCEPTABLE", StatusCode::kInvalidArgument, "the answer comes in no type that the client accepts"},
    {"HEADER_TOO_LARGE", StatusCode::kResourceExhausted, "the header of the request is larger than the server takes"},
    {"UNKNOWN_TRANSFER_CODING", StatusCode::kUnimplemented, "the body is in a transfer coding other than chunked"},
    {"HOST_NOT_ALLOWED", StatusCode::kPermissionDenied, "the request's Host is no name of this server"},
    {"TOO_MANY_CONNECTIONS", StatusCode::kUnavailable, "as many connections as the server takes are busy"},
    {"TOO_MANY_BYTES", StatusCode::kResourceExhausted, "as many bytes are in flight as the server takes: try again"},
    // Data sets.
    {"MISSING_FILE", StatusCode::kNotFound, "a file of a data set is not there or cannot be read"},
    {"NO_LABELS", StatusCode::kFailedPrecondition, "a data set has no labels of the kind wanted"},
    {"BAD_LABELS", StatusCode::kInvalidArgument, "a file of labels is malformed"},
    {"BAD_POSE", StatusCode::kInvalidArgument, "a file of poses is malformed"},
    {"BAD_SCAN", StatusCode::kInvalidArgument, "a LiDAR scan is malformed"},
    {"NO_MATCH", StatusCode::kOk, "a frame lacks the pose, time or picture that goes with it"},
    {"NO_CLASS_MAP", StatusCode::kFailedPrecondition, "classes differ, and no file says which are the same"},
    // Keys.
    {"NO_CREDENTIAL", StatusCode::kUnauthenticated, "the server wants a key, and the call shows none"},
    {"BAD_CREDENTIAL", StatusCode::kUnauthenticated, "the key that the call shows is none of the server's"},
    {"KEY_EXPIRED", StatusCode::kUnauthenticated, "the time of the key is over"},
    {"KEY_REVOKED", StatusCode::kUnauthenticated, "the key has been revoked"},
    {"AMBIGUOUS_CREDENTIAL", StatusCode::kInvalidArgument, "the call shows more than one key"},
    {"TOKEN_IN_URL", StatusCode::kInvalidArgument,
     "the URL holds a key, which logs would keep: send it in Authorization, and replace it"},
    {"ROLE_NOT_ALLOWED", StatusCode::kPermissionDenied, "the role of the key does not have what the call needs"},
    {"MAP_NOT_ALLOWED", StatusCode::kPermissionDenied, "the key is not for this map, whether there is one or not"},
    {"NOT_YOUR_NAME", StatusCode::kPermissionDenied,
     "an author is named, or an edit is undone, that is not of who asks"},
    {"NOT_YOUR_SESSION", StatusCode::kPermissionDenied, "the key is not for this session"},
    {"OUT_OF_QUOTA", StatusCode::kResourceExhausted,
     "who asks makes as many calls, or has as many streams or maps, as one may"},
    {"TOO_MANY_LOGINS", StatusCode::kResourceExhausted, "too many wrong keys came from this address: try again later"},
    {"BAD_KEY_FILE", StatusCode::kFailedPrecondition, "the file of keys cannot be used"},
    {"BAD_KEY", StatusCode::kInvalidArgument, "a key to be made has a bad name, role, pattern or time"},
    {"KEY_NOT_FOUND", StatusCode::kNotFound, "the file has no such key"},
    // Several servers on one database.
    {"NOT_OWNER", StatusCode::kUnavailable, "another server writes the map; the metadata name its address as `owner`"},
    {"OWNER_UNREACHABLE", StatusCode::kUnavailable, "the server that writes the map cannot be reached: try later"},
    {"DATABASE_UNREACHABLE", StatusCode::kUnavailable,
     "the server has not reached its database for so long that another one may write its maps"},
    {"NO_FLEET", StatusCode::kFailedPrecondition, "the server is the only one of its database"},
};

/// A reason of the table, or none. WithReason("MAP_NOT_FOUND") does not compile for a name that is not in the table.
/// Value type.
class Reason {
 public:
  constexpr Reason() = default;
  /// NOLINTNEXTLINE(google-explicit-constructor): a name is a reason
  consteval Reason(const char* name) : row_(RowOf(name)) {
    if (row_ == kNone) IsNotInTheTable();
  }

  /// Finds a reason by a name from outside; none if unknown.
  static constexpr Reason Find(std::string_view name) {
    Reason reason;
    reason.row_ = RowOf(name);
    return reason;
  }

  [[nodiscard]] constexpr bool empty() const { return row_ == kNone; }
  /// Empty for none.
  [[nodiscard]] constexpr std::string_view name() const { return empty() ? std::string_view() : Row().name; }
  /// Whether it may come with `code`; an empty reason may come with any.
  [[nodiscard]] constexpr bool Allows(StatusCode code) const {
    return empty() || Row().code == StatusCode::kOk || Row().code == code;
  }

  friend constexpr bool operator==(Reason a, Reason b) { return a.row_ == b.row_; }
  friend std::ostream& operator<<(std::ostream& out, Reason reason) { return out << reason.name(); }

 private:
  // A number, not a pointer: GCC's sanitizers do not let constant expressions compare pointers with null.
  static constexpr int kNone = -1;

  static constexpr int RowOf(std::string_view name) {
    for (int i = 0; i < static_cast<int>(std::size(kReasonTable)); ++i) {
      if (kReasonTable[i].name == name) return i;
    }
    return kNone;
  }
  [[nodiscard]] constexpr const ReasonRow& Row() const { return kReasonTable[row_]; }
  static void IsNotInTheTable() {}  // not constexpr: ends the evaluation with an error

  int row_ = kNone;
};

}  // namespace dhpmap

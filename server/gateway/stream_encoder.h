// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "server/gateway/content_encoding.h"
#include "server/gateway/rpc_status.h"
#include "server/gateway/transcoder.h"
#include "server/http/message.h"

namespace dhpmap::gateway {

class SharedAnswers;

struct StreamHead {
  http::Headers headers;
  std::string etag;                     ///< of a file that has one; it is in the headers, too
  std::optional<std::uint64_t> length;  ///< before compression
};

/// What one message of a stream adds to the answer.
struct StreamPart {
  std::optional<StreamHead> head;  ///< of the first
  std::string data;                ///< may be empty
  std::size_t num_bytes = 0;       ///< of it before it was compressed
};

/// Encodes the messages of one streamed answer, or the one of an RPC whose client alone streams: as NDJSON, as
/// server-sent events, as length-delimited protobuf, or, for an RPC that sends a file and a client that asks for
/// neither of them, as the file. Thread-compatible.
class StreamEncoder {
 public:
  /// `file_stem`: a file's name, without its extension. `shared`: for events; may be null. `accept`: the client's, who
  /// takes files compressed if `takes_gzip`.
  StreamEncoder(const Route& route, AnswerFormat format, std::string file_stem, SharedAnswers* shared = nullptr,
                std::string accept = {}, bool takes_gzip = false);

  /// INTERNAL if it is no message of the RPC's type; NOT_ACCEPTABLE for a file that the client does not accept.
  Result<StreamPart> Encode(const std::string& message);

  /// An error can be told in the answer itself.
  [[nodiscard]] bool is_text() const { return !is_file_ && !is_one_ && format_ != AnswerFormat::kProtobuf; }
  /// Whether what it makes is compressed; known with the first part.
  [[nodiscard]] bool is_gzip() const { return gzip_.has_value(); }
  /// What is left of a compressed file after its last message; else nothing.
  [[nodiscard]] std::string End() { return gzip_ ? gzip_->End() : std::string(); }
  /// How, as the last of it.
  [[nodiscard]] std::string ErrorText(const RpcStatus& status) const;
  /// What says nothing, to find out whether the client of a stream that is silent is still there; may be empty.
  [[nodiscard]] std::string_view Silence() const;
  /// Of a stream without messages.
  [[nodiscard]] http::Headers EmptyHead() const;

 private:
  Result<StreamPart> EncodeFile(const std::string& message);
  Result<StreamPart> EncodeOne(const std::string& message);

  const Route& route_;
  AnswerFormat format_;
  std::string file_stem_;
  std::string accept_;
  SharedAnswers* shared_;
  bool is_file_;
  bool is_one_;  ///< message, as of an RPC that does not stream
  bool takes_gzip_;
  std::optional<GzipStream> gzip_;
  bool is_first_ = true;
};

/// What a message of an RPC that sends a file (Route::file) has of it.
struct FilePart {
  std::string type;  ///< may be empty
  std::int64_t total_bytes = 0;
  std::string etag;  ///< may be empty
  std::string data;
};
/// INTERNAL if it is no message of the RPC's type.
Result<FilePart> FilePartOf(const Route& route, const std::string& message);
/// NOT_ACCEPTABLE unless the client accepts the file, or bytes of any kind.
Status CheckAccepted(std::string_view accept, const FilePart& file);
/// Of the answer; `type`: empty for bytes of any kind.
http::Headers FileHead(std::string type, const std::string& file_stem);

/// "ply" for "model/x-ply; charset=...", "bin" for what has no name of its own.
std::string ExtensionOf(std::string_view content_type);

}  // namespace dhpmap::gateway

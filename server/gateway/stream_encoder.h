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
  std::string etag;                     ///< of a file, if it has one; also in the headers
  std::optional<std::uint64_t> length;  ///< before compression
};

/// The part of the answer that one message adds.
struct StreamPart {
  std::optional<StreamHead> head;  ///< with the first message
  std::string data;                ///< may be empty
  std::size_t num_bytes = 0;       ///< of data, before compression
};

/// Encodes the messages of a streamed answer, or the single answer to a client stream: as NDJSON, server-sent events,
/// or length-delimited protobuf. If the RPC sends a file and the client asks for none of these, as the file.
/// Thread-compatible.
class StreamEncoder {
 public:
  /// `file_stem`: file name without extension. `shared`: for events; may be null. `accept`: the client's header;
  /// `takes_gzip`: the client accepts compressed files.
  StreamEncoder(const Route& route, AnswerFormat format, std::string file_stem, SharedAnswers* shared = nullptr,
                std::string accept = {}, bool takes_gzip = false);

  /// INTERNAL if it is not a message of the RPC's type; NOT_ACCEPTABLE for a file that the client does not accept.
  Result<StreamPart> Encode(const std::string& message);

  /// Whether the answer itself can carry an error.
  [[nodiscard]] bool is_text() const { return !is_file_ && !is_one_ && format_ != AnswerFormat::kProtobuf; }
  /// Whether the output is compressed; known with the first part.
  [[nodiscard]] bool is_gzip() const { return gzip_.has_value(); }
  /// The rest of a compressed file, after its last message; else "".
  [[nodiscard]] std::string End() { return gzip_ ? gzip_->End() : std::string(); }
  /// The error as the last part of the answer.
  [[nodiscard]] std::string ErrorText(const RpcStatus& status) const;
  /// Data without meaning, to find out whether the client of a silent stream is still there; may be empty.
  [[nodiscard]] std::string_view Silence() const;
  /// The headers of a stream without messages.
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
  bool is_one_;  ///< a single message, of an RPC that does not stream its answer
  bool takes_gzip_;
  std::optional<GzipStream> gzip_;
  bool is_first_ = true;
};

/// The file fields (Route::file) of one message.
struct FilePart {
  std::string type;  ///< may be empty
  std::int64_t total_bytes = 0;
  std::string etag;  ///< may be empty
  std::string data;
};
/// INTERNAL if it is not a message of the RPC's type.
Result<FilePart> FilePartOf(const Route& route, const std::string& message);
/// NOT_ACCEPTABLE unless the client accepts the file's type, or bytes of any kind.
Status CheckAccepted(std::string_view accept, const FilePart& file);
/// The headers of a file. `type`: empty for bytes of any kind.
http::Headers FileHead(std::string type, const std::string& file_stem);

/// "ply" for "model/x-ply; charset=...", "bin" for types without an extension.
std::string ExtensionOf(std::string_view content_type);

}  // namespace dhpmap::gateway

// SPDX-License-Identifier: BSD-3-Clause
#include "server/gateway/stream_encoder.h"

#include <google/protobuf/descriptor.h>
#include <google/protobuf/message.h>

#include <algorithm>

#include "server/gateway/error_body.h"
#include "server/gateway/media_type.h"
#include "server/gateway/shared_answers.h"

namespace dhpmap::gateway {
namespace {

/// Replaces control characters, so that a value cannot end its header early.
std::string HeaderValue(std::string text) {
  std::replace_if(
      text.begin(), text.end(), [](char c) { return c < 0x20 || c == 0x7F; }, ' ');
  return text;
}

}  // namespace

StreamEncoder::StreamEncoder(const Route& route, AnswerFormat format, std::string file_stem, SharedAnswers* shared,
                             std::string accept, bool takes_gzip)
    : route_(route),
      format_(format),
      file_stem_(std::move(file_stem)),
      accept_(std::move(accept)),
      shared_(route.events ? shared : nullptr),
      is_file_(route.file.has_value() && format == AnswerFormat::kAny),
      is_one_(!route.server_streams()),
      takes_gzip_(takes_gzip) {}

http::Headers StreamEncoder::EmptyHead() const {
  if (is_file_) return {{"Content-Type", std::string(kBytesType)}};
  if (is_one_) {
    return {{"Content-Type", std::string(format_ == AnswerFormat::kProtobuf ? kProtobufType : kJsonType)}};
  }
  if (format_ == AnswerFormat::kEvents) {
    // Proxies must neither store nor buffer events.
    return {{"Content-Type", std::string(kEventsType)}, {"Cache-Control", "no-store"}, {"X-Accel-Buffering", "no"}};
  }
  return {{"Content-Type", std::string(format_ == AnswerFormat::kProtobuf ? kProtobufStreamType : kNdjsonType)}};
}

Result<StreamPart> StreamEncoder::Encode(const std::string& message) {
  if (is_file_) return EncodeFile(message);
  if (is_one_) return EncodeOne(message);
  StreamPart part;
  if (is_first_) part.head = StreamHead{EmptyHead(), {}, std::nullopt};
  is_first_ = false;
  DHPMAP_ASSIGN_OR_RETURN(part.data, shared_ != nullptr ? shared_->Make(route_, message, format_)
                                                        : ToStreamAnswer(route_, message, format_));
  part.num_bytes = part.data.size();
  return part;
}

std::string StreamEncoder::ErrorText(const RpcStatus& status) const {
  return format_ == AnswerFormat::kEvents ? "event: error\ndata: " + ErrorJson(status) + "\n\n" : ErrorLine(status);
}

std::string_view StreamEncoder::Silence() const {
  if (!route_.events || !is_text()) return {};
  return format_ == AnswerFormat::kEvents ? ":\n\n" : "\n";
}

Result<StreamPart> StreamEncoder::EncodeFile(const std::string& bytes) {
  DHPMAP_ASSIGN_OR_RETURN(FilePart file, FilePartOf(route_, bytes));
  StreamPart part;
  if (is_first_) {
    DHPMAP_RETURN_IF_ERROR(CheckAccepted(accept_, file));
    is_first_ = false;
    const bool is_varied = IsWorthGzip(file.type);
    if (takes_gzip_ && is_varied) gzip_.emplace();
    const std::string etag = EtagOfVariant(file.etag, is_gzip());
    part.head = StreamHead{FileHead(std::move(file.type), file_stem_), etag, std::nullopt};
    if (!etag.empty()) {
      // Caches may store it, but must revalidate each time.
      part.head->headers.emplace_back("ETag", '"' + etag + '"');
      part.head->headers.emplace_back("Cache-Control", "no-cache");
    }
    if (is_varied) part.head->headers.emplace_back("Vary", "Accept-Encoding");
    if (gzip_) part.head->headers.emplace_back("Content-Encoding", "gzip");
    if (file.total_bytes > 0) part.head->length = static_cast<std::uint64_t>(file.total_bytes);
  }
  part.num_bytes = file.data.size();
  part.data = gzip_ ? gzip_->Add(file.data) : std::move(file.data);
  return part;
}

Result<StreamPart> StreamEncoder::EncodeOne(const std::string& message) {
  StreamPart part;
  DHPMAP_ASSIGN_OR_RETURN(part.data, ToAnswer(route_, message, format_));
  if (format_ != AnswerFormat::kProtobuf) part.data += '\n';
  part.num_bytes = part.data.size();
  part.head = StreamHead{EmptyHead(), {}, part.data.size()};
  return part;
}

Result<FilePart> FilePartOf(const Route& route, const std::string& bytes) {
  const auto message = NewMessage(*route.method->output_type());
  if (!message->ParseFromString(bytes)) {
    return Internal("the answer is not a " + route.method->output_type()->full_name());
  }
  const auto& reflection = *message->GetReflection();
  FilePart part;
  part.type = HeaderValue(reflection.GetString(*message, route.file->content_type));
  if (route.file->total_bytes != nullptr) part.total_bytes = reflection.GetInt64(*message, route.file->total_bytes);
  if (route.file->etag != nullptr) part.etag = HeaderValue(reflection.GetString(*message, route.file->etag));
  part.data = reflection.GetString(*message, route.file->data);
  return part;
}

Status CheckAccepted(std::string_view accept, const FilePart& file) {
  if (IsAccepted(accept, kBytesType) || IsAccepted(accept, file.type)) return Status::Ok();
  return NotAcceptable(accept, file.type.empty() ? kBytesType : file.type);
}

http::Headers FileHead(std::string type, const std::string& file_stem) {
  if (type.empty()) type = kBytesType;
  http::Headers headers;
  headers.emplace_back("Content-Disposition", "attachment; filename=\"" + file_stem + "." + ExtensionOf(type) + "\"");
  headers.emplace_back("Content-Type", std::move(type));
  return headers;
}

std::string ExtensionOf(std::string_view content_type) {
  content_type = content_type.substr(0, content_type.find(';'));
  std::string_view name = content_type.substr(content_type.find('/') + 1);
  for (const std::string_view prefix : {"vnd.", "x-"}) {
    if (name.starts_with(prefix)) name.remove_prefix(prefix.size());
  }
  if (name == "portable-graymap") return "pgm";
  if (name == "gltf-binary") return "glb";
  const bool plain = !name.empty() && name.size() <= 8 && std::all_of(name.begin(), name.end(), [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9');
  });
  return plain ? std::string(name) : "bin";
}

}  // namespace dhpmap::gateway

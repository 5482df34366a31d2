// SPDX-License-Identifier: BSD-3-Clause
#include "server/grpc/reflection_answers.h"

#include <google/protobuf/descriptor.h>
#include <google/protobuf/descriptor.pb.h>

#include <set>

#include "mapping/base/result.h"

namespace dhpmap {
namespace {

using google::protobuf::Descriptor;
using google::protobuf::DescriptorPool;
using google::protobuf::FieldDescriptor;
using google::protobuf::FileDescriptor;
using ReflectionRequest = grpc::reflection::v1::ServerReflectionRequest;
using ReflectionResponse = grpc::reflection::v1::ServerReflectionResponse;

const DescriptorPool& Pool() { return *DescriptorPool::generated_pool(); }

/// Adds `file` and its direct and indirect imports, each once.
void Describe(const FileDescriptor& file, ReflectionResponse& response) {
  auto& answer = *response.mutable_file_descriptor_response();
  std::vector<const FileDescriptor*> files{&file};
  std::set<const FileDescriptor*> seen{&file};
  for (std::size_t i = 0; i < files.size(); ++i) {
    const FileDescriptor& described = *files[i];
    google::protobuf::FileDescriptorProto proto;
    described.CopyTo(&proto);
    proto.SerializeToString(answer.add_file_descriptor_proto());
    for (int k = 0; k < described.dependency_count(); ++k) {
      if (seen.insert(described.dependency(k)).second) files.push_back(described.dependency(k));
    }
  }
}

Status DescribeIfThere(const FileDescriptor* file, const char* what, ReflectionResponse& response) {
  if (file == nullptr) return NotFound(std::string("there is no such ") + what);
  Describe(*file, response);
  return Status::Ok();
}

Status DescribeExtension(const grpc::reflection::v1::ExtensionRequest& asked, ReflectionResponse& response) {
  const Descriptor* type = Pool().FindMessageTypeByName(asked.containing_type());
  if (type == nullptr) return NotFound("there is no such type");
  const FieldDescriptor* extension = Pool().FindExtensionByNumber(type, asked.extension_number());
  return DescribeIfThere(extension != nullptr ? extension->file() : nullptr, "extension", response);
}

Status ListExtensions(const std::string& type_name, ReflectionResponse& response) {
  const Descriptor* type = Pool().FindMessageTypeByName(type_name);
  if (type == nullptr) return NotFound("there is no such type");
  std::vector<const FieldDescriptor*> extensions;
  Pool().FindAllExtensions(type, &extensions);
  auto& answer = *response.mutable_all_extension_numbers_response();
  answer.set_base_type_name(type->full_name());
  for (const FieldDescriptor* extension : extensions) answer.add_extension_number(extension->number());
  return Status::Ok();
}

Status AnswerOrError(const std::vector<std::string>& services, ReflectionResponse& response) {
  const ReflectionRequest& asked = response.original_request();
  switch (asked.message_request_case()) {
    case ReflectionRequest::kFileByFilename:
      return DescribeIfThere(Pool().FindFileByName(asked.file_by_filename()), "file", response);
    case ReflectionRequest::kFileContainingSymbol:
      return DescribeIfThere(Pool().FindFileContainingSymbol(asked.file_containing_symbol()), "symbol", response);
    case ReflectionRequest::kFileContainingExtension:
      return DescribeExtension(asked.file_containing_extension(), response);
    case ReflectionRequest::kAllExtensionNumbersOfType:
      return ListExtensions(asked.all_extension_numbers_of_type(), response);
    case ReflectionRequest::kListServices:
      for (const std::string& name : services) response.mutable_list_services_response()->add_service()->set_name(name);
      return Status::Ok();
    case ReflectionRequest::MESSAGE_REQUEST_NOT_SET: break;
  }
  return InvalidArgument("the message asks nothing that is known");
}

}  // namespace

void AnswerReflection(const std::vector<std::string>& services, ReflectionResponse& response) {
  response.set_valid_host(response.original_request().host());
  const Status status = AnswerOrError(services, response);
  if (status.ok()) return;
  auto& error = *response.mutable_error_response();
  error.set_error_code(static_cast<int>(status.code()));
  error.set_error_message(status.message());
}

}  // namespace dhpmap

// SPDX-License-Identifier: BSD-3-Clause
#include "clients/cli/token.h"

#include <sys/stat.h>

#include <fstream>
#include <iterator>
#include <utility>

namespace dhpmap {
namespace {

class ShowToken final : public grpc::experimental::Interceptor {
 public:
  explicit ShowToken(const std::string& header) : header_(header) {}
  void Intercept(grpc::experimental::InterceptorBatchMethods* methods) override {
    if (methods->QueryInterceptionHookPoint(grpc::experimental::InterceptionHookPoints::PRE_SEND_INITIAL_METADATA)) {
      methods->GetSendInitialMetadata()->insert({"authorization", header_});
    }
    methods->Proceed();
  }

 private:
  const std::string& header_;
};

class ShowTokenFactory final : public grpc::experimental::ClientInterceptorFactoryInterface {
 public:
  explicit ShowTokenFactory(const std::string& token) : header_("Bearer " + token) {}
  grpc::experimental::Interceptor* CreateClientInterceptor(grpc::experimental::ClientRpcInfo*) override {
    return new ShowToken(header_);
  }

 private:
  const std::string header_;
};

}  // namespace

Result<std::string> ReadTokenFile(const std::string& path) {
  struct stat status {};
  std::ifstream file(path);
  if (!file || stat(path.c_str(), &status) != 0) return NotFound("cannot read " + path);
  if ((status.st_mode & 077) != 0) return FailedPrecondition(path + " is open to others than its owner: chmod 600 it");
  constexpr std::size_t kMost = 4096;
  std::string text;
  for (std::istreambuf_iterator<char> c(file), end; c != end && text.size() <= kMost; ++c) text += *c;
  const std::size_t begin = text.find_first_not_of(" \t\r\n"), last = text.find_last_not_of(" \t\r\n");
  std::string token = begin == std::string::npos ? "" : text.substr(begin, last - begin + 1);
  const bool is_word = token.find_first_of(" \t\r\n") == std::string::npos;
  if (token.empty() || !is_word || text.size() > kMost) return InvalidArgument(path + " holds no key");
  return token;
}

bool StaysOnThisMachine(std::string_view server) {
  if (server.starts_with("unix:") || server.starts_with("[::1]")) return true;
  const std::string_view host = server.substr(0, server.rfind(':'));
  return host == "localhost" ||
         (host.starts_with("127.") && host.find_first_not_of("0123456789.") == std::string_view::npos);
}

std::vector<std::unique_ptr<grpc::experimental::ClientInterceptorFactoryInterface>> ShowingToken(
    const std::string& token) {
  std::vector<std::unique_ptr<grpc::experimental::ClientInterceptorFactoryInterface>> factories;
  factories.push_back(std::make_unique<ShowTokenFactory>(token));
  return factories;
}

}  // namespace dhpmap

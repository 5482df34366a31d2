// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <openssl/ssl.h>
#include <sys/stat.h>

#include <filesystem>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "server/net/tls_context.h"
#include "tests/support/assert_ok.h"
#include "tests/support/scenes.h"
#include "tests/unit/server/http/http_client.h"
#include "tests/unit/server/net/door_fixture.h"
#include "tests/unit/server/net/http2_bytes.h"
#include "tests/unit/server/net/test_certificates.h"
#include "tests/unit/server/net/tls_client.h"

namespace dhpmap::net {
namespace {

namespace fs = std::filesystem;
using testing::CertificateFiles;
using testing::CertificateWish;
using testing::MakeCertificate;
using testing::TlsClient;
using testing::TlsClientOptions;

class TlsTest : public DoorTest {
 protected:
  CertificateFiles Make(const std::string& name, const CertificateWish& wish = {}) const {
    return MakeCertificate(folder_.path(), name, wish);
  }
  void OpenWith(const TlsOptions& options, Protocol protocol = Protocol::kHttp2) {
    auto tls = TlsContext::Load(options);
    ASSERT_OK(tls);
    tls_ = *tls;
    OpenDoor({.protocol = protocol, .tls = tls_});
  }
  static void Copy(const std::string& from, const std::string& to) {
    fs::copy_file(from, to, fs::copy_options::overwrite_existing);
  }
  TlsClientOptions Trusting(const CertificateFiles& ca) const { return {.ca = ca.cert}; }

  testing::TempDir folder_;
  std::shared_ptr<TlsContext> tls_;
};

const std::string kPrefaceBytes(kHttp2Preface);

TEST_F(TlsTest, RelaysBytesBothWaysForClientsThatTrustTheCertificate) {
  const CertificateFiles own = Make("own");
  OpenWith({.cert = own.cert, .key = own.key});
  TlsClient client(door_->port(), Trusting(own));
  ASSERT_TRUE(client.is_connected()) << client.error();
  EXPECT_EQ(client.protocol(), "h2");
  const std::string frames = testing::FrameBytes(FrameType::kPing, 0, 0, "12345678");
  ASSERT_TRUE(client.Send(kPrefaceBytes + frames));  // in one record: what follows the preface is passed on, too
  const auto inner = behind_.Next();
  ASSERT_TRUE(inner);
  EXPECT_EQ(inner->Read(kPrefaceBytes.size() + frames.size()), kPrefaceBytes + frames);
  const std::string long_answer(5'000'000, 'a');
  std::thread sender([&] { EXPECT_TRUE(inner->Say(long_answer)); });
  EXPECT_EQ(client.ReadExactly(long_answer.size()), long_answer);
  sender.join();
}

TEST_F(TlsTest, ClientsThatTrustAnotherCertificateDoNotConnect) {
  const CertificateFiles own = Make("own"), other = Make("other");
  OpenWith({.cert = own.cert, .key = own.key});
  EXPECT_FALSE(TlsClient(door_->port(), Trusting(other)).is_connected());
}

TEST_F(TlsTest, RefusesOldVersionsSlowGroupsAndWeakCiphers) {
  const CertificateFiles own = Make("own");
  OpenWith({.cert = own.cert, .key = own.key});
  EXPECT_FALSE(TlsClient(door_->port(), {.most_version = TLS1_1_VERSION}).is_connected());
  EXPECT_FALSE(TlsClient(door_->port(), {.groups = "ffdhe8192"}).is_connected());
  EXPECT_FALSE(TlsClient(door_->port(), {.groups = "P-521"}).is_connected());
  EXPECT_FALSE(TlsClient(door_->port(), {.most_version = TLS1_2_VERSION, .ciphers = "ECDHE-ECDSA-AES128-SHA256"})
                   .is_connected());
  EXPECT_TRUE(TlsClient(door_->port(), {.most_version = TLS1_2_VERSION}).is_connected());
  EXPECT_TRUE(TlsClient(door_->port(), {.least_version = TLS1_3_VERSION, .groups = "P-384"}).is_connected());
  EXPECT_TRUE(IsRefused(Refusal::kHandshake, 4));
}

TEST_F(TlsTest, RefusesToRenegotiate) {
  const CertificateFiles own = Make("own");
  OpenWith({.cert = own.cert, .key = own.key});
  TlsClient client(door_->port(), {.most_version = TLS1_2_VERSION});
  ASSERT_TRUE(client.is_connected());
  EXPECT_FALSE(client.Renegotiate());
}

TEST_F(TlsTest, EndsAFloodOfNewKeys) {
  const CertificateFiles own = Make("own");
  OpenWith({.cert = own.cert, .key = own.key});
  TlsClient flood(door_->port(), {.least_version = TLS1_3_VERSION});
  ASSERT_TRUE(flood.is_connected());
  flood.UpdateKeys(1000);
  EXPECT_EQ(flood.Read(), "");
  EXPECT_EQ(NumRefused(Refusal::kSilent), 0u) << "the server has ended it, and not for want of a preface";
  EXPECT_TRUE(TlsClient(door_->port(), {}).is_connected()) << "others come in";
}

TEST_F(TlsTest, RequiresHttp2AtOneDoorOnly) {
  const CertificateFiles own = Make("own");
  OpenWith({.cert = own.cert, .key = own.key});
  EXPECT_FALSE(TlsClient(door_->port(), {.protocol = "http/1.1"}).is_connected());
  TlsClient unsaid(door_->port(), {.protocol = ""});
  (void)unsaid.Send(kPrefaceBytes);
  EXPECT_EQ(unsaid.Read(), "");
  EXPECT_EQ(behind_.size(), 0u);
  door_.reset();
  OpenWith({.cert = own.cert, .key = own.key}, Protocol::kHttp11);
  EXPECT_FALSE(TlsClient(door_->port(), {.protocol = "h2"}).is_connected());
  EXPECT_TRUE(TlsClient(door_->port(), {.protocol = "http/1.1"}).is_connected());
  EXPECT_TRUE(TlsClient(door_->port(), {.protocol = ""}).is_connected());
}

TEST_F(TlsTest, RequestsClientCertificatesAndReturnsTheirNames) {
  const CertificateFiles own = Make("own"), authority = Make("authority", {.common_name = "fleet"}),
                         other = Make("other");
  const CertificateFiles robot = Make(
      "robot", {.common_name = "admin", .alt_names = "DNS:robot-7.hall,URI:robot://hall/7", .signed_by = &authority});
  const CertificateFiles stranger = Make("stranger", {.signed_by = &other});
  OpenWith({.cert = own.cert, .key = own.key, .client_ca = authority.cert, .client_auth = ClientAuth::kRequired});
  TlsClient good(door_->port(), {.own = &robot});
  ASSERT_TRUE(good.Send(kPrefaceBytes));
  const auto inner = behind_.Next();
  ASSERT_TRUE(inner);
  EXPECT_EQ(inner->peer.certificate_name, "robot://hall/7");
  for (const CertificateFiles* shown : {static_cast<const CertificateFiles*>(nullptr), &stranger}) {
    TlsClient bad(door_->port(), {.own = shown});  // in TLS 1.3 it hears of it with the first answer
    (void)bad.Send(kPrefaceBytes);
    EXPECT_EQ(bad.Read(), "");
  }
  EXPECT_TRUE(IsRefused(Refusal::kHandshake, 2));
  EXPECT_EQ(behind_.size(), 0u);
}

TEST_F(TlsTest, ReloadsAMatchingPairAndKeepsTheOldOneOtherwise) {
  const CertificateFiles used = Make("used", {.common_name = "first"});
  const CertificateFiles second = Make("second", {.common_name = "second"});
  const CertificateFiles expired = Make("expired", {.is_expired = true});
  OpenWith({.cert = used.cert, .key = used.key});
  const auto name_now = [&] { return TlsClient(door_->port(), {}).common_name(); };
  TlsClient before(door_->port(), {});
  EXPECT_FALSE(tls_->ReloadIfChanged());
  Copy(second.cert, used.cert);  // the key does not follow yet
  const auto mismatch = tls_->ReloadIfChanged();
  ASSERT_TRUE(mismatch);
  EXPECT_EQ(mismatch->code(), StatusCode::kInvalidArgument);
  EXPECT_EQ(name_now(), "first");
  EXPECT_FALSE(tls_->ReloadIfChanged());  // said once
  Copy(second.key, used.key);
  const auto fitting = tls_->ReloadIfChanged();
  EXPECT_TRUE(fitting && fitting->ok());
  EXPECT_EQ(name_now(), "second");
  Copy(expired.cert, used.cert);
  Copy(expired.key, used.key);
  EXPECT_FALSE(tls_->Reload().ok());
  fs::resize_file(used.cert, 100);
  EXPECT_FALSE(tls_->Reload().ok());
  fs::remove(used.cert);
  EXPECT_FALSE(tls_->Reload().ok());
  EXPECT_EQ(name_now(), "second");
  ASSERT_TRUE(before.Send(kPrefaceBytes));  // from the time of the first
  EXPECT_TRUE(behind_.Next());
}

TEST_F(TlsTest, RefusesAKeyThatOthersMayRead) {
  const CertificateFiles own = Make("own");
  ::chmod(own.key.c_str(), 0644);
  const auto tls = TlsContext::Load({.cert = own.cert, .key = own.key});
  EXPECT_EQ(tls.status().code(), StatusCode::kFailedPrecondition);
  EXPECT_NE(tls.status().message().find(own.key), std::string::npos);
  ::chmod(own.key.c_str(), 0640);
  EXPECT_OK(TlsContext::Load({.cert = own.cert, .key = own.key}));
}

TEST_F(TlsTest, RefusesUnencryptedClients) {
  const CertificateFiles own = Make("own");
  OpenWith({.cert = own.cert, .key = own.key});
  http::HttpClient client(door_->port());
  client.SendRaw(kPrefaceBytes);
  EXPECT_TRUE(client.IsClosedByServer());
  EXPECT_TRUE(IsRefused(Refusal::kHandshake));
}

TEST_F(TlsTest, ServesWhileSilentHandshakesUseUpTheirLimit) {
  const CertificateFiles own = Make("own");
  OpenWith({.cert = own.cert, .key = own.key});
  std::vector<std::unique_ptr<http::HttpClient>> silent;
  for (int i = 0; i < 150; ++i) silent.push_back(std::make_unique<http::HttpClient>(door_->port()));
  EXPECT_TRUE(IsRefused(Refusal::kTooManyNew, 150 - 64));
  TlsClient client(door_->port(), Trusting(own));
  ASSERT_TRUE(client.Send(kPrefaceBytes)) << client.error();
  EXPECT_TRUE(behind_.Next());
}

}  // namespace
}  // namespace dhpmap::net

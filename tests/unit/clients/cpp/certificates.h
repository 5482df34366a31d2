// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Of 127.0.0.1, made for tests alone: they guard nothing. Valid for a hundred years.
//   openssl req -x509 -newkey ec -pkeyopt ec_paramgen_curve:prime256v1 -nodes -days 36500 -subj /CN=localhost
//     -addext subjectAltName=IP:127.0.0.1,DNS:localhost

namespace dhpmap::testing {

inline constexpr char kOwnCertificate[] = R"(-----BEGIN CERTIFICATE-----
MIIBnDCCAUGgAwIBAgIUGTM9p9tZiVBJDkTyqiEe5YSSUygwCgYIKoZIzj0EAwIw
FDESMBAGA1UEAwwJbG9jYWxob3N0MCAXDTI2MTEzMDEzMzA1M1oYDzIxMjYxMTA2
MTMzMDUzWjAUMRIwEAYDVQQDDAlsb2NhbGhvc3QwWTATBgcqhkjOPQIBBggqhkjO
PQMBBwNCAATZSH+yU0uqOAIowG5SoNKoKIuCC5yXD+U94gIHeAipOtK7zeNh8VJs
4kZBKpmsx78DBDzsgh2T/mdtVcH+AXWIo28wbTAdBgNVHQ4EFgQUdrQd/8EYjk5K
3IXy/SCzXIk5YaAwHwYDVR0jBBgwFoAUdrQd/8EYjk5K3IXy/SCzXIk5YaAwDwYD
VR0TAQH/BAUwAwEB/zAaBgNVHREEEzARhwR/AAABgglsb2NhbGhvc3QwCgYIKoZI
zj0EAwIDSQAwRgIhAO/POQMm8XYjHnXlNcoGtsEi7HDsdXG6kb173BEdubnVAiEA
4M8PHPRxfs7oJqSjxy/TlXJuq+/LyoTg4A0UgQDeoW4=
-----END CERTIFICATE-----
)";
inline constexpr char kOwnKey[] = R"(-----BEGIN PRIVATE KEY-----
MIGHAgEAMBMGByqGSM49AgEGCCqGSM49AwEHBG0wawIBAQQgr6GtKWA1e1BPffYb
flFMINEcAlZHuKoxLnMt3lnF+jqhRANCAATZSH+yU0uqOAIowG5SoNKoKIuCC5yX
D+U94gIHeAipOtK7zeNh8VJs4kZBKpmsx78DBDzsgh2T/mdtVcH+AXWI
-----END PRIVATE KEY-----
)";
inline constexpr char kOtherCertificate[] = R"(-----BEGIN CERTIFICATE-----
MIIBmzCCAUGgAwIBAgIUB6eIq7xJZeCbLY2sM+gnVFSc6f4wCgYIKoZIzj0EAwIw
FDESMBAGA1UEAwwJbG9jYWxob3N0MCAXDTI2MTEzMDEzMzA1M1oYDzIxMjYxMTA2
MTMzMDUzWjAUMRIwEAYDVQQDDAlsb2NhbGhvc3QwWTATBgcqhkjOPQIBBggqhkjO
PQMBBwNCAARN2cU8qqxTwBGX4FLuv0LDF2Qq5t8g6zVhgOPOONlXpv7z14Vg+vMu
sVluYrZJcwUqd0vVGlgEWkb5YZiAwpdto28wbTAdBgNVHQ4EFgQU3lfWhgQylGXK
hkHIV3+CE/h78ucwHwYDVR0jBBgwFoAU3lfWhgQylGXKhkHIV3+CE/h78ucwDwYD
VR0TAQH/BAUwAwEB/zAaBgNVHREEEzARhwR/AAABgglsb2NhbGhvc3QwCgYIKoZI
zj0EAwIDSAAwRQIgRabZSFqbxbDnpDw0lmscpgzR/D+WBliV9SBLDvUeMWECIQCG
fmEp+lIeNrvjaUtc1o2SUWjM3GwYx8anpDeG8VzHsQ==
-----END CERTIFICATE-----
)";

}  // namespace dhpmap::testing

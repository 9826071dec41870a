#pragma once
#include <filesystem>

namespace ream::test {

/// What a certificate made for a test is like.
struct CertificateOptions {
  int begins_in_days = -1, ends_in_days = 30;
  int rsa_bits = 0;  ///< 0: an elliptic curve (P-256)
};

/// Writes a fresh key and a certificate for localhost that it signs itself, in PEM.
void make_certificate(const std::filesystem::path& certificate, const std::filesystem::path& key,
                      const CertificateOptions& options = {});

}  // namespace ream::test

#include "support/test_certificate.hpp"

#include <openssl/evp.h>
#include <openssl/pem.h>
#include <openssl/rsa.h>
#include <openssl/x509.h>

#include <cstdio>
#include <memory>
#include <stdexcept>

namespace ream::test {
namespace {

constexpr long day_s = 24 * 3600;

void require(bool went_well, const char* what) {
  if (!went_well) throw std::runtime_error(std::string("cannot make a certificate: ") + what);
}

template <typename Write>
void write_pem(const std::filesystem::path& path, Write write) {
  const std::unique_ptr<FILE, int (*)(FILE*)> file(std::fopen(path.c_str(), "w"), std::fclose);
  require(file && write(file.get()) == 1, path.c_str());
}

}  // namespace

void make_certificate(const std::filesystem::path& certificate, const std::filesystem::path& key,
                      const CertificateOptions& options) {
  const std::unique_ptr<EVP_PKEY, void (*)(EVP_PKEY*)> pair(
      options.rsa_bits > 0 ? EVP_RSA_gen(static_cast<unsigned>(options.rsa_bits)) : EVP_EC_gen("P-256"),
      EVP_PKEY_free);
  require(pair != nullptr, "key");
  const std::unique_ptr<X509, void (*)(X509*)> made(X509_new(), X509_free);
  X509_set_version(made.get(), X509_VERSION_3);
  ASN1_INTEGER_set(X509_get_serialNumber(made.get()), 1);
  X509_gmtime_adj(X509_getm_notBefore(made.get()), options.begins_in_days * day_s);
  X509_gmtime_adj(X509_getm_notAfter(made.get()), options.ends_in_days * day_s);
  X509_set_pubkey(made.get(), pair.get());
  X509_NAME* name = X509_get_subject_name(made.get());
  X509_NAME_add_entry_by_txt(name, "CN", MBSTRING_ASC, reinterpret_cast<const unsigned char*>("localhost"),
                             -1, -1, 0);
  X509_set_issuer_name(made.get(), name);
  require(X509_sign(made.get(), pair.get(), EVP_sha256()) > 0, "signature");
  write_pem(certificate, [&](FILE* file) { return PEM_write_X509(file, made.get()); });
  write_pem(key, [&](FILE* file) {
    return PEM_write_PrivateKey(file, pair.get(), nullptr, nullptr, 0, nullptr, nullptr);
  });
}

}  // namespace ream::test

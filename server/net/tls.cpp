#include "net/tls.hpp"

#include <openssl/err.h>
#include <openssl/pem.h>
#include <openssl/ssl.h>
#include <openssl/x509.h>
#include <sys/stat.h>
#include <boost/asio/ssl/context.hpp>

#include <string>

#include "core/error.hpp"
#include "core/file.hpp"
#include "core/log.hpp"

namespace ream::net {
namespace fs = std::filesystem;
namespace {

// TLS 1.3 has suites of its own, all of them with forward secrecy and authenticated encryption; these
// are 1.2's.
constexpr const char* ciphers_of_tls_1_2 = "ECDHE+AESGCM:ECDHE+CHACHA20";
constexpr int expires_soon_s = 14 * 24 * 3600;

template <auto Free>
struct Freed {
  template <typename T>
  void operator()(T* thing) const {
    Free(thing);
  }
};
using Bio = std::unique_ptr<BIO, Freed<BIO_free>>;
using Certificate = std::unique_ptr<X509, Freed<X509_free>>;
using Key = std::unique_ptr<EVP_PKEY, Freed<EVP_PKEY_free>>;

[[noreturn]] void refuse(const fs::path& file, const std::string& what) {
  ERR_clear_error();
  throw Error(ErrorKind::invalid_input, file.string() + " " + what);
}

Bio open_text(const std::string& text) {
  return Bio(BIO_new_mem_buf(text.data(), static_cast<int>(text.size())));
}

/// A key with a pass phrase must not make the program ask on its terminal.
int no_pass_phrase(char*, int, int, void*) { return 0; }

std::string time_of(const ASN1_TIME* time) {
  const Bio out(BIO_new(BIO_s_mem()));
  ASN1_TIME_print(out.get(), time);
  char* data = nullptr;
  const long size = BIO_get_mem_data(out.get(), &data);
  return {data, static_cast<size_t>(size)};
}

/// Returns a warning, or nothing.
std::string require_valid_today(X509* certificate, const fs::path& file) {
  const ASN1_TIME *begin = X509_get0_notBefore(certificate), *end = X509_get0_notAfter(certificate);
  if (X509_cmp_current_time(begin) > 0)
    refuse(file, "is not valid before " + time_of(begin) + "; is the clock of this machine right?");
  if (X509_cmp_current_time(end) < 0)
    refuse(file, "has expired (" + time_of(end) + "); get a new certificate");
  time_t soon = ::time(nullptr) + expires_soon_s;
  return X509_cmp_time(end, &soon) < 0 ? file.string() + " expires soon: " + time_of(end) : "";
}

/// Returns a warning, or nothing.
std::string use_certificates(SSL_CTX* context, const fs::path& file) {
  const std::string text = read_text_file(file);
  const Bio in = open_text(text);
  const Certificate own(PEM_read_bio_X509(in.get(), nullptr, no_pass_phrase, nullptr));
  if (!own) refuse(file, "holds no certificate in PEM (-----BEGIN CERTIFICATE-----)");
  std::string warning = require_valid_today(own.get(), file);
  if (SSL_CTX_use_certificate(context, own.get()) != 1)
    refuse(
        file,
        "holds a certificate that is too weak for TLS today; its key must have 2048 bits (RSA) or 256 (EC)");
  for (;;) {
    Certificate next(PEM_read_bio_X509(in.get(), nullptr, no_pass_phrase, nullptr));
    if (!next) break;
    if (SSL_CTX_add0_chain_cert(context, next.get()) != 1) refuse(file, "holds a chain that cannot be used");
    next.release();  // the context owns it now
  }
  ERR_clear_error();
  return warning;
}

void use_key(SSL_CTX* context, const TlsOptions& options) {
  std::string text = read_text_file(options.key);
  const Key key(PEM_read_bio_PrivateKey(open_text(text).get(), nullptr, no_pass_phrase, nullptr));
  OPENSSL_cleanse(text.data(), text.size());
  if (!key) refuse(options.key, "holds no private key in PEM that can be used without a pass phrase");
  if (X509_check_private_key(SSL_CTX_get0_certificate(context), key.get()) != 1)
    refuse(options.key, "is not the key of the certificate in " + options.certificate_chain.string());
  if (SSL_CTX_use_PrivateKey(context, key.get()) != 1) refuse(options.key, "holds a key that TLS cannot use");
}

}  // namespace

TlsContext::TlsContext(const TlsOptions& options)
    : context_(std::make_unique<boost::asio::ssl::context>(boost::asio::ssl::context::tls_server)) {
  SSL_CTX* context = context_->native_handle();
  SSL_CTX_set_min_proto_version(context, TLS1_2_VERSION);
  SSL_CTX_set_cipher_list(context, ciphers_of_tls_1_2);
  SSL_CTX_set_options(context, SSL_OP_NO_RENEGOTIATION | SSL_OP_NO_COMPRESSION |
                                   SSL_OP_CIPHER_SERVER_PREFERENCE | SSL_OP_PRIORITIZE_CHACHA);
  SSL_CTX_set_mode(context, SSL_MODE_RELEASE_BUFFERS);
  SSL_CTX_set_session_cache_mode(context, SSL_SESS_CACHE_OFF);
  warning_ = use_certificates(context, options.certificate_chain);
  use_key(context, options);
  struct stat key {};
  if (::stat(options.key.c_str(), &key) == 0 && (key.st_mode & (S_IRWXG | S_IRWXO)) != 0)
    warning_ += (warning_.empty() ? "" : "; ") +
                ("other users of this machine can read " + options.key.string()) + "; run chmod 600 " +
                options.key.string();
}

TlsContext::~TlsContext() = default;

RenewedTls::RenewedTls(TlsOptions options)
    : options_(std::move(options)), stamp_(stamp()), context_(std::make_shared<TlsContext>(options_)) {}

std::shared_ptr<TlsContext> RenewedTls::current() const {
  const std::lock_guard lock(mutex_);
  return context_;
}

/// Differs after one of the files was replaced or written.
std::string RenewedTls::stamp() const {
  std::string text;
  for (const fs::path& file : {options_.certificate_chain, options_.key}) {
    struct stat found {};
    if (::stat(file.c_str(), &found) != 0) return {};
    for (const auto number :
         {static_cast<int64_t>(found.st_ino), static_cast<int64_t>(found.st_size),
          static_cast<int64_t>(found.st_mtim.tv_sec), static_cast<int64_t>(found.st_mtim.tv_nsec)})
      text += std::to_string(number) + " ";
  }
  return text;
}

void RenewedTls::look() {
  const std::string now = stamp();
  if (now == stamp_) return;
  stamp_ = now;
  try {
    auto renewed = std::make_shared<TlsContext>(options_);
    if (!renewed->warning().empty()) log::warn(renewed->warning());
    const std::lock_guard lock(mutex_);
    context_ = std::move(renewed);
    log::info("the certificate in " + options_.certificate_chain.string() + " has been reloaded");
  } catch (const Error& failure) {
    log::warn(std::string("the old certificate goes on: ") + failure.what());
  }
}

}  // namespace ream::net

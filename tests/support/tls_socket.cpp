#include "support/tls_socket.hpp"

#include <openssl/ssl.h>

#include <stdexcept>

namespace ream::test {

struct TlsSocket::Parts {
  std::unique_ptr<SSL_CTX, void (*)(SSL_CTX*)> context{SSL_CTX_new(TLS_client_method()), SSL_CTX_free};
  std::unique_ptr<SSL, void (*)(SSL*)> tls{nullptr, SSL_free};
};

TlsSocket::TlsSocket(uint16_t port, const Settings& settings)
    : RawSocket(port), parts_(std::make_unique<Parts>()) {
  SSL_CTX* context = parts_->context.get();
  // A server that refuses the version must be able to say so: what we offer is not cut down by us.
  SSL_CTX_set_security_level(context, 0);
  SSL_CTX_set_min_proto_version(context, TLS1_VERSION);
  if (settings.max_version > 0) SSL_CTX_set_max_proto_version(context, settings.max_version);
  if (!settings.ciphers.empty()) SSL_CTX_set_cipher_list(context, settings.ciphers.c_str());
  parts_->tls.reset(SSL_new(context));
  SSL_set_fd(parts_->tls.get(), descriptor());
  if (SSL_connect(parts_->tls.get()) != 1) throw std::runtime_error("the TLS handshake failed");
}

TlsSocket::~TlsSocket() { SSL_shutdown(parts_->tls.get()); }

std::string TlsSocket::version() const { return SSL_get_version(parts_->tls.get()); }

std::string TlsSocket::cipher() const { return SSL_get_cipher_name(parts_->tls.get()); }

long TlsSocket::read_some(char* into, size_t bytes) {
  const int n = SSL_read(parts_->tls.get(), into, static_cast<int>(bytes));
  return n > 0 ? n : 0;
}

long TlsSocket::write_some(const char* from, size_t bytes) {
  return SSL_write(parts_->tls.get(), from, static_cast<int>(bytes));
}

}  // namespace ream::test

#pragma once
#include <filesystem>
#include <memory>

namespace ream::net {

/// What a server proves its name with, in PEM.
struct TlsOptions {
  std::filesystem::path certificate_chain;  ///< the server's own certificate first
  std::filesystem::path key;                ///< of that certificate, without a pass phrase
};

/// TLS 1.2 and 1.3 with forward secrecy, made once for all connections.
class TlsContext;

/// Throws Error naming the file: not_found, io when it cannot be read, invalid_input when it holds no such
/// thing, the key is not the certificate's, or the certificate is not valid today.
std::shared_ptr<TlsContext> make_tls_context(const TlsOptions& options);

}  // namespace ream::net

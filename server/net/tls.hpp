#pragma once
#include <filesystem>
#include <memory>
#include <string>

namespace boost::asio::ssl {
class context;
}

namespace ream::net {

/// What a server proves its name with, in PEM.
struct TlsOptions {
  std::filesystem::path certificate_chain;  ///< the server's own certificate first
  std::filesystem::path key;                ///< of that certificate, without a pass phrase
};

/// TLS 1.2 and 1.3 with forward secrecy, made once for all connections.
class TlsContext {
 public:
  /// Throws Error naming the file: not_found, io when it cannot be read, invalid_input when it holds no such
  /// thing, the key is not the certificate's, or the certificate is not valid today.
  explicit TlsContext(const TlsOptions& options);
  ~TlsContext();

  boost::asio::ssl::context& get() { return *context_; }
  /// What an operator should know about files that can be used; empty when there is nothing to say.
  const std::string& warning() const { return warning_; }

 private:
  std::unique_ptr<boost::asio::ssl::context> context_;
  std::string warning_;
};

}  // namespace ream::net

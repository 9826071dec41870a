#pragma once
#include <filesystem>
#include <memory>
#include <mutex>
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

/// The context of files that may be replaced while the server runs, as certificates are every few months.
/// Connections that are open keep theirs. Thread-safe.
class RenewedTls {
 public:
  /// Errors as for TlsContext.
  explicit RenewedTls(TlsOptions options);

  std::shared_ptr<TlsContext> current() const;
  /// Reads the files again when they are others than before. Those that cannot be used are said in the log,
  /// and what was good before goes on.
  void look();

 private:
  std::string stamp() const;

  const TlsOptions options_;
  mutable std::mutex mutex_;
  std::string stamp_;  ///< of the files that were read last
  std::shared_ptr<TlsContext> context_;
};

}  // namespace ream::net

#pragma once
// Inside of net only.
#include <boost/asio/ssl/context.hpp>

#include "net/tls.hpp"

namespace ream::net {

class TlsContext {
 public:
  explicit TlsContext(const TlsOptions& options);
  boost::asio::ssl::context& get() { return context_; }
  /// What an operator should know about files that can be used; empty when there is nothing to say.
  const std::string& warning() const { return warning_; }

 private:
  boost::asio::ssl::context context_;
  std::string warning_;
};

}  // namespace ream::net

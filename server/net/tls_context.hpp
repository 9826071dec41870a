#pragma once
// Inside of net only.
#include <boost/asio/ssl/context.hpp>

#include "net/tls.hpp"

namespace ream::net {

class TlsContext {
 public:
  explicit TlsContext(const TlsOptions& options);
  boost::asio::ssl::context& get() { return context_; }

 private:
  boost::asio::ssl::context context_;
};

}  // namespace ream::net

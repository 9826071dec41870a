#pragma once
#include "api/upload_store.hpp"
#include "net/router.hpp"

namespace ream::api {

/// /api/v1/uploads. The store must outlive the router.
void add_upload_routes(net::Router& router, UploadStore& uploads);

}  // namespace ream::api

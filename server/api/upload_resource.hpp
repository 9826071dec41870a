#pragma once
#include "net/router.hpp"
#include "workup/upload_store.hpp"

namespace ream::api {

/// /api/v1/uploads. The store must outlive the router.
void add_upload_routes(net::Router& router, workup::UploadStore& uploads);

}  // namespace ream::api

#pragma once
#include "jobs/low_priority_executor.hpp"
#include "net/router.hpp"
#include "workup/case_service.hpp"

namespace ream::api {

/// Making cases: POST /api/v1/cases and what is done to one: segmentation, undo, build, delete. Workshop and
/// uploads must outlive the router.
void add_case_work_routes(net::Router& router, workup::CaseService& case_service,
                          workup::UploadStore& uploads);

/// Looking at a case's CT and surface: slices, mesh, and the whole CT as a file, which is made by `executor`
/// in `temporary_folder`. Both outlive the router.
void add_case_volume_routes(net::Router& router, workup::CaseService& case_service,
                            jobs::LowPriorityExecutor& executor,
                            const std::filesystem::path& temporary_folder);

/// Landmarks, measures, plan, and the library of reamers of `data_folder`.
void add_case_plan_routes(net::Router& router, workup::CaseService& case_service,
                          const std::filesystem::path& data_folder);

}  // namespace ream::api

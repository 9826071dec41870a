#include <algorithm>
#include <nlohmann/json.hpp>

#include "api/replies.hpp"
#include "api/request_values.hpp"
#include "api/routes.hpp"
#include "api/services.hpp"
#include "api/session_work.hpp"
#include "core/clock.hpp"
#include "core/file.hpp"
#include "core/temporary_file.hpp"
#include "net/file_body.hpp"
#include "session/folder/session_labels.hpp"

namespace ream::api {
namespace fs = std::filesystem;
using nlohmann::json;
namespace {

constexpr double max_rows_at_once = 1e6;

session::SessionRecord seen_session(const Services& services, const net::Request& request) {
  return services.seen(request.caller, services.sessions.get(id_of(request)));
}

fs::path existing(const fs::path& file, const std::string& id, const std::string& what) {
  std::error_code failed;
  if (fs::is_regular_file(file, failed)) return file;
  throw Error(ErrorKind::not_found, "session '" + id + "' left no " + what + "; it was never started");
}

net::Response get_recording(const Services& services, const net::Request& request) {
  const std::string& id = id_of(request);
  const fs::path file = existing(session::recording_file(services.sessions.folder_of(id)), id, "recording");
  return net::file_response(request, {file, "application/octet-stream", id + ".ream"});
}

net::Response get_session_file(const Services& services, const net::Request& request) {
  const std::string& id = id_of(request);
  json session =
      read_json_file(existing(session::session_json(services.sessions.folder_of(id)), id, "session.json"));
  session::write_labels(seen_session(services, request).request, session);
  return net::json_response(200, session);
}

session::TracePart part_of(const net::Request& request) {
  session::TracePart part{query_number(request, "from_s", 0.0), std::nullopt,
                          static_cast<int>(query_number(request, "stride", 1.0))};
  if (request.query.contains("to_s")) part.to_s = query_number(request, "to_s", 0.0);
  return part;
}

void require_few_rows(const session::TracePart& part, double duration_s) {
  const double span_s = std::min(part.to_s.value_or(duration_s), duration_s) - part.from_s;
  if (span_s / tick_s / part.stride > max_rows_at_once)
    throw net::RequestError(
        422,
        "that would be more than a million rows; ask for a part (from_s, to_s, stride) or "
        "for an export");
}

/// Made now, sent, and gone.
template <typename Write>
net::Response made_now(const Services& services, const net::Request& request, const std::string& ending,
                       const std::string& media_type, Write&& write) {
  const TemporaryFile file(services.temporary_folder, "." + ending);
  services.executor.run([&] { write(file.path()); });
  return net::file_response(request, {file.path(), media_type, id_of(request) + "." + ending});
}

net::Response get_trace(const Services& services, const net::Request& request) {
  const session::SessionRecord record = seen_session(services, request);
  const session::ExportOrder order{record.request, part_of(request)};
  const session::ExportFormat& format = session::served_export_format("csv");
  existing(session::recording_file(services.sessions.folder_of(order.session.id)), order.session.id,
           "recording");
  require_few_rows(order.part, record.status.duration_s);
  return made_now(services, request, format.ending(), format.media_type, [&](const fs::path& out) {
    services.engine.write_export(format, order, out, no_progress);
  });
}

/// What every ended session can have in its folder: given where it is there, else made by a job.
net::Response kept_or_made(const Services& services, const net::Request& request,
                           const session::SessionRecord& record, const char* kind, const char* format_name,
                           const char* name) {
  const fs::path folder = services.sessions.folder_of(record.request.id);
  existing(session::recording_file(folder), record.request.id, "recording");
  const session::ExportFormat& format = session::served_export_format(format_name);
  std::error_code failed;
  if (fs::is_regular_file(folder / name, failed))
    return net::file_response(request,
                              {folder / name, format.media_type, record.request.id + "." + format.ending()});
  const session::ExportOrder order{record.request};
  return accepted(request.caller, work_in_folder(services.jobs, kind, request.caller, record, folder,
                                                 [&engine = services.engine, &format, order, name](
                                                     const fs::path& place, const Progress& progress) {
                                                   engine.write_export(format, order, place / name, progress);
                                                 }));
}

int export_stride_of(const net::Request& request) {
  return static_cast<int>(query_number(request, "stride", 1.0));
}

net::Response get_mesh(const Services& services, const net::Request& request) {
  const session::SessionRecord record = seen_session(services, request);
  if (!is_live(record.status.state))
    return kept_or_made(services, request, record, "mesh", "surface", "reamed.ply");
  return made_now(services, request, "ply", "application/ply", [&](const fs::path& out) {
    services.sessions.write_surface(id_of(request), out, export_stride_of(request));
  });
}

net::Response get_snapshot(const Services& services, const net::Request& request) {
  const session::SessionRecord record = seen_session(services, request);
  if (!is_live(record.status.state))
    return kept_or_made(services, request, record, "snapshot", "png", "snapshot.png");
  return made_now(services, request, "png", "image/png",
                  [&](const fs::path& out) { services.sessions.write_picture(id_of(request), out); });
}

/// Part, rubric and benchmark, where the form has such. Throws RequestError 422.
session::ExportOrder order_in(const json& body, const session::ExportFormat& format) {
  if (!format.is_table() && (body.contains("from_s") || body.contains("to_s") || body.contains("stride")))
    throw net::RequestError(422,
                            "only a table has a part from_s, to_s, stride; '" + format.name + "' is none",
                            {{"#/format", "is no table"}});
  if (!format.is_report() &&
      (body.contains("rubric") || body.contains("benchmark") || body.contains("component_load")))
    throw net::RequestError(
        422, "only a report has a rubric, a benchmark and component_load; '" + format.name + "' is none",
        {{"#/format", "is no report"}});
  session::ExportOrder order;
  order.part = {body.value("from_s", 0.0), optional_in<double>(body, "to_s"), body.value("stride", 1)};
  order.rubric = body.value("rubric", order.rubric);
  order.benchmark = text_in(body, "benchmark");
  order.component_load = body.value("component_load", false);
  return order;
}

net::Response export_session(const Services& services, const net::Request& request) {
  const json& body = body_of(request);
  const session::ExportFormat& format = session::served_export_format(body.at("format"));
  session::ExportOrder order = order_in(body, format);
  const session::SessionRecord record = seen_session(services, request);
  const std::string id = record.request.id;
  require_ended(record, "it can be exported when it has ended");
  existing(session::recording_file(services.sessions.folder_of(id)), id, "recording");
  order.session = record.request;
  services.engine.check_export(format, order);
  const jobs::JobOrder job{"export",
                           {},
                           id,
                           std::make_shared<const session::SessionRequest>(record.request),
                           counted_for(request.caller)};
  return accepted(request.caller,
                  services.jobs.submit_file(job, [&engine = services.engine, &format, order](
                                                     const fs::path& folder, const Progress& progress) {
                    const std::string name = order.session.id + "." + format.ending();
                    engine.write_export(format, order, folder / name, progress);
                    return jobs::JobService::MadeFile{name, format.media_type};
                  }));
}

}  // namespace

std::vector<Route> download_routes() {
  using access::reamers;
  const std::string one = "/api/v1/sessions/{id}";
  return {{"GET", one + "/recording", reamers, changes("session.download"), get_recording},
          {"GET", one + "/session.json", reamers, reads("session.file"), get_session_file},
          {"GET", one + "/trace", reamers, reads("session.trace"), get_trace},
          {"GET", one + "/mesh", reamers, reads("session.mesh"), get_mesh},
          {"GET", one + "/snapshot", reamers, reads("session.snapshot"), get_snapshot},
          {"POST", one + "/exports", reamers, changes("session.export"), export_session}};
}

}  // namespace ream::api

#include "api/session_download_resource.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "api/job_resource.hpp"
#include "api/request_body.hpp"
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

constexpr double longest_session_s = 4e6;
constexpr int largest_stride = 1'000'000;
constexpr double most_rows_at_once = 1e6;
constexpr size_t longest_rubric_name = 80;

/// The session as the caller may know it.
session::SessionRecord seen(const DownloadTools& tools, const net::Request& request) {
  session::SessionRecord record = tools.sessions.get(id_of(request));
  record.request = study::seen_by(request.caller, tools.studies, std::move(record.request));
  return record;
}

fs::path existing(const fs::path& file, const std::string& id, const std::string& what) {
  std::error_code failed;
  if (fs::is_regular_file(file, failed)) return file;
  throw Error(ErrorKind::not_found, "session '" + id + "' left no " + what + "; it was never started");
}

net::Response recording(const DownloadTools& tools, const net::Request& request) {
  const std::string& id = id_of(request);
  const fs::path file = existing(session::recording_file(tools.sessions.folder_of(id)), id, "recording");
  return net::file_response(request, {file, "application/octet-stream", id + ".ream"});
}

net::Response session_file(const DownloadTools& tools, const net::Request& request) {
  const std::string& id = id_of(request);
  json session =
      read_json_file(existing(session::session_json(tools.sessions.folder_of(id)), id, "session.json"));
  session::write_labels(seen(tools, request).request, session);
  return net::json_response(200, session);
}

double number_or(const net::Request& request, const std::string& name, double otherwise) {
  const auto given = request.query.find(name);
  return given == request.query.end() ? otherwise : json::parse(given->second).get<double>();
}

session::TracePart part_of(const net::Request& request) {
  session::TracePart part{number_or(request, "from_s", 0.0), std::nullopt,
                          static_cast<int>(number_or(request, "stride", 1.0))};
  if (request.query.contains("to_s")) part.to_s = number_or(request, "to_s", 0.0);
  return part;
}

void require_few_rows(const session::TracePart& part, double duration_s) {
  const double span_s = std::min(part.to_s.value_or(duration_s), duration_s) - part.from_s;
  if (span_s / tick_s / part.stride > most_rows_at_once)
    throw net::RequestError(
        422,
        "that would be more than a million rows; ask for a part (from_s, to_s, stride) or "
        "for an export");
}

/// Made now, sent, and gone.
template <typename Write>
net::Response made_now(const DownloadTools& tools, const net::Request& request, const std::string& ending,
                       const std::string& media_type, Write&& write) {
  const TemporaryFile file(tools.temporary_folder, "." + ending);
  tools.executor.run([&] { write(file.path()); });
  return net::file_response(request, {file.path(), media_type, id_of(request) + "." + ending});
}

net::Response trace(const DownloadTools& tools, const net::Request& request) {
  const session::SessionRecord record = seen(tools, request);
  const session::ExportOrder order{record.request, part_of(request)};
  const session::ExportFormat& format = session::served_export_format("csv");
  existing(session::recording_file(tools.sessions.folder_of(order.session.id)), order.session.id,
           "recording");
  require_few_rows(order.part, record.status.duration_s);
  return made_now(tools, request, format.ending(), format.media_type,
                  [&](const fs::path& out) { tools.engine.write_export(format, order, out, no_progress); });
}

/// What every ended session can have in its folder: given where it is there, else made by a job.
net::Response kept_or_made(const DownloadTools& tools, const net::Request& request,
                           const session::SessionRecord& record, const char* kind, const char* format_name,
                           const char* name) {
  const fs::path folder = tools.sessions.folder_of(record.request.id);
  existing(session::recording_file(folder), record.request.id, "recording");
  const session::ExportFormat& format = session::served_export_format(format_name);
  std::error_code failed;
  if (fs::is_regular_file(folder / name, failed))
    return net::file_response(request,
                              {folder / name, format.media_type, record.request.id + "." + format.ending()});
  const session::ExportOrder order{record.request};
  return accepted(work_in_folder(
      tools.jobs, kind, record, folder,
      [&engine = tools.engine, &format, order, name](const fs::path& place, const Progress& progress) {
        engine.write_export(format, order, place / name, progress);
      }));
}

int export_stride_of(const net::Request& request) {
  return static_cast<int>(number_or(request, "stride", 1.0));
}

net::Response mesh(const DownloadTools& tools, const net::Request& request) {
  const session::SessionRecord record = seen(tools, request);
  if (!is_live(record.status.state))
    return kept_or_made(tools, request, record, "mesh", "surface", "reamed.ply");
  return made_now(tools, request, "ply", "application/ply", [&](const fs::path& out) {
    tools.sessions.write_surface(id_of(request), out, export_stride_of(request));
  });
}

net::Response snapshot(const DownloadTools& tools, const net::Request& request) {
  const session::SessionRecord record = seen(tools, request);
  if (!is_live(record.status.state))
    return kept_or_made(tools, request, record, "snapshot", "png", "snapshot.png");
  return made_now(tools, request, "png", "image/png",
                  [&](const fs::path& out) { tools.sessions.write_picture(id_of(request), out); });
}

/// Part, rubric and benchmark, where the form has such. Throws RequestError 422.
session::ExportOrder order_in(RequestBody& body, const session::ExportFormat& format) {
  session::ExportOrder order;
  const auto from_s = body.number_within_or_none("from_s", 0.0, longest_session_s);
  order.part.to_s = body.number_within_or_none("to_s", 0.0, longest_session_s);
  const auto stride = body.number_within_or_none("stride", 1.0, largest_stride);
  const auto rubric = body.words_or_none("rubric", longest_rubric_name);
  const auto benchmark = body.value_or_none("benchmark") ? body.name("benchmark") : std::string();
  body.finish();
  if (!format.is_table() && (from_s || order.part.to_s || stride))
    throw net::RequestError(422,
                            "only a table has a part from_s, to_s, stride; '" + format.name + "' is none",
                            {{"#/format", "is no table"}});
  if (!format.is_report() && (rubric || !benchmark.empty()))
    throw net::RequestError(422, "only a report has a rubric and a benchmark; '" + format.name + "' is none",
                            {{"#/format", "is no report"}});
  order.part.from_s = from_s.value_or(0.0);
  order.part.stride = static_cast<int>(stride.value_or(1.0));
  order.rubric = rubric.value_or(order.rubric);
  order.benchmark = benchmark;
  return order;
}

net::Response export_session(const DownloadTools& tools, const net::Request& request) {
  RequestBody body(request);
  const session::ExportFormat& format = session::served_export_format(body.name("format"));
  session::ExportOrder order = order_in(body, format);
  const session::SessionRecord record = seen(tools, request);
  const std::string id = record.request.id;
  if (is_live(record.status.state))
    throw Error(ErrorKind::conflict, "session '" + id + "' is " + to_text(record.status.state) +
                                         "; it can be exported when it has ended");
  existing(session::recording_file(tools.sessions.folder_of(id)), id, "recording");
  order.session = record.request;
  tools.engine.check_export(format, order);
  const jobs::JobOrder job{"export", {}, id, std::make_shared<const session::SessionRequest>(record.request)};
  return accepted(tools.jobs.submit_file(
      job, [&engine = tools.engine, &format, order](const fs::path& folder, const Progress& progress) {
        const std::string name = order.session.id + "." + format.ending();
        engine.write_export(format, order, folder / name, progress);
        return jobs::JobService::MadeFile{name, format.media_type};
      }));
}

}  // namespace

void add_download_routes(net::Router& router, const DownloadTools& tools) {
  const std::string one = "/api/v1/sessions/{id}";
  const auto get = [&](const std::string& what, auto answer) {
    router.on("GET", one + what,
              [tools, answer](const net::Request& request) { return answer(tools, request); });
  };
  get("/recording", recording);
  get("/session.json", session_file);
  get("/trace", trace);
  get("/mesh", mesh);
  get("/snapshot", snapshot);
  router.on("POST", one + "/exports",
            [tools](const net::Request& request) { return export_session(tools, request); });
}

}  // namespace ream::api

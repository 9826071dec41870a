#include "session/export/export_session.hpp"
#include "core/data_folder.hpp"
#include "core/error.hpp"
#include "core/file.hpp"
#include "core/log.hpp"
#include "report/report.hpp"
#include "score/rubric_store.hpp"
#include "session/export/export_surfaces.hpp"
#include "session/export/export_trace.hpp"
#include "session/export/session_bundle.hpp"
#include "session/export/session_report.hpp"
#include "session/folder/session_folder.hpp"

namespace ream::session {
namespace {

namespace fs = std::filesystem;

void write_trace(const ExportRequest& request, const fs::path& out, const Progress& progress) {
  export_trace(recording_of(request), out, request.part, progress);
}

void write_bundle(const ExportRequest& request, const fs::path& out, const Progress& progress) {
  write_session_bundle(request.recording, request.case_name, request.data, out,
                       request.labels ? &*request.labels : nullptr, progress);
}

void write_html(const ExportRequest& request, const fs::path& out, const Progress& progress) {
  write_file_atomically(out, report::html_of(session_report(request, progress)));
}

void write_pdf(const ExportRequest& request, const fs::path& out, const Progress& progress) {
  write_file_atomically(out, report::pdf_of(session_report(request, progress)));
}

/// What a server's order asks for; everything in it goes by ids.
ExportRequest request_of(const ExportOrder& order, const fs::path& data, ExportKind kind) {
  ExportRequest request;
  request.recording = recording_file(sessions_folder(data) / order.session.id);
  request.data = data;
  request.part = order.part;
  request.labels = order.session;
  if (kind != ExportKind::report) return request;
  request.rubric = score::RubricStore(rubrics_folder(data)).find(order.rubric);
  if (!order.benchmark.empty())
    request.benchmark = score::load_benchmark(benchmarks_folder(data) / (order.benchmark + ".json"));
  return request;
}

}  // namespace

record::Recording recording_of(const ExportRequest& request) {
  record::Recording recording(request.recording, record::Recording::Trust::checked);
  if (const std::string& damage = recording.log().damage(); !damage.empty()) log::warn(damage);
  return recording;
}

const std::vector<FileFormat>& export_formats() {
  using enum ExportKind;
  static const std::vector<FileFormat> formats = {
      {"pdf", ".pdf", "report for printing", "application/pdf", report, write_pdf},
      {"html", ".html", "report as a page", "text/html; charset=utf-8", report, write_html},
      {"csv", ".csv", "one row a tick", "text/csv; charset=utf-8", table, write_trace},
      {"ply", ".ply", "reamed bone and implant, coloured by deviation", "application/ply", plain,
       write_ply_scene},
      {"glb", ".glb", "the same as glTF", "model/gltf-binary", plain, write_glb_scene},
      {"stl", ".stl", "reamed bone", "model/stl", plain, write_stl_bone},
      {"implant", ".stl", "implant as it would be seated", "model/stl", plain, write_stl_implant},
      {"surface", ".ply", "reamed bone alone, as a run writes it", "application/ply", plain, write_surface},
      {"png", ".png", "picture of the reamed glenoid", "image/png", plain, write_snapshot},
      {"deviations", ".json", "deviations vertex by vertex; bytes beside it", "application/json", pair,
       write_deviations},
      {"zip", ".zip", "session and case, for ream import on another machine", "application/zip", plain,
       write_bundle},
  };
  return formats;
}

const FileFormat& export_format_of(const std::string& name, const fs::path& out) {
  std::string names, endings;
  for (const FileFormat& format : export_formats()) {
    if (name.empty() ? out.extension() == format.extension : name == format.name) return format;
    names += (names.empty() ? "" : ", ") + format.name;
    endings += (endings.empty() ? "" : ", ") + format.extension + " (" + format.words + ")";
  }
  if (!name.empty()) throw Error(ErrorKind::usage, "--format " + name + " must be one of " + names);
  throw Error(ErrorKind::usage, "--out " + out.string() + " must end in one of " + endings);
}

ExportFormats served_export_formats(const fs::path& data) {
  ExportFormats served;
  for (const FileFormat& format : export_formats()) {
    if (format.kind == ExportKind::pair) continue;
    ExportFormat form;
    form.name = format.name;
    form.ending = format.extension.substr(1);
    form.media_type = format.media_type;
    form.is_table = format.kind == ExportKind::table;
    form.is_report = format.kind == ExportKind::report;
    form.write = [data, &format](const ExportOrder& order, const fs::path& out, const Progress& progress) {
      format.write(request_of(order, data, format.kind), out, progress);
    };
    form.check = [data, &format](const ExportOrder& order) { request_of(order, data, format.kind); };
    served.add(std::move(form));
  }
  return served;
}

}  // namespace ream::session

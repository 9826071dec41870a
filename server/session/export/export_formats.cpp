#include "session/export/export_formats.hpp"

#include "core/error.hpp"
#include "core/file.hpp"
#include "core/log.hpp"
#include "net/problem.hpp"
#include "report/report.hpp"
#include "session/export/export_surfaces.hpp"
#include "session/export/export_trace.hpp"
#include "session/export/session_bundle.hpp"
#include "session/export/session_report.hpp"

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

}  // namespace

record::Recording recording_of(const ExportRequest& request) {
  record::Recording recording(request.recording, record::Recording::Trust::checked);
  if (const std::string& damage = recording.log().damage(); !damage.empty()) log::warn(damage);
  return recording;
}

const std::vector<ExportFormat>& export_formats() {
  using enum ExportKind;
  static const std::vector<ExportFormat> formats = {
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

const ExportFormat& export_format_of(const std::string& name, const fs::path& out) {
  std::string names, endings;
  for (const ExportFormat& format : export_formats()) {
    if (name.empty() ? out.extension() == format.extension : name == format.name) return format;
    names += (names.empty() ? "" : ", ") + format.name;
    endings += (endings.empty() ? "" : ", ") + format.extension + " (" + format.words + ")";
  }
  if (!name.empty()) throw Error(ErrorKind::usage, "--format " + name + " must be one of " + names);
  throw Error(ErrorKind::usage, "--out " + out.string() + " must end in one of " + endings);
}

const ExportFormat& served_export_format(const std::string& name) {
  std::string names;
  for (const ExportFormat& format : export_formats()) {
    if (format.kind == ExportKind::pair) continue;
    if (format.name == name) return format;
    names += (names.empty() ? "" : ", ") + format.name;
  }
  throw net::RequestError(422, "sessions cannot be exported as '" + name + "'; there are " + names,
                          {{"#/format", "must be one of " + names}});
}

}  // namespace ream::session

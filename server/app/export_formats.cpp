#include "app/export_session.hpp"
#include "app/export_surfaces.hpp"
#include "app/session_bundle.hpp"
#include "app/session_report.hpp"
#include "core/error.hpp"
#include "core/file.hpp"
#include "core/log.hpp"
#include "report/html.hpp"
#include "report/pdf.hpp"

namespace ream::app {
namespace {

namespace fs = std::filesystem;

/// A recording that may be damaged towards its end, which is said.
record::Recording opened(const ExportRequest& request) {
  record::Recording recording(request.recording, record::Recording::Trust::checked);
  if (const std::string& damage = recording.log().damage(); !damage.empty()) log::warn(damage);
  return recording;
}

void write_trace(const ExportRequest& request, const fs::path& out, const Progress&) {
  export_trace(opened(request), out);
}

void write_bundle(const ExportRequest& request, const fs::path& out, const Progress&) {
  write_session_bundle(request.recording, request.case_name, request.data, out);
}

report::Report report_of(const ExportRequest& request, const Progress& progress) {
  return session_report(
      {request.recording, request.case_name, request.data, request.rubric, request.benchmark, true},
      progress);
}

void write_html(const ExportRequest& request, const fs::path& out, const Progress& progress) {
  write_file_atomically(out, report::html_of(report_of(request, progress)));
}

void write_pdf(const ExportRequest& request, const fs::path& out, const Progress& progress) {
  write_file_atomically(out, report::pdf_of(report_of(request, progress)));
}

}  // namespace

const std::vector<ExportFormat>& export_formats() {
  static const std::vector<ExportFormat> formats = {
      {".pdf", "report for printing", "application/pdf", write_pdf},
      {".html", "report as a page", "text/html; charset=utf-8", write_html},
      {".csv", "one row a tick", "text/csv; charset=utf-8", write_trace},
      {".ply", "reamed bone and implant, coloured by deviation", "model/ply", write_coloured_ply},
      {".glb", "the same as glTF", "model/gltf-binary", write_glb},
      {".stl", "reamed bone; the implant beside it", "model/stl", write_stl},
      {".json", "deviations vertex by vertex; bytes beside it", "application/json", write_deviations},
      {".zip", "session and case, for ream import on another machine", "application/zip", write_bundle},
  };
  return formats;
}

const ExportFormat& export_format_of(const fs::path& out) {
  std::string endings;
  for (const ExportFormat& format : export_formats()) {
    if (out.extension() == format.extension) return format;
    endings += (endings.empty() ? "" : ", ") + format.extension + " (" + format.words + ")";
  }
  throw Error(ErrorKind::usage, "--out " + out.string() + " must end in one of " + endings);
}

}  // namespace ream::app

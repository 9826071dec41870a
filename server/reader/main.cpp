#include <filesystem>
#include <nlohmann/json.hpp>

#include "ct/read/ct_file_names.hpp"
#include "ct/read/volume_answer.hpp"
#include "isolation/isolated_service.hpp"
#include "reader/ct_files.hpp"
#include "reader/ct_source.hpp"
#include "reader/gray_values.hpp"
#include "reader/mesh_file.hpp"
#include "reader/session_archive.hpp"
#include "reader/vibration_file.hpp"
#include "reader/volume_header.hpp"

namespace ream::reader {
namespace fs = std::filesystem;
using nlohmann::json;
namespace {

constexpr double unpacking_share = 0.2;
const char *const values_file = "values", *const given_file = "given";

/// What was read, its values in a file.
json written(const HuVolume& volume) {
  ct::write_values(values_file, volume.hu.data(), volume.hu.size());
  return ct::answer_of(volume);
}

/// The work on a folder or file, or on the one that an archive holds.
template <typename Work>
json from_source(const fs::path& input, const Progress& progress, Work&& work) {
  const CtSource source(input, part_of(progress, 0.0, unpacking_share), ".");
  return source.read(
      [&](const fs::path& path) { return work(path, part_of(progress, unpacking_share, 1.0)); });
}

json ct_task(const fs::path& input, const json& options, const Progress& progress) {
  return from_source(input, progress, [&](const fs::path& path, const Progress& reading) {
    ReadOptions read;
    read.series_uid = options.at("series_uid");
    read.keep_names = options.at("keep_names");
    read.max_bytes = options.at("max_bytes");
    return written(read_ct_files(path, read, reading));
  });
}

json voxel_file_task(const fs::path& input, const json&, const Progress&) {
  return {{"name", voxel_file_named_in(input)}};
}

json labels_task(const fs::path& input, const json& options, const Progress&) {
  return written(read_volume_file(input, options.at("max_bytes")));
}

json gray_task(const fs::path& input, const json& options, const Progress& progress) {
  return from_source(input, progress, [&](const fs::path& path, const Progress& reading) {
    const bool rows = ct::kind_by_name(path) == ct::CtFileKind::rows;
    const uint64_t max_bytes = options.at("max_bytes");
    GrayValues values = rows ? write_row_values(path, given_file, values_file, max_bytes, reading)
                             : write_gray_values(path, values_file, max_bytes, reading);
    if (!values.gray.exact)
      values.place.warnings.emplace_back(
          "gray values were rounded to 65,536 steps between the least and the greatest");
    json answer{
        {"volume", ct::answer_of(values.place)},
        {"gray", {{"offset", values.gray.offset}, {"step", values.gray.step}, {"exact", values.gray.exact}}}};
    if (rows) answer["given"] = true;
    return answer;
  });
}

json mesh_task(const fs::path& input, const json&, const Progress&) {
  const TriangleMesh mesh = read_mesh_file(input);
  isolation::write_values("vertices", std::as_bytes(std::span(mesh.vertices_mm)));
  isolation::write_values("triangles", std::as_bytes(std::span(mesh.triangles)));
  return json::object();
}

json vibration_task(const fs::path& input, const json& options, const Progress&) {
  const VibrationRecording recording = read_vibration_file(input, options.at("rate_hz"));
  isolation::write_values("samples", std::as_bytes(std::span(recording.samples)));
  return {{"rate_hz", recording.rate_hz}};
}

json session_task(const fs::path& input, const json& options, const Progress& progress) {
  if (options.at("only_ask")) return {{"holds_session", holds_session(input)}};
  const char* const folder = "session_bundle";
  fs::create_directory(folder);
  const SessionArchive archive = unpack_session(input, folder, progress);
  json answer{{"case_id", archive.case_id}, {"recorded_case", archive.recorded_case}};
  if (archive.enclosed_case) answer["enclosed_case"] = *archive.enclosed_case;
  return answer;
}

}  // namespace
}  // namespace ream::reader

int main() {
  using namespace ream;
  isolation::serve_one_job({{"ct", reader::ct_task},
                            {"labels", reader::labels_task},
                            {"gray", reader::gray_task},
                            {"mesh", reader::mesh_task},
                            {"session", reader::session_task},
                            {"voxel_file", reader::voxel_file_task},
                            {"vibration", reader::vibration_task}});
}

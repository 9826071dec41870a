#include <algorithm>
#include <limits>
#include <nlohmann/json.hpp>

#include "core/data_folder.hpp"
#include "core/error.hpp"
#include "core/hash.hpp"
#include "core/log.hpp"
#include "record/recorded_bone.hpp"
#include "record/trace_columns.hpp"
#include "score/metric_catalogue.hpp"
#include "score/rubric_score.hpp"
#include "score/rubric_store.hpp"
#include "session/export/session_tables.hpp"
#include "session/scoring/rescoring.hpp"
#include "session/simulation/recorded_session.hpp"
#include "session/simulation/recorded_setup.hpp"
#include "sim/model.hpp"
#include "tables/hdf5_file.hpp"

namespace ream::session {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using tables::Hdf5Array;
using tables::Hdf5File;

constexpr size_t rows_of_chunk = 16'384;
constexpr uint64_t bone_chunk = 32;
constexpr double no_number = std::numeric_limits<double>::quiet_NaN();

/// Names of people may hold what is no UTF-8.
std::string json_text(const json& value) {
  return value.dump(-1, ' ', false, json::error_handler_t::replace);
}

Hdf5Array array_of(const Vec3& v) { return {{v.x(), v.y(), v.z()}, {3}}; }

/// Row by row.
Hdf5Array array_of(const Mat3& m) {
  Hdf5Array array{{}, {3, 3}};
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 3; ++column) array.values.push_back(m(row, column));
  return array;
}

/// The matrix that takes points, row by row.
Hdf5Array array_of(const Pose& pose) {
  Hdf5Array array{{}, {4, 4}};
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) array.values.push_back(pose.rotation(row, column));
    array.values.push_back(pose.translation_mm[row]);
  }
  array.values.insert(array.values.end(), {0.0, 0.0, 0.0, 1.0});
  return array;
}

/// "/": notes as attributes.
void put_notes(Hdf5File& file, const tables::Notes& notes) {
  for (const auto& [name, words] : notes)
    if (name == "schema_version")
      file.set("/", name, int64_t{table_schema_version});
    else
      file.set("/", name, words);
}

json segments_json(const record::Recording& recording) {
  json list = json::array();
  for (const record::ops::Segment& op : recording.segments())
    list.push_back(
        {{"first_tick", op.first_tick}, {"reason", op.reason}, {"utc", op.utc}, {"tool", op.tool}});
  return list;
}

json events_json(const record::Recording& recording) {
  json list = json::array();
  for (const record::ops::Event& op : recording.events())
    list.push_back({{"tick", op.tick}, {"kind", op.kind}, {"words", op.words}});
  return list;
}

json annotations_json(const record::Recording& recording) {
  json list = json::array();
  for (const record::ops::Annotation& op : recording.annotations()) {
    json one = {{"tick", op.tick}, {"utc", op.utc}, {"author", op.author}, {"words", op.words}};
    if (op.has_place) one["place_mm"] = {op.x_mm, op.y_mm, op.z_mm};
    list.push_back(std::move(one));
  }
  return list;
}

/// /recording: its header and notes, lists as JSON.
void put_recording(Hdf5File& file, const record::Recording& recording, const json& session) {
  const record::ops::Header& header = recording.header();
  const std::string path = "/recording";
  file.add_group(path);
  file.set(path, "case_hash", to_hex(header.case_hash));
  file.set(path, "start_grid_hash", to_hex(header.start_grid_hash));
  file.set(path, "random_seed", header.random_seed);
  file.set(path, "force_scale", header.force_scale);
  file.set(path, "settings", header.settings);
  file.set(path, "grid", header.grid);
  file.set(path, "anatomy", header.anatomy);
  file.set(path, "session", json_text(session));
  file.set(path, "segments", json_text(segments_json(recording)));
  file.set(path, "events", json_text(events_json(recording)));
  file.set(path, "annotations", json_text(annotations_json(recording)));
  file.set(path, "end_state", recording.end() ? recording.end()->state : std::string());
}

/// /plan: where it lies, and what it says.
void put_plan(Hdf5File& file, const record::Recording& recording) {
  const case_::Plan plan = recorded_plan(recording);
  const std::string path = "/plan";
  file.add_group(path);
  file.set(path, "world_from_plan", array_of(sim::world_from_plan(plan)));
  file.set(path, "depth_mm", plan.depth_mm);
  file.set(path, "reamer", plan.reamer);
  file.set(path, "json", recording.header().plan);
}

/// A volume in rows, as files have it.
std::vector<uint8_t> in_rows(const voxel::VoxelGrid& grid, const uint8_t* bricks) {
  std::vector<uint8_t> rows(grid.voxel_count());
  for (int w = 0; w < grid.dims.z(); ++w)
    for (int v = 0; v < grid.dims.y(); ++v)
      for (int u = 0; u < grid.dims.x(); ++u) rows[grid.row_index(u, v, w)] = bricks[grid.index(u, v, w)];
  return rows;
}

void put_volume(Hdf5File& file, const std::string& name, const voxel::VoxelGrid& grid, const uint8_t* bricks,
                const std::string& meaning) {
  const std::vector<uint64_t> sizes = {static_cast<uint64_t>(grid.dims.z()),
                                       static_cast<uint64_t>(grid.dims.y()),
                                       static_cast<uint64_t>(grid.dims.x())};
  std::vector<uint64_t> chunk = sizes;
  for (uint64_t& size : chunk) size = std::min(size, bone_chunk);
  const std::string path = "/bone/" + name;
  const size_t volume = file.add(path, {tables::Hdf5Type::u8, sizes, chunk});
  file.set(path, "meaning", meaning);
  file.set(path, "axes", "z, y, x");
  file.set(path, "spacing_mm", array_of(grid.spacing_mm));
  file.set(path, "origin_mm", array_of(grid.world_from_grid.point(grid.centre_mm(Vec3i::Zero()))));
  file.set(path, "direction", array_of(grid.world_from_grid.rotation));
  const std::vector<uint8_t> rows = in_rows(grid, bricks);
  file.write(volume, std::vector<uint64_t>{0, 0, 0}, sizes, std::as_bytes(std::span(rows)));
}

/// /bone: before the first tick and after the last one. Place and frame as in images: origin_mm is the centre
/// of voxel (0, 0, 0) in the world, columns of `direction` are the x, y and z axes of the voxels.
void put_bone(Hdf5File& file, const record::Recording& recording, const ExportRequest& request,
              const Progress& progress) {
  const std::string path = "/bone";
  file.add_group(path);
  progress(0.0, "reading the case");
  case_::Case bone_case;
  try {
    bone_case = case_of(recording, request.case_name, request.data);
  } catch (const Error& e) {
    const bool asked_for = !request.case_name.empty();
    if (asked_for || e.kind() == ErrorKind::cancelled || e.kind() == ErrorKind::io) throw;
    log::warn(e.what());  // it names places of this machine
    file.set(path, "missing", "the case of this session is not there, cannot be read, or has changed");
    return;
  }
  voxel::BoneModel& bone = bone_case.bone;
  file.set(path, "world_from_grid", array_of(bone.grid.world_from_grid));
  file.set(path, "cortical_threshold_g_cc", bone.cortical_threshold_g_cc);
  put_volume(file, "density", bone.grid, bone.density.data(),
             "Before the session: 0 to 250 are hundredths of g/cc, bone from cortical_threshold_g_cc on is "
             "cortical; 255 is cartilage. It has a meaning where there is coverage_before.");
  const std::string coverage = "Share of the voxel that is there: 0 none, 255 all; the surface is at 127.5. ";
  put_volume(file, "coverage_before", bone.grid, bone.coverage.data(),
             coverage + "Before the first tick; the pilot hole is drilled.");
  progress(0.5, "reading the recording");
  record::RecordedBone recorded(recording, bone.grid, bone.coverage);
  recorded.seek(recording.tick_count(), [](const voxel::BrickImage&) {});
  std::vector<uint8_t> left = bone.coverage;
  recorded.write_to(left);
  put_volume(file, "coverage", bone.grid, left.data(), coverage + "After the last tick.");
}

/// /metrics: a number for each, not a number where it is missing; and all of metrics.json.
void put_metrics(Hdf5File& file, const json& metrics) {
  file.add_group("/metrics");
  file.set("/metrics", "json", json_text(metrics));
  const json missing = metrics.value("missing", json::object());
  for (const score::Metric& metric : score::metric_catalogue()) {
    const auto found = metrics.find(metric.key);
    if (found == metrics.end()) continue;
    const std::string path = "/metrics/" + std::string(metric.key);
    file.add_number(path, found->is_number() ? found->get<double>() : no_number);
    file.set(path, "unit", std::string(metric.unit));
    file.set(path, "meaning", std::string(metric.definition));
    if (!found->is_number())
      file.set(path, "missing", missing.value(metric.key, std::string("not measured")));
  }
}

/// /score: by the standard rubric.
void put_score(Hdf5File& file, const json& metrics, const fs::path& data) {
  const score::Rubric rubric = score::RubricStore(rubrics_folder(data)).get("standard");
  const score::Score score = score::apply_rubric(rubric, metrics);
  file.add_group("/score");
  file.set("/score", "points", score.points.value_or(no_number));
  file.set("/score", "outcome", std::string(score.outcome ? score::to_text(*score.outcome) : ""));
  file.set("/score", "json", json_text(score::score_json(rubric, score)));
}

tables::Hdf5Type type_of(tables::ColumnType type) {
  switch (type) {
    case tables::ColumnType::number: return tables::Hdf5Type::f64;
    case tables::ColumnType::count: return tables::Hdf5Type::i64;
    case tables::ColumnType::flag: break;
  }
  return tables::Hdf5Type::u8;
}

/// /ticks: a data set for each column of trace.csv.
void put_ticks(Hdf5File& file, const record::Recording& recording, const Progress& progress) {
  const uint64_t rows = recording.tick_count();
  const uint64_t chunk = std::clamp<uint64_t>(rows, 1, rows_of_chunk);
  file.add_group("/ticks");
  std::vector<size_t> columns;
  for (const record::TraceColumn& column : record::trace_columns()) {
    const std::string path = "/ticks/" + std::string(column.name);
    columns.push_back(file.add(path, {type_of(column.type), {rows}, {chunk}}));
    file.set(path, "unit", std::string(column.unit));
    file.set(path, "meaning", std::string(column.meaning));
  }
  uint64_t at = 0;
  for_each_batch(recording, {}, rows_of_chunk, progress, [&](const tables::ColumnBatch& batch) {
    const uint64_t size = batch.rows();
    for (size_t i = 0; i < columns.size(); ++i) file.write(columns[i], {&at, 1}, {&size, 1}, batch.values(i));
    at += size;
  });
}

}  // namespace

void write_hdf5(const ExportRequest& request, const fs::path& out, const Progress& progress) {
  const record::Recording recording = recording_of(request);
  const json session = labelled_session(request, recording);
  Hdf5File file(out);
  put_notes(file, session_notes(session, recording));
  put_recording(file, recording, session);
  put_plan(file, recording);
  put_bone(file, recording, request, part_of(progress, 0.0, 0.2));
  const json metrics =
      Rescorer(request.data, request.case_name).metrics(recording, part_of(progress, 0.2, 0.6));
  put_metrics(file, metrics);
  put_score(file, metrics, request.data);
  put_ticks(file, recording, part_of(progress, 0.6, 1.0));
  file.commit();
}

}  // namespace ream::session

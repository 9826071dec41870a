#include "session/export/session_tables.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "core/clock.hpp"
#include "core/hash.hpp"
#include "core/text.hpp"
#include "core/version.hpp"
#include "record/trace_columns.hpp"
#include "record/trace_csv.hpp"
#include "session/export/session_report.hpp"
#include "session/folder/session_labels.hpp"
#include "session/simulation/recorded_setup.hpp"
#include "sim/model.hpp"

namespace ream::session {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr uint32_t ticks_between_looks = 10'000;
constexpr size_t rows_of_group = 32'768;  // 10 MB in memory

uint32_t tick_at(double time_s) {
  return static_cast<uint32_t>(std::clamp(std::ceil(time_s / tick_s - 0.5), 0.0, 4.0e9));
}

/// Tells every tick up to the end of the part, and whether it has a row: every `stride`th one from the first
/// one in it.
void for_each_report(const record::Recording& recording, const TracePart& part, const Progress& progress,
                     const std::function<void(const record::TickReport&, bool has_row)>& visit) {
  const voxel::VoxelGrid grid = recording.grid();
  const uint32_t first = tick_at(part.from_s);
  const uint32_t end = std::min(part.to_s ? tick_at(*part.to_s) : UINT32_MAX, recording.tick_count());
  recording.for_each_tick(0, end, [&](const record::ops::Tick& tick) {
    if (tick.tick % ticks_between_looks == 0)
      progress(static_cast<double>(tick.tick) / std::max(end, 1u), "writing rows");
    const bool has_row = tick.tick >= first && (tick.tick - first) % static_cast<uint32_t>(part.stride) == 0;
    visit(record::report_of(tick, grid.world_from_grid), has_row);
  });
}

Pose plan_from_world(const record::Recording& recording) {
  return sim::world_from_plan(recorded_plan(recording)).inverse();
}

/// Takes a row's values into a batch.
class BatchRow {
 public:
  explicit BatchRow(tables::ColumnBatch& batch) : batch_(batch) {}
  BatchRow& add(double value) {
    batch_.add(value);
    return *this;
  }
  BatchRow& add(int64_t value) {
    batch_.add(value);
    return *this;
  }
  BatchRow& add(const Vec3& v) { return add(v.x()).add(v.y()).add(v.z()); }
  BatchRow& add(const Pose& pose) {
    add(pose.translation_mm);
    for (const double q : quaternion_from_rotation(pose.rotation)) add(q);
    return *this;
  }

 private:
  tables::ColumnBatch& batch_;
};

std::string codebook_json() {
  json book = json::array();
  for (const record::TraceColumn& column : record::trace_columns())
    book.push_back({{"name", column.name}, {"unit", column.unit}, {"meaning", column.meaning}});
  return book.dump();
}

/// "ream version 0.1.0", as Parquet wants it.
std::string parquet_program() {
  std::string words = version_text();
  return words.insert(words.find(' '), " version");
}

}  // namespace

json labelled_session(const ExportRequest& request, const record::Recording& recording) {
  json session = description_of(recording);
  if (request.labels) write_labels(*request.labels, session);
  return session;
}

tables::Notes session_notes(const json& session, const record::Recording& recording) {
  const record::ops::Header& header = recording.header();
  const auto text = [&](const char* key) {
    const auto found = session.find(key);
    return found != session.end() && found->is_string() ? found->get<std::string>() : std::string();
  };
  tables::Notes notes{{"schema_version", std::to_string(table_schema_version)},
                      {"program", version_text()},
                      {"simulated_by", header.build},
                      {"session", text("id")},
                      {"case", header.case_id},
                      {"case_hash", to_hex(header.case_hash)}};
  if (!header.anatomy.empty()) {
    const case_::Side side = anatomy_in(recording).side;
    notes.emplace_back("side", case_::to_text(side));
    notes.emplace_back("world", case_::frame_in_words(side));
  }
  std::erase_if(notes, [](const auto& note) { return note.second.empty(); });
  return notes;
}

void for_each_batch(const record::Recording& recording, const TracePart& part, size_t max_rows,
                    const Progress& progress, const std::function<void(const tables::ColumnBatch&)>& visit) {
  tables::ColumnBatch batch(record::trace_columns(), max_rows);
  BatchRow row(batch);
  record::TraceValues values(recording.grid().voxel_volume_mm3(), plan_from_world(recording));
  for_each_report(recording, part, progress, [&](const record::TickReport& report, bool has_row) {
    if (!has_row) return values.pass(report);
    values.add(report, row);
    if (!batch.full()) return;
    visit(batch);
    batch.clear();
  });
  if (batch.rows() > 0) visit(batch);
}

/// The same bytes as the trace.csv of a run; of a part its rows as they stand in the whole.
void write_trace(const ExportRequest& request, const fs::path& out, const Progress& progress) {
  const record::Recording recording = recording_of(request);
  record::TraceCsv trace(out, recording.grid().voxel_volume_mm3(), plan_from_world(recording));
  for_each_report(recording, request.part, progress, [&](const record::TickReport& report, bool has_row) {
    if (has_row)
      trace.add(report);
    else
      trace.pass(report);
  });
  trace.finish();
}

void write_parquet(const ExportRequest& request, const fs::path& out, const Progress& progress) {
  const record::Recording recording = recording_of(request);
  tables::Notes notes = session_notes(labelled_session(request, recording), recording);
  notes.emplace_back("columns", codebook_json());
  const std::span<const record::TraceColumn> columns = record::trace_columns();
  tables::ParquetFile file(out, {columns.begin(), columns.end()}, std::move(notes), parquet_program());
  for_each_batch(recording, request.part, rows_of_group, progress,
                 [&](const tables::ColumnBatch& rows) { file.add(rows); });
  file.finish();
}

}  // namespace ream::session

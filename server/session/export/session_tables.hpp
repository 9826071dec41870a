#pragma once
#include <functional>

#include "session/export/export_formats.hpp"
#include "tables/column_batch.hpp"
#include "tables/parquet_file.hpp"

namespace ream::session {

/// Of what Parquet and HDF5 files hold; it grows when something in them changes its name or meaning.
inline constexpr int table_schema_version = 1;

/// Forms of export_formats() with a row for each tick; as ExportFormat::write.
void write_trace(const ExportRequest& request, const std::filesystem::path& out, const Progress& progress);
void write_parquet(const ExportRequest& request, const std::filesystem::path& out, const Progress& progress);
/// The whole session: session_hdf5.cpp says what lies where. The bone is left out, with the reason, when the
/// case is not where the recording says; error as case_of() when it is not where the request says.
void write_hdf5(const ExportRequest& request, const std::filesystem::path& out, const Progress& progress);

/// session.json as whoever asks may know it.
nlohmann::json labelled_session(const ExportRequest& request, const record::Recording& recording);

/// What such files say of their session, by name; nothing of what is not known.
tables::Notes session_notes(const nlohmann::json& session, const record::Recording& recording);

/// Tells the rows of a part, with the columns of trace.csv, some at a time; the values are those of
/// trace.csv. Errors: invalid_input for a damaged recording or plan; what `visit` and `progress` throw.
void for_each_batch(const record::Recording& recording, const TracePart& part, size_t max_rows,
                    const Progress& progress, const std::function<void(const tables::ColumnBatch&)>& visit);

}  // namespace ream::session

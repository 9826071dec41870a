#pragma once
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace ream::score {

/// Deviations of one surface; a field is empty when there is nothing to compare with.
struct DeviationFields {
  std::vector<int8_t> from_plan, from_implant;
};

/// Writes `json_path` (proto/deviation.schema.json) and beside it a file of the same stem that ends in .bin:
/// one byte a vertex and field in the order of the vertices of `mesh_file`, which has `vertices` of them.
/// Error io.
void write_deviation(const std::filesystem::path& json_path, const std::string& mesh_file, size_t vertices,
                     const DeviationFields& fields);

}  // namespace ream::score

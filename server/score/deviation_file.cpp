#include "score/deviation_file.hpp"

#include <nlohmann/json.hpp>

#include "core/file.hpp"
#include "score/deviation.hpp"

namespace ream::score {

void write_deviation(const std::filesystem::path& json_path, const std::string& mesh_file, size_t vertices,
                     const DeviationFields& fields) {
  struct Field {
    const char *name, *words;
    const std::vector<int8_t>& codes;
  };
  std::vector<std::byte> bytes;
  nlohmann::json listed = nlohmann::json::array();
  for (const Field& field :
       {Field{"plan", "beyond the planned surface; negative: bone stands that the plan removes",
              fields.from_plan},
        Field{"implant", "gap to the back of the seated implant; negative: bone would stand into it",
              fields.from_implant}}) {
    if (field.codes.size() != vertices || vertices == 0) continue;
    listed.push_back({{"name", field.name}, {"offset", bytes.size()}, {"words", field.words}});
    const auto* first = reinterpret_cast<const std::byte*>(field.codes.data());
    bytes.insert(bytes.end(), first, first + vertices);
  }
  std::filesystem::path bin_path = json_path;
  bin_path.replace_extension(".bin");
  write_file_atomically(bin_path, bytes);
  const nlohmann::json description = {{"mesh", mesh_file},
                                      {"file", bin_path.filename().string()},
                                      {"vertices", vertices},
                                      {"step_mm", deviation_step_mm},
                                      {"range_mm", deviation_range_mm},
                                      {"unknown", deviation_unknown},
                                      {"fields", listed}};
  write_file_atomically(json_path, description.dump(2) + "\n");
}

}  // namespace ream::score

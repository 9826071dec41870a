#pragma once
#include <nlohmann/json.hpp>

#include "core/file.hpp"
#include "core/hash.hpp"
#include "support/places.hpp"

namespace ream::test {

inline nlohmann::json recording_manifest() {
  return read_json_file(source_folder() + "/proto/recording.json");
}

/// Of all that decides bytes: codes, columns, the order, names, types and revisions of fields. Words about
/// them do not count.
inline std::string structure_hash(const nlohmann::json& manifest) {
  std::string text;
  for (const auto& op : manifest.at("ops")) {
    text +=
        op.at("code").dump() + op.at("name").dump() + (op.value("columns", false) ? "columns" : "") + "\n";
    for (const auto& field : op.at("fields"))
      text +=
          field.at("name").dump() + field.at("type").dump() + std::to_string(field.value("since", 1)) + "\n";
  }
  return to_hex(hash_text(text));
}

/// Revision to structure_hash() of each manifest that files have been written with.
inline nlohmann::json recorded_structures() {
  return read_json_file(source_folder() + "/proto/golden/recording_structures.json");
}

inline std::filesystem::path golden_recording(uint32_t revision) {
  return std::filesystem::path(source_folder() + "/proto/golden") /
         ("recording-" + std::to_string(revision) + ".ream");
}

}  // namespace ream::test

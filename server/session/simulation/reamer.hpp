#pragma once
#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "shell/tool.hpp"

namespace ream::session {

/// A reamer as it was asked for, with all that is needed to make it again elsewhere.
struct Reamer {
  std::string words;                      ///< as make_tool takes them, or the name of a mesh file
  std::optional<shell::ToolAxis> axis;    ///< of a mesh; empty: estimated
  std::vector<std::byte> mesh_file = {};  ///< its bytes; empty for words
};

/// Reads the mesh file, where `words` name one; without an axis, the one noted beside it is taken. Errors:
/// not_found, io; invalid_input for a note that cannot be used.
Reamer reamer_asked_for(const std::string& words, const std::optional<shell::ToolAxis>& axis);

/// The path of the user's mesh of that name in the data folder's reamers; anything that make_tool takes stays
/// as it is. Error usage lists the names that exist, for a single word that is nothing of all that.
std::string reamer_in_library(const std::string& reamer, const std::filesystem::path& data);

/// The tool of a name in the library, of words or of a mesh with an axis beside it. Errors: those of both
/// above.
shell::Tool tool_asked_for(const std::string& reamer, const std::filesystem::path& data);

/// The tool once more: from the words, or from the bytes of the mesh file, which must not refer to other
/// files. Errors: those of make_tool; io.
shell::Tool tool_of(const Reamer& reamer);

/// Six numbers as recordings keep an axis, "" for none, and back. Error invalid_input naming `place`.
std::string axis_to_text(const std::optional<shell::ToolAxis>& axis);
std::optional<shell::ToolAxis> axis_from_text(const std::string& text, const std::string& place);

}  // namespace ream::session

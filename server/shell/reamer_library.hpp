#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "shell/tool.hpp"

namespace ream::shell {

struct Nipple {
  double radius_mm = 3.0, height_mm = 8.0;
};

/// A reamer with a name. Lengths mm, tool frame.
struct LibraryReamer {
  std::string name;   ///< [a-z0-9-]+
  std::string words;  ///< as make_tool takes them: words, or the path of a user's mesh
  double diameter_mm = 0.0;
  double radius_mm = 0.0;  ///< of the cutting surface at its apex
  std::optional<Nipple> nipple;
  /// Runs on a guide pin. The pin fills the bore, so tool and pin together are as closed as any tool: the
  /// profile is the same and only the guide (pin) differs.
  bool cannulated = false;
  std::string description;            ///< for people, with the source of its size
  std::optional<ToolAxis> axis = {};  ///< of a mesh; empty: estimated
};

/// Those that always exist, in the order in which they are shown.
const std::vector<LibraryReamer>& built_in_reamers();

/// Those and the user's meshes of <data_folder>/reamers (NAME.stl or .ply, .obj with an optional NAME.json
/// {"axis": [x,y,z,dx,dy,dz], "cannulated": true, "description": "..."}), sorted by name. One that cannot be
/// read is left out and named in `warnings`.
std::vector<LibraryReamer> reamers_of(const std::filesystem::path& data_folder,
                                      std::vector<std::string>* warnings = nullptr);

/// The built-in reamer of that name; null when there is none. Their names and words never change: recordings
/// name them.
const LibraryReamer* find_reamer(const std::string& name);

/// Names of the built-in ones, for messages: "thesis, convex-30, ...".
std::string built_in_names();

/// The one of that name, built in or of the data folder. Errors: usage lists the names that exist; those
/// of make_tool and of the note beside a mesh.
LibraryReamer reamer_named(const std::string& name, const std::filesystem::path& data_folder);

/// What can be said of anything that make_tool takes: of a mesh with the note beside it; nameless for words
/// that are in no library. Errors: those of make_tool and of the note.
LibraryReamer described_reamer(const std::string& asked_for);

/// The axis in the note (NAME.json) beside a mesh file; empty without a note or axis. Error invalid_input.
std::optional<ToolAxis> axis_noted_for(const std::filesystem::path& mesh);

/// The built-in convex one with a nipple whose radius is nearest to that of an implant's back.
const LibraryReamer& reamer_for_implant(double implant_radius_mm);

}  // namespace ream::shell

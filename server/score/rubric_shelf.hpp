#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "score/rubric.hpp"

namespace ream::score {

/// The rubrics of a data folder: <folder>/<id>/<version>.json. Versions are never changed or taken away, so
/// that every score can be had again. The rubric `standard` is always there; its version 1 comes with the
/// program.
class RubricShelf {
 public:
  explicit RubricShelf(std::filesystem::path folder) : folder_(std::move(folder)) {}

  /// Sorted.
  std::vector<std::string> ids() const;
  /// Ascending. Error not_found.
  std::vector<int> versions(const std::string& id) const;
  /// The newest version, or that one. Error not_found.
  Rubric get(const std::string& id, std::optional<int> version = std::nullopt) const;
  /// By words: "id" or "id@version". Errors: not_found, invalid_input.
  Rubric named(const std::string& words) const;
  /// Keeps a rubric as the next version of `id`, whatever version it says; one that says the same as the
  /// newest is that one. Returns it as it is kept. Errors: invalid_input for an id other than [a-z0-9-]{1,64}
  /// and for a rubric that could not be read again, conflict when others kept one at the same moment, io.
  Rubric keep(const std::string& id, Rubric rubric) const;

 private:
  std::filesystem::path file(const std::string& id, int version) const;

  std::filesystem::path folder_;
};

/// A rubric by words: a file, or one that is named() so on the shelf. Errors: not_found, invalid_input.
Rubric find_rubric(const std::string& words, const RubricShelf& shelf);

}  // namespace ream::score

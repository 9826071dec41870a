#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "score/rubric.hpp"

namespace ream::score {

/// The rubrics of a data folder: <folder>/<id>/<version>.json. Versions are never changed or taken away, so
/// that every score can be had again. The rubric `standard` is always there, with every version that the
/// program ever came with; a file of the same number stands before it.
class RubricStore {
 public:
  explicit RubricStore(std::filesystem::path folder) : folder_(std::move(folder)) {}

  /// Sorted.
  std::vector<std::string> ids() const;
  /// Ascending. Error not_found.
  std::vector<int> versions(const std::string& id) const;
  /// The newest version, or that one. Error not_found.
  Rubric get(const std::string& id, std::optional<int> version = std::nullopt) const;
  /// By a reference, "id" or "id@version". Errors: not_found, invalid_input.
  Rubric find(const std::string& reference) const;
  /// Saves a rubric as the next version of `id`, whatever version it has; one that equals the newest is that
  /// one. Returns it as it is stored. Errors: invalid_input for an id other than [a-z0-9-]{1,64}
  /// and for a rubric that could not be read again, conflict when others saved one at the same moment, io.
  Rubric save(const std::string& id, Rubric rubric) const;

 private:
  std::filesystem::path file(const std::string& id, int version) const;

  std::filesystem::path folder_;
};

/// A rubric by the path of a file, or by a reference into the store. Errors: not_found, invalid_input.
Rubric find_rubric(const std::string& reference, const RubricStore& store);

}  // namespace ream::score

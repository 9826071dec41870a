#pragma once
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace ream::test {

/// A YAML file as JSON (YAML 1.2 core types; quoted scalars are text).
nlohmann::json read_yaml(const std::filesystem::path& file);

/// Checks values against JSON schemas inside one document. Knows the keywords that the files in proto/ use
/// and throws std::logic_error on any other, so that nothing is passed over unseen.
class SchemaChecker {
 public:
  explicit SchemaChecker(const nlohmann::json& document) : document_(document) {}

  /// One line per fault, "#/loop/missed: must be integer"; empty when the value fits.
  std::vector<std::string> faults(const nlohmann::json& schema, const nlohmann::json& value) const;

  /// The schema itself, or what its $ref names in the document.
  const nlohmann::json& resolve(const nlohmann::json& schema) const;

 private:
  void check(const nlohmann::json& schema, const nlohmann::json& value, const std::string& at,
             std::vector<std::string>& faults) const;
  void check_object(const nlohmann::json& schema, const nlohmann::json& value, const std::string& at,
                    std::vector<std::string>& faults) const;
  void check_array(const nlohmann::json& schema, const nlohmann::json& value, const std::string& at,
                   std::vector<std::string>& faults) const;
  void check_one_of(const nlohmann::json& schema, const nlohmann::json& value, const std::string& at,
                    std::vector<std::string>& faults) const;
  void check_condition(const nlohmann::json& schema, const nlohmann::json& value, const std::string& at,
                       std::vector<std::string>& faults) const;

  const nlohmann::json& document_;
};

}  // namespace ream::test

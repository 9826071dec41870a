// make_ops MANIFEST OUT: writes ops.hpp, the structures of a recording's ops, from proto/recording.json.
#include <cstdio>
#include <fstream>
#include <iostream>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>
#include <stdexcept>
#include <string>

namespace {

using nlohmann::json;

struct FieldType {
  const char* cpp;
  const char* initial;   ///< what stands behind the field's name
  bool has_fixed_words;  ///< may be a column
};

const FieldType& type_of(const json& field) {
  static const std::map<std::string, FieldType> types{
      {"u8", {"uint8_t", " = 0", false}},     {"u32", {"uint32_t", " = 0", true}},
      {"u64", {"uint64_t", " = 0", true}},    {"i32", {"int32_t", " = 0", true}},
      {"f32", {"float", " = 0.0f", true}},    {"f64", {"double", " = 0.0", true}},
      {"text", {"std::string", "", false}},   {"bytes", {"Bytes", "", false}},
      {"pose_q", {"QuantisedPose", "", true}}};
  const auto found = types.find(field.at("type").get<std::string>());
  if (found == types.end())
    throw std::runtime_error("field " + field.at("name").dump() + " has the unknown type " +
                             field.at("type").dump());
  return found->second;
}

/// bricks_key -> BricksKey.
std::string camel_case(const std::string& name) {
  std::string out;
  bool upper = true;
  for (const char c : name) {
    if (c == '_')
      upper = true;
    else
      out += upper ? static_cast<char>(std::toupper(static_cast<unsigned char>(c))) : c;
    if (c != '_') upper = false;
  }
  return out;
}

void check(const json& manifest) {
  std::set<int> codes;
  std::set<std::string> names;
  const int revision = manifest.at("revision").get<int>();
  for (const json& op : manifest.at("ops")) {
    const std::string name = op.at("name");
    const int code = op.at("code").get<int>();
    if (code < 1 || code > 255 || !codes.insert(code).second)
      throw std::runtime_error("op " + name + " needs a code of its own in 1..255");
    if (!names.insert(name).second) throw std::runtime_error("two ops are called " + name);
    std::set<std::string> fields{"code", "name", "columns", "field_names", "visit_fields"};  // taken
    for (const json& field : op.at("fields")) {
      const std::string what = name + "." + field.at("name").get<std::string>();
      if (!fields.insert(field.at("name")).second) throw std::runtime_error(what + " is taken already");
      if (op.value("columns", false) && !type_of(field).has_fixed_words)
        throw std::runtime_error(what + " cannot be a column: its type has no fixed number of 32-bit words");
      const int since = field.value("since", 1);
      if (since < 1 || since > revision)
        throw std::runtime_error(what + " is of revision " + std::to_string(since) + ", the manifest of " +
                                 std::to_string(revision));
    }
  }
}

void write_op(std::ostream& out, const json& op) {
  if (op.contains("about")) out << "/// " << op.at("about").get<std::string>() << "\n";
  out << "struct " << camel_case(op.at("name")) << " {\n";
  out << "  static constexpr uint8_t code = " << op.at("code") << ";\n";
  out << "  static constexpr std::string_view name = " << op.at("name") << ";\n";
  out << "  static constexpr bool columns = " << (op.value("columns", false) ? "true" : "false") << ";\n\n";
  for (const json& field : op.at("fields")) {
    const FieldType& type = type_of(field);
    out << "  " << type.cpp << " " << field.at("name").get<std::string>() << type.initial << ";";
    if (field.contains("about")) out << "  ///< " << field.at("about").get<std::string>();
    out << "\n";
  }
  const std::string name = camel_case(op.at("name"));
  out << "\n  bool operator==(const " << name << "&) const = default;\n\n"
      << "  /// Calls visit(field, revision since which files have it) for every field, in the file's "
         "order.\n"
      << "  template <typename Self, typename Visit>\n"
      << "  static constexpr void visit_fields(Self& self, Visit&& visit) {\n";
  for (const json& field : op.at("fields"))
    out << "    visit(self." << field.at("name").get<std::string>() << ", uint32_t{"
        << field.value("since", 1) << "});\n";
  out << "  }\n\n  /// In the same order.\n  static constexpr std::array<std::string_view, "
      << op.at("fields").size() << "> field_names{";
  for (const json& field : op.at("fields"))
    out << (field == op.at("fields").front() ? "" : ", ") << field.at("name");
  out << "};\n};\n\n";
}

std::string header_text(const json& manifest) {
  std::ostringstream out;
  out << "// Made from proto/recording.json; change that.\n#pragma once\n#include <array>\n#include "
         "<cstdint>\n#include <string>\n"
      << "#include <string_view>\n\n#include \"record/op_fields.hpp\"\n\nnamespace ream::record::ops {\n\n"
      << "/// Of the format as this build writes it.\ninline constexpr uint32_t newest_revision = "
      << manifest.at("revision") << ";\n\n";
  for (const json& op : manifest.at("ops")) write_op(out, op);
  out << "/// Calls action.operator()<Op>() for the op with that code; false when there is none.\n"
      << "template <typename Action>\nbool with_op(uint8_t code, Action&& action) {\n  switch (code) {\n";
  for (const json& op : manifest.at("ops")) {
    const std::string name = camel_case(op.at("name"));
    out << "    case " << name << "::code:\n      action.template operator()<" << name << ">();\n"
        << "      return true;\n";
  }
  out << "    default:\n      return false;\n  }\n}\n\n}  // namespace ream::record::ops\n\n"
      << "#include \"record/op_codec.hpp\"\n";
  return out.str();
}

}  // namespace

int main(int count, char** arguments) {
  if (count != 3) {
    std::cerr << "usage: make_ops MANIFEST OUT\n";
    return 2;
  }
  try {
    std::ifstream in(arguments[1]);
    const json manifest = json::parse(in);
    check(manifest);
    std::ofstream out(arguments[2]);
    out << header_text(manifest) << std::flush;
    if (!out) throw std::runtime_error(std::string("cannot write ") + arguments[2]);
  } catch (const std::exception& error) {
    std::remove(arguments[2]);
    std::cerr << arguments[1] << ": " << error.what() << "\n";
    return 1;
  }
  return 0;
}

#include "api/yaml_json.hpp"

#include <yaml-cpp/yaml.h>

#include "core/error.hpp"
#include "core/json.hpp"

namespace ream::api {
using nlohmann::json;
namespace {

json scalar(const YAML::Node& node) {
  const std::string& text = node.Scalar();
  if (node.Tag() == "!") return text;  // quoted
  if (text == "null" || text == "~" || text.empty()) return nullptr;
  if (text == "true" || text == "false") return text == "true";
  if (text.find_first_not_of("0123456789+-.eE") != std::string::npos) return text;
  json number = parse_json_or_discard(text);
  return number.is_discarded() ? json(text) : number;
}

json convert(const YAML::Node& node) {
  if (node.IsSequence()) {
    json list = json::array();
    for (const YAML::Node& item : node) list.push_back(convert(item));
    return list;
  }
  if (node.IsMap()) {
    json object = json::object();
    for (const auto& pair : node)
      if (const auto key = pair.first.as<std::string>(); !object.emplace(key, convert(pair.second)).second)
        throw Error(ErrorKind::invalid_input, "the YAML has the key '" + key + "' twice in one place");
    return object;
  }
  return node.IsNull() ? json(nullptr) : scalar(node);
}

}  // namespace

json json_from_yaml(const std::string& text) {
  try {
    return convert(YAML::Load(text));
  } catch (const YAML::Exception& error) {
    throw Error(ErrorKind::invalid_input, std::string("the YAML cannot be read: ") + error.what());
  }
}

}  // namespace ream::api

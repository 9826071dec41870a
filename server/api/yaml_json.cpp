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
  const bool number = text.find_first_not_of("0123456789+-.eE") == std::string::npos && json::accept(text);
  return number ? json::parse(text) : json(text);
}

json convert(const YAML::Node& node) {
  if (node.IsSequence()) {
    json list = json::array();
    for (const YAML::Node& item : node) list.push_back(convert(item));
    return list;
  }
  if (node.IsMap()) {
    json object = json::object();
    for (const auto& pair : node) object[pair.first.as<std::string>()] = convert(pair.second);
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

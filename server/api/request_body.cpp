#include "api/request_body.hpp"

#include <algorithm>
#include <cmath>

namespace ream::api {
namespace {

constexpr size_t max_plain_name = 64;

std::string plain_number(double value) {
  const std::string text = nlohmann::json(value).dump();
  return text.size() > 2 && text.ends_with(".0") ? text.substr(0, text.size() - 2) : text;
}

}  // namespace

nlohmann::json json_object_in(const net::Request& request) {
  const std::string_view type = request.header("content-type");
  if (type.substr(0, type.find(';')) != "application/json")
    throw net::RequestError(415, "the request body must be sent as application/json");
  try {
    return nlohmann::json::parse(request.body);
  } catch (const nlohmann::json::parse_error& error) {
    throw net::RequestError(400,
                            "the request body is not JSON: it fails at byte " + std::to_string(error.byte));
  } catch (const nlohmann::json::out_of_range&) {
    throw net::RequestError(400, "the request body holds a number too large for any use");
  }
}

RequestBody::RequestBody(const net::Request& request) : value_(json_object_in(request)) {
  if (!value_.is_object())
    throw net::RequestError(422, "the request body must be a JSON object", {{"#", "must be an object"}});
}

const nlohmann::json* RequestBody::find(const std::string& key) {
  asked_.insert(key);
  const auto found = value_.find(key);
  return found == value_.end() ? nullptr : &*found;
}

void RequestBody::complain(const std::string& key, const std::string& what) {
  errors_.push_back({pointer_to(key), "'" + key + "' " + what});
}

std::string RequestBody::name(const std::string& key) {
  return text_that(
      key, is_name,
      "may hold only a-z, 0-9 and -, and at most " + std::to_string(max_plain_name) + " of them");
}

std::string RequestBody::name_or(const std::string& key, const std::string& otherwise) {
  return find(key) ? name(key) : otherwise;
}

std::optional<std::string> RequestBody::name_or_none(const std::string& key) {
  const nlohmann::json* value = find(key);
  if (!value) return std::nullopt;
  return *value == "" ? std::string() : name(key);
}

std::string RequestBody::text_that(const std::string& key,
                                   const std::function<bool(const std::string&)>& fits,
                                   const std::string& rule) {
  const nlohmann::json* value = find(key);
  if (!value) {
    complain(key, "is missing");
  } else if (!value->is_string()) {
    complain(key, std::string("must be a text, not ") + value->type_name());
  } else if (const auto text = value->get<std::string>(); !fits(text)) {
    complain(key, rule);
  } else {
    return text;
  }
  return {};
}

std::optional<double> RequestBody::number_or_none(const std::string& key, double above, double most) {
  return number_that(
      key, [&](double number) { return number > above && number <= most; },
      "must be above " + plain_number(above) + " and at most " + plain_number(most));
}

std::string RequestBody::words(const std::string& key, size_t least, size_t most) {
  if (least == 0 && !find(key)) return {};
  return text_that(
      key, [&](const std::string& text) { return characters(text) >= least && characters(text) <= most; },
      "must be " + std::to_string(least) + " to " + std::to_string(most) + " characters long");
}

std::optional<std::string> RequestBody::words_or_none(const std::string& key, size_t most) {
  if (!find(key)) return std::nullopt;
  return words(key, 0, most);
}

std::optional<Vec3> RequestBody::point_or_none(const std::string& key, double most) {
  const nlohmann::json* value = find(key);
  if (!value || value->is_null()) return std::nullopt;
  const auto fits = [most](const nlohmann::json& number) {
    return number.is_number() && std::abs(number.get<double>()) <= most;
  };
  if (value->is_array() && value->size() == 3 && std::all_of(value->begin(), value->end(), fits))
    return Vec3((*value)[0].get<double>(), (*value)[1].get<double>(), (*value)[2].get<double>());
  complain(key, "must be three numbers, each at most " + plain_number(most) + " either way");
  return std::nullopt;
}

std::optional<double> RequestBody::number_within_or_none(const std::string& key, double least, double most) {
  return number_that(
      key, [&](double number) { return number >= least && number <= most; },
      "must be from " + plain_number(least) + " to " + plain_number(most));
}

std::optional<double> RequestBody::number_that(const std::string& key,
                                               const std::function<bool(double)>& fits,
                                               const std::string& rule) {
  const nlohmann::json* value = find(key);
  if (!value) return std::nullopt;
  if (!value->is_number()) {
    complain(key, std::string("must be a number, not ") + value->type_name());
    return std::nullopt;
  }
  const double number = value->get<double>();
  if (std::isfinite(number) && fits(number)) return number;
  complain(key, rule);
  return std::nullopt;
}

std::vector<std::string> RequestBody::names(const std::string& key, size_t least, size_t most) {
  const nlohmann::json* value = find(key);
  std::set<std::string> different;
  std::vector<std::string> list;
  for (const nlohmann::json& entry : value && value->is_array() ? *value : nlohmann::json::array())
    if (entry.is_string() && is_name(entry.get<std::string>()) && different.insert(entry).second)
      list.push_back(entry);
  if (!value)
    complain(key, "is missing");
  else if (!value->is_array() || list.size() != value->size() || list.size() < least || list.size() > most)
    complain(key, "must be a list of " + std::to_string(least) + " to " + std::to_string(most) +
                      " different names of a-z, 0-9 and -");
  else
    return list;
  return {};
}

std::string RequestBody::one_of(const std::string& key, const std::vector<std::string>& words) {
  std::string list;
  for (const std::string& word : words) list += (list.empty() ? "" : ", ") + word;
  return text_that(
      key, [&](const std::string& text) { return std::count(words.begin(), words.end(), text) > 0; },
      "must be one of " + list);
}

int64_t RequestBody::count(const std::string& key, int64_t most) {
  const nlohmann::json* value = find(key);
  if (!value) return 0;
  if (value->is_number_unsigned() && value->get<uint64_t>() <= static_cast<uint64_t>(most))
    return value->get<int64_t>();
  complain(key, "must be a whole number from 0 to " + std::to_string(most));
  return 0;
}

std::optional<nlohmann::json> RequestBody::value_or_none(const std::string& key) {
  const nlohmann::json* value = find(key);
  return value ? std::optional(*value) : std::nullopt;
}

std::optional<bool> RequestBody::flag_or_none(const std::string& key) {
  const nlohmann::json* value = find(key);
  if (!value) return std::nullopt;
  if (value->is_boolean()) return value->get<bool>();
  complain(key, std::string("must be true or false, not ") + value->type_name());
  return std::nullopt;
}

void RequestBody::finish() {
  for (const auto& [key, value] : value_.items())
    if (!asked_.contains(key)) complain(key, "is not a known key");
  if (errors_.empty()) return;
  std::string detail = "the request body cannot be used: ";
  for (size_t i = 0; i < errors_.size(); ++i) detail += (i > 0 ? "; " : "") + errors_[i].detail;
  throw net::RequestError(422, detail, errors_);
}

}  // namespace ream::api

#pragma once
#include <functional>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "core/text.hpp"
#include "geometry/vec.hpp"
#include "net/message.hpp"
#include "net/problem.hpp"

namespace ream::api {

/// Strict reading of a JSON request body: every key is asked for by name and type; finish() reports all that
/// was wrong at once, unknown keys included.
class RequestBody {
 public:
  /// Throws RequestError: 415 when it is not sent as JSON, 400 when it is not JSON, 422 when it is not an
  /// object.
  explicit RequestBody(const net::Request& request);

  /// A name of [a-z0-9-], at most 64 long. Empty when there is something wrong with it.
  std::string name(const std::string& key);
  /// The same; `otherwise` when absent.
  std::string name_or(const std::string& key, const std::string& otherwise);
  /// The same, or an empty text; none when absent.
  std::optional<std::string> name_or_none(const std::string& key);
  /// A finite number above `above` and at most `most`; none when absent.
  std::optional<double> number_or_none(const std::string& key, double above, double most);
  /// Text for people of `least` to `most` characters. Empty when absent and `least` is 0, or when there is
  /// something wrong with it.
  std::string words(const std::string& key, size_t least, size_t most);
  /// The same of any length up to `most`; none when absent.
  std::optional<std::string> words_or_none(const std::string& key, size_t most);
  /// Three finite numbers, none larger than `most` either way; none when absent or null.
  std::optional<Vec3> point_or_none(const std::string& key, double most);
  /// A finite number from `least` to `most`, both included; none when absent.
  std::optional<double> number_within_or_none(const std::string& key, double least, double most);
  /// Different names, `least` to `most` of them. Empty when there is something wrong with them.
  std::vector<std::string> names(const std::string& key, size_t least, size_t most);
  /// One of `words`. Empty when there is something wrong with it.
  std::string one_of(const std::string& key, const std::vector<std::string>& words);
  /// A whole number from 0 to `most`; 0 when absent.
  int64_t count(const std::string& key, int64_t most);
  /// Whatever is there; none when absent.
  std::optional<nlohmann::json> value_or_none(const std::string& key);
  /// True or false; none when absent.
  std::optional<bool> flag_or_none(const std::string& key);

  /// Throws RequestError 422 with one entry per fault.
  void finish();

 private:
  const nlohmann::json* find(const std::string& key);
  void complain(const std::string& key, const std::string& what);
  /// A finite number that fits, else a complaint with the rule; none when absent.
  std::optional<double> number_that(const std::string& key, const std::function<bool(double)>& fits,
                                    const std::string& rule);
  /// A text that fits, else a complaint with the rule and an empty one.
  std::string text_that(const std::string& key, const std::function<bool(const std::string&)>& fits,
                        const std::string& rule);

  nlohmann::json value_;
  std::set<std::string> asked_;
  std::vector<net::FieldError> errors_;
};

/// The JSON value of a body, for readers that files and requests share.
/// Throws RequestError: 415 when it is not sent as JSON, 400 when it is not JSON.
nlohmann::json json_object_in(const net::Request& request);

/// The part {id} of a route's path.
inline const std::string& id_of(const net::Request& request) { return request.parameters.at("id"); }

}  // namespace ream::api

#include "core/json.hpp"

#include "core/error.hpp"

template class nlohmann::basic_json<>;

namespace ream {
using nlohmann::json;
namespace {

constexpr size_t max_shown_key = 40;
constexpr int number_too_large = 406;  ///< number of nlohmann's exception

/// A key for people: of bounded length, on one line.
std::string quoted_key(const std::string& key) {
  return json(key.substr(0, max_shown_key)).dump(-1, ' ', true, json::error_handler_t::replace);
}

/// Makes a value of what the parser, which itself does not recurse, finds one after another.
class ValueBuilder final : public nlohmann::json_sax<json> {
 public:
  json value;
  std::string fault;  ///< empty while all is well

  bool null() override { return put(nullptr) != nullptr; }
  bool boolean(bool truth) override { return put(truth) != nullptr; }
  bool number_integer(number_integer_t number) override { return put(number) != nullptr; }
  bool number_unsigned(number_unsigned_t number) override { return put(number) != nullptr; }
  bool number_float(number_float_t number, const string_t&) override { return put(number) != nullptr; }
  bool string(string_t& text) override { return put(std::move(text)) != nullptr; }
  bool binary(binary_t&) override { return refuse("holds binary data"); }
  bool start_object(size_t) override { return open(json::object()); }
  bool start_array(size_t) override { return open(json::array()); }
  bool end_object() override { return close(); }
  bool end_array() override { return close(); }

  bool key(string_t& name) override {
    const auto [place, is_new] = open_.back()->emplace(name, nullptr);
    named_ = &*place;
    return is_new || refuse("has the key " + quoted_key(name) + " twice in one object");
  }

  bool parse_error(size_t, const std::string&, const json::exception& error) override {
    if (error.id == number_too_large) return refuse("holds a number too large for any use");
    const std::string what =
        error.what();  // "[json.exception.parse_error.101] parse error at line 1, column 2: ..."
    const size_t line = what.find("line "), end = what.find(':', line);
    return refuse("is not valid JSON" +
                  (line < end && end != what.npos ? ": it fails in " + what.substr(line, end - line) : ""));
  }

 private:
  bool refuse(const std::string& words) {
    fault = words;
    return false;
  }

  json* put(json made) {
    json* const place = open_.empty() ? &value : open_.back()->is_object() ? named_ : nullptr;
    if (place == nullptr) return &open_.back()->emplace_back(std::move(made));
    *place = std::move(made);
    return place;
  }

  bool open(json made) {
    if (open_.size() >= max_json_depth)
      return refuse("has lists or objects that stand more than " + std::to_string(max_json_depth) +
                    " deep in each other");
    open_.push_back(put(std::move(made)));
    return true;
  }

  bool close() {
    open_.pop_back();
    return true;
  }

  std::vector<json*> open_;  ///< outermost first; what is open does not move
  json* named_ = nullptr;    ///< where the value of the last key goes
};

}  // namespace

json parse_json(std::string_view text) {
  ValueBuilder builder;
  if (!json::sax_parse(text, &builder)) throw Error(ErrorKind::invalid_input, builder.fault);
  return std::move(builder.value);
}

json parse_json_or_discard(std::string_view text) {
  ValueBuilder builder;
  return json::sax_parse(text, &builder) ? std::move(builder.value) : json(json::value_t::discarded);
}

}  // namespace ream

#include <algorithm>
#include <array>
#include <cctype>
#include <optional>
#include <set>

#include "access/password_hasher.hpp"
#include "access/secret.hpp"
#include "core/error.hpp"
#include "core/text.hpp"

namespace ream::access {
namespace {

/// What many people take, with or without digits behind it. The words that lists of stolen passwords begin
/// with.
constexpr std::array common_words{
    "password",       "passwort",      "passw",        "passcode",      "passphrase", "changeme",
    "changeit",       "letmein",       "welcome",      "welcomeback",   "willkommen", "iloveyou",
    "iloveyousomuch", "administrator", "admin",        "administrador", "superuser",  "superman",
    "batman",         "spiderman",     "football",     "baseball",      "basketball", "liverpool",
    "manchester",     "chelsea",       "barcelona",    "sunshine",      "princess",   "monkey",
    "dragon",         "master",        "michael",      "jennifer",      "michelle",   "christian",
    "alexander",      "elizabeth",     "charlotte",    "starwars",      "computer",   "internet",
    "trustnoone",     "trustno",       "whatever",     "nothing",       "secret",     "topsecret",
    "default",        "guest",         "test",         "testing",       "testtest",   "temporary",
    "hello",          "helloworld",    "hallo",        "geheim",        "schatz",     "motdepasse",
    "contrasena",     "parola",        "qwertyuiop",   "asdfghjkl",     "hospital",   "klinik",
    "surgery",        "surgeon",       "orthopaedics", "orthopedics",   "shoulder",   "glenoid",
    "reamer",         "simulator",     "university",   "student",       "summer",     "winter",
    "spring",         "autumn",        "januar",       "january",       "september",  "november",
    "december",       "monday",        "freedom",      "blink",         "mynameis",   "opensesame",
    "abracadabra",    "fuckyou",       "jesuschrist",  "pokemon",       "minecraft",  "samsung",
};

/// Along these one types without thinking.
constexpr std::array rows{"abcdefghijklmnopqrstuvwxyz",
                          "01234567890",
                          "qwertyuiop",
                          "qwertzuiop",
                          "azertyuiop",
                          "asdfghjkl",
                          "zxcvbnm",
                          "yxcvbnm",
                          "1qaz2wsx3edc4rfv5tgb6yhn7ujm8ik9ol0p"};
constexpr size_t min_run = 3, max_beside_runs = 3, max_period = 9, min_beside_name = 6;

size_t bytes_of_character(unsigned char first) {
  if (first < 0x80) return 1;
  if (first >= 0xc2 && first < 0xe0) return 2;
  if (first >= 0xe0 && first < 0xf0) return 3;
  return first >= 0xf0 && first < 0xf5 ? 4 : 0;
}

/// None when it is not UTF-8.
std::optional<size_t> characters_of(const std::string& text, std::set<std::string>& different) {
  size_t count = 0;
  for (size_t at = 0; at < text.size(); ++count) {
    const size_t bytes = bytes_of_character(static_cast<unsigned char>(text[at]));
    if (bytes == 0 || at + bytes > text.size()) return std::nullopt;
    const std::string character = text.substr(at, bytes);
    if (!std::all_of(character.begin() + 1, character.end(),
                     [](unsigned char byte) { return (byte & 0xc0) == 0x80; }))
      return std::nullopt;
    different.insert(character);
    at += bytes;
  }
  return count;
}

/// Length of the longest run along a row, either way, that begins there.
size_t run_at(const std::string& text, size_t at) {
  size_t longest = 1;
  for (const std::string row : rows)
    for (const std::string& way : {row, std::string(row.rbegin(), row.rend())})
      for (size_t length = min_run; at + length <= text.size(); ++length) {
        if (way.find(text.substr(at, length)) == std::string::npos) break;
        longest = std::max(longest, length);
      }
  return longest;
}

bool is_typed_along_rows(const std::string& text) {
  size_t beside = 0;
  for (size_t at = 0; at < text.size();) {
    const size_t run = run_at(text, at);
    if (run < min_run) ++beside;
    at += run;
  }
  return beside <= max_beside_runs;
}

bool is_repeated(const std::string& text) {
  for (size_t period = 1; period <= std::min(max_period, text.size() / 2); ++period)
    if (std::equal(text.begin() + static_cast<std::ptrdiff_t>(period), text.end(), text.begin())) return true;
  return false;
}

bool is_little_more_than(std::string text, const std::string& name) {
  if (name.size() < 3) return false;
  const size_t before = text.size();
  for (size_t at = text.find(name); at != std::string::npos; at = text.find(name, at))
    text.erase(at, name.size());
  return text.size() < before && text.size() < min_beside_name;
}

/// A common word, perhaps with figures for letters, and with figures and signs around it.
bool is_common(const std::string& text) {
  const auto letter = [](unsigned char c) { return std::isalpha(c) != 0 || c >= 0x80; };
  const auto end = std::find_if(text.rbegin(), text.rend(), letter).base();
  std::string word(std::find_if(text.begin(), end, letter), end);
  constexpr std::string_view figures = "@0134$578!", letters = "aoieasstbi";
  for (char& c : word)
    if (const size_t at = figures.find(c); at != std::string_view::npos) c = letters[at];
  std::erase_if(word, [](unsigned char c) { return std::ispunct(c) != 0 || c == ' '; });
  return std::find(common_words.begin(), common_words.end(), word) != common_words.end();
}

[[noreturn]] void refuse(const std::string& why) { throw Error(ErrorKind::invalid_input, why); }

}  // namespace

void require_good_password(const Secret& password, const std::string& name) {
  const std::string& text = password.reveal();
  if (text.size() > max_password_bytes)
    refuse("a password has at most " + std::to_string(max_password_bytes) + " bytes");
  std::set<std::string> different;
  const auto characters = characters_of(text, different);
  if (!characters) refuse("a password must be UTF-8 text");
  if (*characters < min_password_length)
    refuse("a password has at least " + std::to_string(min_password_length) + " characters");
  std::string small = lower(text);
  const char* why = different.size() < 4 || is_repeated(small) ? "repeats itself"
                    : is_typed_along_rows(small)               ? "is a row of keys, letters or figures"
                    : is_little_more_than(small, lower(name))  ? "is little more than the user's name"
                    : is_common(small)                         ? "is among the most common ones"
                                                               : nullptr;
  wipe(small);
  if (why) refuse("this password " + std::string(why) + ", which is tried first; a sentence is good");
}

}  // namespace ream::access

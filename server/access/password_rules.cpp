#include <algorithm>
#include <array>
#include <cctype>
#include <optional>
#include <set>
#include <unordered_set>

#include "access/password_hasher.hpp"
#include "access/secret.hpp"
#include "common_words.hpp"
#include "core/error.hpp"
#include "core/text.hpp"

namespace ream::access {
namespace {

/// Before a common word they make no better password.
constexpr std::array short_words{"i",    "im",    "iam",   "my",  "the", "our", "your", "new", "ich",
                                 "mein", "meine", "unser", "der", "die", "das", "mon",  "la",  "mi"};

/// Along these one types without thinking.
constexpr std::array rows{"abcdefghijklmnopqrstuvwxyz",
                          "01234567890",
                          "1472583690",
                          "7894561230",
                          "159753",
                          "!@#$%^&*()",
                          "!\"\u00a7$%&/()=",
                          "qazwsxedcrfvtgbyhnujmikolp",
                          "qaywsxedcrfvtgbzhnujmikolp",
                          "qwertyuiop",
                          "qwertzuiop",
                          "azertyuiop",
                          "asdfghjkl",
                          "zxcvbnm",
                          "yxcvbnm",
                          "1qaz2wsx3edc4rfv5tgb6yhn7ujm8ik9ol0p"};
constexpr size_t min_run = 3, max_beside_runs = 3, max_period = 9, min_beside_name = 6,
                 max_common_length = 40;

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

bool is_letter(unsigned char c) { return std::isalpha(c) != 0 || c >= 0x80; }

/// From the first letter to the last.
std::string_view without_ends(std::string_view text) {
  const auto first = std::find_if(text.begin(), text.end(), is_letter);
  return {first, std::find_if(text.rbegin(), std::make_reverse_iterator(first), is_letter).base()};
}

/// Umlauts, of either case, as common_words.txt has them.
std::string with_plain_letters(std::string text) {
  for (const auto& [umlaut, plain] : {std::pair{"\u00e4", "ae"},
                                      {"\u00c4", "ae"},
                                      {"\u00f6", "oe"},
                                      {"\u00d6", "oe"},
                                      {"\u00fc", "ue"},
                                      {"\u00dc", "ue"},
                                      {"\u00df", "ss"}})
    for (size_t at = text.find(umlaut); at != std::string::npos; at = text.find(umlaut, at))
      text.replace(at, 2, plain);
  return text;
}

/// With figures and signs read as the letters they stand for, or left out; `one` is what 1 stands for.
std::string letters_of(std::string_view text, char one, bool replace) {
  constexpr std::string_view figures = "@0$34578", letters = "aoseastb";
  std::string word;
  for (const char c : text)
    if (const size_t at = figures.find(c); replace && at != std::string_view::npos)
      word += letters[at];
    else if (replace && (c == '1' || c == '!' || c == '|'))
      word += one;
    else if (is_letter(static_cast<unsigned char>(c)))
      word += c;
  return word;
}

/// One common word or two; the user's name, too, is one.
bool are_common(std::string_view word, const std::string& name) {
  static const auto common = [] {
    std::unordered_set<std::string_view> words;
    std::string_view text = embedded::common_words::find("common_words.txt");
    while (text.starts_with('#')) text.remove_prefix(text.find('\n') + 1);
    for (size_t end = 0; !text.empty(); text.remove_prefix(std::min(end + 1, text.size()))) {
      end = std::min(text.find_first_of(" \n"), text.size());
      words.insert(text.substr(0, end));
    }
    return words;
  }();
  const auto is_one = [&](std::string_view part) {
    return common.contains(part) || (part == name && part.size() > 2);
  };
  if (word.size() > max_common_length) return false;
  if (is_one(word)) return true;
  for (size_t at = 1; at < word.size(); ++at)
    if (is_one(word.substr(at)) &&
        (is_one(word.substr(0, at)) ||
         std::find(short_words.begin(), short_words.end(), word.substr(0, at)) != short_words.end()))
      return true;
  return false;
}

/// Common words, perhaps with figures for letters, and with figures and signs around or between them.
bool is_common(std::string_view text, const std::string& name) {
  constexpr size_t max_for_letters = 2;  // of the figures at an end
  const std::string_view core = without_ends(text);
  const auto first = static_cast<size_t>(core.begin() - text.begin()), last = first + core.size();
  for (size_t begin = first - std::min(first, max_for_letters); begin <= first; ++begin)
    for (size_t end = last; end <= std::min(text.size(), last + max_for_letters); ++end)
      for (const bool replace : {false, true})
        for (const char one : {'i', 'l'})
          if (are_common(letters_of(text.substr(begin, end - begin), one, replace), name)) return true;
  return false;
}

/// Also where letters and figures take turns.
bool is_typed_along_rows_in_turns(const std::string& text) {
  std::string letters, figures;
  for (const char c : text) (is_letter(static_cast<unsigned char>(c)) ? letters : figures) += c;
  return is_typed_along_rows(text) || is_typed_along_rows(letters + figures);
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
  const std::string plain_name = letters_of(with_plain_letters(lower(name)), 'i', false);
  const char* why = different.size() < 4 || is_repeated(small) ? "repeats itself"
                    : is_typed_along_rows_in_turns(small)      ? "is a row of keys, letters or figures"
                    : is_little_more_than(small, lower(name))  ? "is little more than the user's name"
                    : is_common(with_plain_letters(small), plain_name) ? "is among the most common ones"
                                                                       : nullptr;
  wipe(small);
  if (why) refuse("this password " + std::string(why) + ", which is tried first; a sentence is good");
}

}  // namespace ream::access

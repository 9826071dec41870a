#include <locale.h>
#include <wctype.h>

#include <climits>
#include <cwchar>
#include <sstream>

#include "store/session_query.hpp"

namespace ream::store {
namespace {

/// The C library reads and writes UTF-8 on this thread as long as it lives.
class Utf8Thread {
 public:
  Utf8Thread() : before_(::uselocale(utf8())) {}
  ~Utf8Thread() { ::uselocale(before_); }
  Utf8Thread(const Utf8Thread&) = delete;
  Utf8Thread& operator=(const Utf8Thread&) = delete;

 private:
  static locale_t utf8() {
    static const locale_t locale = ::newlocale(LC_CTYPE_MASK, "C.UTF-8", nullptr);
    return locale;
  }
  const locale_t before_;
};

}  // namespace

std::string folded(const std::string& utf8) {
  const Utf8Thread thread;
  std::string text;
  std::mbstate_t reading{}, writing{};
  for (size_t at = 0; at < utf8.size();) {
    wchar_t letter = 0;
    const size_t length = std::mbrtowc(&letter, utf8.data() + at, utf8.size() - at, &reading);
    char bytes[MB_LEN_MAX];
    const bool readable = length != 0 && length <= utf8.size() - at;
    const size_t made =
        readable
            ? std::wcrtomb(bytes, static_cast<wchar_t>(::towlower(static_cast<wint_t>(letter))), &writing)
            : MB_LEN_MAX + 1;
    if (made <= MB_LEN_MAX)
      text.append(bytes, made);
    else
      text += utf8[at];
    if (!readable) reading = {};
    at += readable ? length : 1;
  }
  return text;
}

std::string searched_text(const SessionRow& row) {
  std::string text;
  for (const std::string& part :
       {row.id, row.title, row.trainee, row.participant, row.study, row.case_id, row.script})
    if (!part.empty()) text += part + '\n';
  return folded(text);
}

std::vector<std::string> searched_words(const SessionQuery& query) {
  std::istringstream text(folded(query.text));
  std::vector<std::string> words;
  for (std::string word; text >> word;) words.push_back(word);
  return words;
}

}  // namespace ream::store

#include "study/questionnaire.hpp"

#include <algorithm>
#include <questionnaires.hpp>
#include <set>

#include "core/error.hpp"
#include "core/json.hpp"
#include "core/json_reader.hpp"
#include "core/text.hpp"

namespace ream::study {
using nlohmann::json;
using Kind = QuestionnaireItem::Kind;
namespace {

// As the schema and the contract say; questionnaire_test.cpp holds them together.
constexpr size_t max_items = 200, max_options = 50;
constexpr size_t max_title = 200, max_words = 1000, max_introduction = 4000;
constexpr size_t default_text = 2000, max_text = 10000;

bool is_item_id(const std::string& text) {
  return !text.empty() && text.size() <= 64 && text.front() >= 'a' && text.front() <= 'z' &&
         text.find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789_") == std::string::npos;
}

bool is_language(const std::string& text) {
  const auto within = [&](size_t at, char first, char last) { return text[at] >= first && text[at] <= last; };
  const bool short_form = text.size() >= 2 && within(0, 'a', 'z') && within(1, 'a', 'z');
  return short_form && (text.size() == 2 ||
                        (text.size() == 5 && text[2] == '-' && within(3, 'A', 'Z') && within(4, 'A', 'Z')));
}

std::string item_id(JsonReader& reader) {
  const std::string id = reader.text("id");
  if (!is_item_id(id)) reader.refuse("id", "must begin with a-z and hold only a-z, 0-9 and _, at most 64");
  return id;
}

std::string words_of(JsonReader& reader, const std::string& key, size_t max_length) {
  const std::string words = reader.text(key);
  if (words.empty() || characters(words) > max_length)
    reader.refuse(key, "must be 1 to " + std::to_string(max_length) + " characters long");
  return words;
}

std::string words_or(JsonReader& reader, const std::string& key, const std::string& fallback,
                     size_t max_length) {
  const std::string words = reader.text_or(key, fallback);
  if (characters(words) > max_length)
    reader.refuse(key, "must be at most " + std::to_string(max_length) + " characters long");
  return words;
}

void read_likert(JsonReader& reader, QuestionnaireItem& item) {
  item.points = static_cast<int>(reader.integer("points"));
  if (item.points != 5 && item.points != 7) reader.refuse("points", "must be 5 or 7");
  item.low = reader.has("low") ? words_of(reader, "low", max_words) : "Strongly disagree";
  item.middle = words_or(reader, "middle", "", max_words);
  item.high = reader.has("high") ? words_of(reader, "high", max_words) : "Strongly agree";
  item.cannot_judge = reader.boolean_or("cannot_judge", false);
}

void read_choice(JsonReader& reader, QuestionnaireItem& item) {
  std::set<std::string> ids;
  for (JsonReader& option : reader.objects("options")) {
    item.options.push_back({item_id(option), words_of(option, "words", max_words)});
    option.finish();
    if (!ids.insert(item.options.back().id).second) option.refuse("id", "is that of another option too");
  }
  if (item.options.size() < 2 || item.options.size() > max_options)
    reader.refuse("options", "must be 2 to " + std::to_string(max_options) + " of them");
  item.several = reader.boolean_or("several", false);
}

QuestionnaireItem item_from(JsonReader& reader) {
  QuestionnaireItem item;
  item.id = item_id(reader);
  item.section = words_or(reader, "section", "", max_title);
  item.words = words_of(reader, "words", max_words);
  const std::string kind = reader.text("kind");
  if (kind == "likert") {
    read_likert(reader, item);
  } else if (kind == "choice") {
    item.kind = Kind::choice;
    read_choice(reader, item);
  } else if (kind == "text") {
    item.kind = Kind::text;
    item.longest = static_cast<size_t>(reader.integer_or("longest", default_text, 1, max_text));
  } else {
    reader.refuse("kind", "must be likert, choice or text");
  }
  item.required = reader.boolean_or("required", item.kind != Kind::text);
  reader.finish();
  return item;
}

/// Empty when `value` answers the item.
std::string fault_of(const QuestionnaireItem& item, const json& value) {
  const auto is_option = [&](const json& id) {
    return std::any_of(item.options.begin(), item.options.end(),
                       [&](const auto& option) { return id == option.id; });
  };
  switch (item.kind) {
    case Kind::likert:
      if (value.is_null()) return item.cannot_judge ? "" : "must be answered";
      if (value.is_number_integer() && value >= 1 && value <= item.points) return "";
      return "must be a whole number from 1 to " + std::to_string(item.points);
    case Kind::choice:
      if (!item.several) return is_option(value) ? "" : "must be the id of one of its options";
      if (value.is_array() && std::set<json>(value.begin(), value.end()).size() == value.size() &&
          std::all_of(value.begin(), value.end(), is_option) && (!value.empty() || !item.required))
        return "";
      return "must be a list of ids of its options, each once";
    case Kind::text:
      if (value.is_string() && characters(value.get<std::string>()) <= item.longest &&
          (!value.get<std::string>().empty() || !item.required))
        return "";
      return "must be a text of at most " + std::to_string(item.longest) + " characters" +
             (item.required ? ", and not empty" : "");
  }
  return "";
}

json to_json(const QuestionnaireItem& item) {
  json written = {
      {"id", item.id}, {"section", item.section}, {"words", item.words}, {"required", item.required}};
  switch (item.kind) {
    case Kind::likert:
      written.update({{"kind", "likert"},
                      {"points", item.points},
                      {"low", item.low},
                      {"middle", item.middle},
                      {"high", item.high},
                      {"cannot_judge", item.cannot_judge}});
      break;
    case Kind::choice:
      written.update({{"kind", "choice"}, {"options", json::array()}, {"several", item.several}});
      for (const auto& option : item.options)
        written["options"].push_back({{"id", option.id}, {"words", option.words}});
      break;
    case Kind::text: written.update({{"kind", "text"}, {"longest", item.longest}}); break;
  }
  return written;
}

}  // namespace

Questionnaire questionnaire_from(const json& value) {
  JsonReader reader(value, "questionnaire");
  Questionnaire questionnaire;
  questionnaire.id = item_id(reader);
  questionnaire.title = words_of(reader, "title", max_title);
  questionnaire.introduction = words_or(reader, "introduction", "", max_introduction);
  questionnaire.language = reader.text_or("language", "en");
  if (!is_language(questionnaire.language)) reader.refuse("language", "must be as \"en\" or \"en-GB\"");
  std::set<std::string> ids;
  for (JsonReader& item : reader.objects("items")) {
    questionnaire.items.push_back(item_from(item));
    if (!ids.insert(questionnaire.items.back().id).second) item.refuse("id", "is that of another item too");
  }
  if (questionnaire.items.empty() || questionnaire.items.size() > max_items)
    reader.refuse("items", "must be 1 to " + std::to_string(max_items) + " of them");
  reader.finish();
  return questionnaire;
}

json to_json(const Questionnaire& questionnaire) {
  json items = json::array();
  for (const QuestionnaireItem& item : questionnaire.items) items.push_back(to_json(item));
  return {{"id", questionnaire.id},
          {"title", questionnaire.title},
          {"introduction", questionnaire.introduction},
          {"language", questionnaire.language},
          {"items", std::move(items)}};
}

const Questionnaire& face_validity_questionnaire() {
  static const Questionnaire ours =
      questionnaire_from(parse_json(embedded::questionnaires::find("face_validity_1.json")));
  return ours;
}

const Questionnaire& default_rating_form() {
  static const Questionnaire ours =
      questionnaire_from(parse_json(embedded::questionnaires::find("rating_1.json")));
  return ours;
}

std::vector<net::FieldError> faults_of_answers(const Questionnaire& questionnaire, const json& answers) {
  if (!answers.is_object()) return {{"#", "the answers must be an object by item id"}};
  std::vector<net::FieldError> faults;
  for (const QuestionnaireItem& item : questionnaire.items) {
    const auto answer = answers.find(item.id);
    const std::string fault =
        answer == answers.end() ? (item.required ? "must be answered" : "") : fault_of(item, *answer);
    if (!fault.empty()) faults.push_back({"#/" + item.id, "'" + item.id + "' " + fault});
  }
  for (const auto& [id, answer] : answers.items())
    if (std::none_of(questionnaire.items.begin(), questionnaire.items.end(),
                     [&asked = id](const QuestionnaireItem& item) { return item.id == asked; }))
      faults.push_back({pointer_to(id), "'" + id + "' is no item of the questionnaire"});
  return faults;
}

}  // namespace ream::study

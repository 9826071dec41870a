#pragma once
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "net/problem.hpp"

namespace ream::study {

/// One thing that participants are asked (proto/questionnaire.schema.json).
struct QuestionnaireItem {
  enum class Kind { likert, choice, text };
  struct Option {
    std::string id, words;
  };

  std::string id;  ///< [a-z][a-z0-9_]*, stable: answers and columns are named by it
  Kind kind = Kind::likert;
  std::string section, words;
  bool required = true;
  int points = 5;               ///< likert: 1 (low) to points (high)
  std::string low, high;        ///< likert: words of the two ends
  std::string middle;           ///< likert: words of the point between; may be empty
  bool cannot_judge = false;    ///< likert: null is an answer
  std::vector<Option> options;  ///< choice
  bool several = false;         ///< choice: more than one may be chosen
  size_t longest = 0;           ///< text: characters
};

struct Questionnaire {
  std::string id, title, introduction, language;
  std::vector<QuestionnaireItem> items;
};

/// Error invalid_input names the place of what is wrong, "questionnaire.items[2]: key 'points' ...".
Questionnaire questionnaire_from(const nlohmann::json& value);
/// With every default written out.
nlohmann::json to_json(const Questionnaire& questionnaire);

/// The questionnaire that comes with the program: how real and how useful the simulator is.
const Questionnaire& face_validity_questionnaire();
/// The form for raters that comes with the program: global scales and a checklist.
const Questionnaire& default_rating_form();

/// Everything that keeps `answers` (an object by item id) from being a complete set of answers.
std::vector<net::FieldError> faults_of_answers(const Questionnaire& questionnaire,
                                               const nlohmann::json& answers);

}  // namespace ream::study

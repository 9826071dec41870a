// JSON files that people bring along: questionnaires, answers, rubrics, benchmarks, labels of sessions, a
// case's CT beside it, its settings, and what ream-reader answers; and cursors of lists.
#include <nlohmann/json.hpp>

#include "core/error.hpp"
#include "core/json.hpp"
#include "ct/build/ct_workspace.hpp"
#include "ct/read/volume_answer.hpp"
#include "fuzz_input.hpp"
#include "score/benchmark.hpp"
#include "score/rubric.hpp"
#include "session/folder/session_labels.hpp"
#include "session/running_session.hpp"
#include "store/session_query.hpp"
#include "study/questionnaire.hpp"

namespace ream::fuzz {
namespace {

/// What is read must be the same when it has been written and read again.
template <typename Read, typename Write>
void read_twice(const nlohmann::json& json, Read read, Write write) {
  const nlohmann::json once = write(read(json));
  require(write(read(once)) == once, "what was written is read as something else");
}

void read(uint8_t kind, const nlohmann::json& json) {
  const std::string place = "the file";
  const auto placed = [&](auto read) {
    return [=](const nlohmann::json& value) { return read(value, place); };
  };
  const auto written = [](const auto& value) { return to_json(value); };
  switch (kind % 8) {
    case 0: read_twice(json, study::questionnaire_from, written); break;
    case 1: study::faults_of_answers(study::face_validity_questionnaire(), json); break;
    case 2: read_twice(json, placed(score::rubric_from_json), score::rubric_json); break;
    case 3: read_twice(json, placed(score::benchmark_from_json), score::benchmark_json); break;
    case 4: {
      session::SessionRequest request;
      try {
        session::read_labels(json, request);
      } catch (const nlohmann::json::exception&) {  // which its callers expect
      }
      session::labels_json(request);
      break;
    }
    case 5: read_twice(json, placed(ct::workup_from_json), written); break;
    case 6:
      ct::segmentation_settings_from_json(json, place);
      ct::build_settings_from_json(json, place);
      break;
    default: {
      const ct::HuVolume volume = ct::volume_from(json);
      require(volume.dims.minCoeff() > 1 && volume.spacing_mm.minCoeff() > 0.0,
              "a volume without size was taken");
    }
  }
}

void read_cursor(std::string_view text) {
  store::SessionQuery query;
  query.cursor = text;
  if (const auto place = store::place_of_cursor(query)) store::number_of(*place);
  store::folded(std::string(text));
}

}  // namespace
}  // namespace ream::fuzz

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace ream;
  fuzz::Input input(data, size);
  const uint8_t kind = input.byte();
  try {
    fuzz::read_cursor(input.rest());
  } catch (const Error&) {
  }
  try {
    fuzz::read(kind, parse_json(input.rest()));
  } catch (const Error&) {
  }
  return 0;
}

#include "session/simulation/recorded_case.hpp"

#include "core/error.hpp"
#include "session/simulation/find_case.hpp"
#include "session/simulation/recorded_setup.hpp"

namespace ream::session {
namespace {

void require_computable(const record::Recording& recording) {
  if (recording.header().settings.empty())
    throw Error(ErrorKind::invalid_input,
                recording.log().path().string() +
                    " is of an older revision that does not say enough to go through it or compute it again");
}

}  // namespace

case_::Case recorded_case(const record::Recording& recording, const std::string& case_name,
                          const std::filesystem::path& data) {
  require_computable(recording);
  const std::string& recorded_id = recording.header().case_id;
  case_::Case found;
  try {
    found = find_case(case_name.empty() ? recorded_id : case_name, data);
  } catch (const Error& e) {
    throw Error(e.kind(), "the case '" + recorded_id + "' of this recording cannot be had (" + e.what() +
                              "); say where it is with --case");
  }
  return case_as_recorded(recording, std::move(found));
}

case_::Anatomy recorded_anatomy(const record::Recording& recording, const case_::Case& native,
                                const std::string& case_name, const std::filesystem::path& data) {
  const record::ops::Header& header = recording.header();
  if (header.anatomy.empty())
    return find_anatomy(native, case_name.empty() ? header.case_id : case_name, data);
  return anatomy_in(recording);
}

}  // namespace ream::session

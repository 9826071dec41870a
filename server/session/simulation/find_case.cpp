#include "session/simulation/find_case.hpp"

#include "core/data_folder.hpp"
#include "ct/phantom/phantom_case.hpp"
#include "session/simulation/case_cache.hpp"

namespace ream::session {

namespace fs = std::filesystem;

case_::Case find_case(const std::string& name, const fs::path& data) {
  static CaseCache cache;
  const fs::path folder = case_path(name, data);
  if (name == "demo" && !fs::exists(folder / "case.json")) ct::load_or_make_demo_case(data);
  return cache.load(folder);
}

case_::Anatomy find_anatomy(const case_::Case& c, const std::string& name, const fs::path& data) {
  return case_::anatomy_of(c, case_path(name, data));
}

}  // namespace ream::session

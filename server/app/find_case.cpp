#include "app/find_case.hpp"

#include "app/case_shelf.hpp"
#include "app/cli/case_path.hpp"
#include "ct/phantom/phantom_case.hpp"

namespace ream::app {

namespace fs = std::filesystem;

case_::Case find_case(const std::string& name, const fs::path& data) {
  static CaseShelf shelf;
  const fs::path folder = case_path(name, data);
  if (name == "demo" && !fs::exists(folder / "case.json")) ct::load_or_make_demo_case(data);
  return shelf.load(folder);
}

case_::Anatomy find_anatomy(const case_::Case& c, const std::string& name, const fs::path& data) {
  return case_::anatomy_of(c, case_path(name, data));
}

}  // namespace ream::app

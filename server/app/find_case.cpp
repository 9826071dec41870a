#include "app/find_case.hpp"

#include "app/case_shelf.hpp"
#include "app/cli/case_path.hpp"
#include "app/data_folder.hpp"
#include "ct/phantom_case.hpp"

namespace ream::app {

namespace fs = std::filesystem;

case_::Case find_case(const std::string& name, const fs::path& data) {
  static CaseShelf shelf;
  if (name != "demo") return shelf.load(case_path(name, data));
  const fs::path demo = cases_folder(data) / "demo";
  if (!fs::exists(demo / "case.json")) ct::load_or_make_demo_case(data);
  return shelf.load(demo);
}

case_::Anatomy find_anatomy(const case_::Case& c, const std::string& name, const fs::path& data) {
  return case_::anatomy_of(c, name == "demo" ? cases_folder(data) / "demo" : case_path(name, data));
}

}  // namespace ream::app

#pragma once
#include <string>
#include <vector>

namespace ream::device {

/// Where a maker's library may be found.
struct VendorLibraryPlace {
  std::string maker;                    ///< for people, "Force Dimension's SDK"
  std::string path;                     ///< from a set-up; empty: not said
  const char* variable;                 ///< of the environment, that names a path where the set-up says none
  std::vector<std::string> file_names;  ///< that the loader looks for where neither says one, in this order
};

/// A library that its maker alone may give out: it is opened where it is installed, and stays loaded to the
/// end of the process, as makers' libraries have threads of their own.
class VendorLibrary {
 public:
  /// Error unavailable, saying where it was looked for and what to do, when it is not there.
  explicit VendorLibrary(const VendorLibraryPlace& place);

  /// Error unavailable when it has no such function.
  template <typename Function>
  void find(Function*& function, const char* name) const {
    function = reinterpret_cast<Function*>(symbol(name, true));
  }
  /// Null where it has no such function.
  template <typename Function>
  void find_optional(Function*& function, const char* name) const {
    function = reinterpret_cast<Function*>(symbol(name, false));
  }

 private:
  void* symbol(const char* name, bool needed) const;

  void* handle_ = nullptr;
  std::string maker_, found_;
};

}  // namespace ream::device

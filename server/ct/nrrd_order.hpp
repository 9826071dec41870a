#pragma once
#include <filesystem>

namespace ream::ct {

/// The NRRD format lets the fields of a header stand in any order (but for `dimension`), the reading library
/// wants `space` before what depends on it. A header in another order is written again, in a passing file
/// that names the voxels of the first.
class OrderedNrrd {
 public:
  /// Errors: io when the passing file cannot be written.
  explicit OrderedNrrd(const std::filesystem::path& path);
  ~OrderedNrrd();
  OrderedNrrd(const OrderedNrrd&) = delete;
  OrderedNrrd& operator=(const OrderedNrrd&) = delete;

  /// What to give the library: the file itself when it is in order.
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
  bool passing_ = false;
};

}  // namespace ream::ct

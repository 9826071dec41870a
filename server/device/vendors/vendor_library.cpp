#include "device/vendors/vendor_library.hpp"

#include <dlfcn.h>

#include <cstdlib>

#include "core/error.hpp"

namespace ream::device {
namespace {

std::string joined(const std::vector<std::string>& names) {
  std::string all;
  for (const std::string& name : names) all += (all.empty() ? "" : " or ") + name;
  return all;
}

}  // namespace

VendorLibrary::VendorLibrary(const VendorLibraryPlace& place) : maker_(place.maker) {
  std::vector<std::string> candidates = place.file_names;
  const char* from_environment = std::getenv(place.variable);
  if (from_environment != nullptr && *from_environment != '\0') candidates = {from_environment};
  if (!place.path.empty()) candidates = {place.path};
  std::string why;
  for (const std::string& candidate : candidates) {
    handle_ = ::dlopen(candidate.c_str(), RTLD_NOW | RTLD_LOCAL | RTLD_NODELETE);
    found_ = candidate;
    if (handle_ != nullptr) return;
    if (const char* message = ::dlerror(); why.empty() && message != nullptr) why = message;
  }
  throw Error(ErrorKind::unavailable, maker_ + " is not there (" + joined(candidates) + ": " + why +
                                          "); install it from its maker, or name its library in the set-up "
                                          "(connection.library) or in " +
                                          place.variable);
}

void* VendorLibrary::symbol(const char* name, bool needed) const {
  void* found = ::dlsym(handle_, name);
  if (found == nullptr && needed)
    throw Error(ErrorKind::unavailable, found_ + " is not " + maker_ + ": it has no " + name +
                                            "; correct the library's path in the set-up");
  return found;
}

}  // namespace ream::device

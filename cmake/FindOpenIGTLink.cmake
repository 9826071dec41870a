# Debian's libopenigtlink-dev has a CMake file without targets. Gives the target OpenIGTLink::OpenIGTLink.
find_path(OpenIGTLink_INCLUDE_DIR igtlTransformMessage.h PATH_SUFFIXES openigtlink)
find_library(OpenIGTLink_LIBRARY OpenIGTLink)

include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(OpenIGTLink REQUIRED_VARS OpenIGTLink_LIBRARY OpenIGTLink_INCLUDE_DIR)

if(OpenIGTLink_FOUND AND NOT TARGET OpenIGTLink::OpenIGTLink)
  add_library(OpenIGTLink::OpenIGTLink INTERFACE IMPORTED)
  target_include_directories(OpenIGTLink::OpenIGTLink SYSTEM INTERFACE ${OpenIGTLink_INCLUDE_DIR})
  target_link_libraries(OpenIGTLink::OpenIGTLink INTERFACE ${OpenIGTLink_LIBRARY})
endif()

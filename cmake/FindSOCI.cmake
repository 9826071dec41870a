# Debian's libsoci-dev has no CMake file of its own. Gives the target SOCI::SOCI with both stores' backends.
find_path(SOCI_INCLUDE_DIR soci/soci.h)
find_path(SOCI_LIBPQ_INCLUDE_DIR libpq-fe.h PATH_SUFFIXES postgresql)
find_path(SOCI_SQLITE3_INCLUDE_DIR sqlite3.h)
foreach(part core sqlite3 postgresql)
  find_library(SOCI_${part}_LIBRARY soci_${part})
endforeach()
find_library(SOCI_LIBPQ_LIBRARY pq)
find_library(SOCI_LIBSQLITE3_LIBRARY sqlite3)

include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(SOCI REQUIRED_VARS
  SOCI_core_LIBRARY SOCI_sqlite3_LIBRARY SOCI_postgresql_LIBRARY SOCI_LIBPQ_LIBRARY SOCI_LIBSQLITE3_LIBRARY
  SOCI_INCLUDE_DIR SOCI_LIBPQ_INCLUDE_DIR SOCI_SQLITE3_INCLUDE_DIR)

if(SOCI_FOUND AND NOT TARGET SOCI::SOCI)
  add_library(SOCI::SOCI INTERFACE IMPORTED)
  target_include_directories(SOCI::SOCI SYSTEM INTERFACE
    ${SOCI_INCLUDE_DIR} ${SOCI_LIBPQ_INCLUDE_DIR} ${SOCI_SQLITE3_INCLUDE_DIR})
  target_link_libraries(SOCI::SOCI INTERFACE
    ${SOCI_core_LIBRARY} ${SOCI_sqlite3_LIBRARY} ${SOCI_postgresql_LIBRARY}
    ${SOCI_LIBPQ_LIBRARY} ${SOCI_LIBSQLITE3_LIBRARY})
endif()

# The ops of a recording as C++: a target that needs #include "record/ops.hpp" depends on ream_record_ops and includes
# ${REAM_RECORD_OPS_FOLDER}.
add_executable(ream-make-ops ${CMAKE_SOURCE_DIR}/server/record/make_ops.cpp)
target_link_libraries(ream-make-ops PRIVATE ream_flags nlohmann_json::nlohmann_json)
set(REAM_RECORD_OPS_FOLDER ${CMAKE_CURRENT_BINARY_DIR}/generated)
file(MAKE_DIRECTORY ${REAM_RECORD_OPS_FOLDER}/record)
add_custom_command(
  OUTPUT ${REAM_RECORD_OPS_FOLDER}/record/ops.hpp
  COMMAND ream-make-ops ${CMAKE_SOURCE_DIR}/proto/recording.json ${REAM_RECORD_OPS_FOLDER}/record/ops.hpp
  DEPENDS ream-make-ops ${CMAKE_SOURCE_DIR}/proto/recording.json
  VERBATIM)
add_custom_target(ream_record_ops DEPENDS ${REAM_RECORD_OPS_FOLDER}/record/ops.hpp)

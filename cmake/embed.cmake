# ream_embed(<target> <symbol namespace> <files...>): builds a static library <target> whose header
# <target>.hpp has `std::string_view find(std::string_view file_name)` over the embedded files.
function(ream_embed target)
  set(out ${CMAKE_CURRENT_BINARY_DIR}/${target})
  set(files ${ARGN})
  add_custom_command(
    OUTPUT ${out}.cpp ${out}.hpp
    COMMAND ${CMAKE_COMMAND} -DTARGET=${target} -DOUT=${out} "-DFILES=${files}"
            -P ${CMAKE_SOURCE_DIR}/cmake/embed_files.cmake
    DEPENDS ${files} ${CMAKE_SOURCE_DIR}/cmake/embed_files.cmake
    VERBATIM)
  add_library(${target} STATIC ${out}.cpp)
  target_include_directories(${target} PUBLIC ${CMAKE_CURRENT_BINARY_DIR})
  set_target_properties(${target} PROPERTIES UNITY_BUILD OFF)
  target_link_libraries(${target} PRIVATE ream_flags)
endfunction()

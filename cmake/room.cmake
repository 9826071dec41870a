# Flags of every target of ours. Results must be the same bits everywhere: no contraction, no fast-math.
add_library(ream_flags INTERFACE)
target_compile_options(ream_flags INTERFACE
  -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wno-sign-conversion -Werror -ffp-contract=off)
if(REAM_TOGETHER GREATER 1)
  # A file's local name may be that of something in another that is compiled with it.
  target_compile_options(ream_flags INTERFACE -Wno-shadow)
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    target_compile_options(ream_flags INTERFACE -Wshadow=local -Wno-subobject-linkage)
  endif()
endif()
if(REAM_SANITIZER)
  # Under the address sanitizer g++ 12 takes the standard library's std::regex for uninitialized. Types of SOCI's
  # library are not to be had at run time, so that checks of vptr do not link.
  target_compile_options(ream_flags INTERFACE -fsanitize=${REAM_SANITIZER} -fno-sanitize=vptr
                         -fno-omit-frame-pointer -Wno-maybe-uninitialized)
  target_link_options(ream_flags INTERFACE -fsanitize=${REAM_SANITIZER})
endif()

# ream_room(<folder> SOURCES <files...> [ROOMS <folders...>] [LIBRARIES <public...>] [PRIVATE_LIBRARIES <...>])
# One static library per folder of server/, named ream_<folder>, include root server/.
function(ream_room name)
  cmake_parse_arguments(ROOM "" "" "SOURCES;ROOMS;LIBRARIES;PRIVATE_LIBRARIES" ${ARGN})
  add_library(ream_${name} STATIC ${ROOM_SOURCES})
  target_include_directories(ream_${name} PUBLIC ${CMAKE_SOURCE_DIR}/server)
  target_link_libraries(ream_${name} PRIVATE ream_flags)
  target_link_libraries(ream_${name} PUBLIC ${ROOM_LIBRARIES})
  target_link_libraries(ream_${name} PRIVATE ${ROOM_PRIVATE_LIBRARIES})
  foreach(room ${ROOM_ROOMS})
    target_link_libraries(ream_${name} PUBLIC ream_${room})
  endforeach()
endfunction()

# Flags of every target of ours. Results must be the same bits everywhere: no contraction, no fast-math.
add_library(ream_flags INTERFACE)
target_compile_options(ream_flags INTERFACE
  -pthread -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wno-sign-conversion -Werror -ffp-contract=off)
if(REAM_PYTHON)
  # The same objects make the programs and Python's module.
  target_compile_options(ream_flags INTERFACE -fPIC -fno-semantic-interposition)
endif()
if(CMAKE_UNITY_BUILD AND CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  # g++ takes a unity source for a header: what an unnamed namespace of one of its files declares.
  target_compile_options(ream_flags INTERFACE -Wno-subobject-linkage)
endif()
if(CMAKE_BUILD_TYPE STREQUAL "Release")
  # The folder of the build stands nowhere in the program: the same sources make the same bytes in any place.
  target_compile_options(ream_flags INTERFACE -ffile-prefix-map=${CMAKE_SOURCE_DIR}/= -ffile-prefix-map=${CMAKE_BINARY_DIR}/=build/)
endif()
if(NOT REAM_SANITIZER AND NOT REAM_FUZZ)
  # What makes a mistake in memory end the program (device/crash_guard takes the force away) rather than serve somebody.
  # Sanitizers find more, and do not go with it. tests/unit/app/hardening_test.cpp looks for all of it in the program.
  target_compile_options(ream_flags INTERFACE -fstack-protector-strong -fstack-clash-protection
                         -U_FORTIFY_SOURCE -D_FORTIFY_SOURCE=2)
  if(CMAKE_SYSTEM_PROCESSOR STREQUAL "x86_64")
    target_compile_options(ream_flags INTERFACE -fcf-protection)
  endif()
  target_link_options(ream_flags INTERFACE -Wl,-z,relro,-z,now,-z,noexecstack)
endif()
if(REAM_SANITIZER)
  # Under the address sanitizer g++ 12 takes the standard library's std::regex for uninitialized. Types of SOCI's
  # library are not to be had at run time, so that checks of vptr do not link.
  target_compile_options(ream_flags INTERFACE -fsanitize=${REAM_SANITIZER} -fno-sanitize=vptr
                         -fno-omit-frame-pointer -Wno-maybe-uninitialized)
  target_link_options(ream_flags INTERFACE -fsanitize=${REAM_SANITIZER})
endif()

# Headers of ITK for a target, and for those that link it where `visibility` is PUBLIC. ITK brings an older Eigen of its own,
# which must not meet ours in one source.
function(ream_use_itk target visibility)
  target_include_directories(${target} SYSTEM ${visibility} ${ITK_INCLUDE_DIRS})
  target_compile_definitions(${target} ${visibility} ITK_USE_SYSTEM_EIGEN)
  if(CMAKE_CXX_COMPILER_ID STREQUAL "Clang")
    target_compile_options(${target} ${visibility} "SHELL:-include ${CMAKE_SOURCE_DIR}/cmake/itk_for_clang.hpp")
  endif()
endfunction()

# Headers that most sources read, compiled once: ream_precompiled(<name> <headers...>) makes a set of them,
# ream_use_precompiled(<target> <name>) gives it to a target that is compiled with the same options.
function(ream_precompiled name)
  add_library(${name} OBJECT ${CMAKE_SOURCE_DIR}/cmake/precompiled.cpp)
  target_link_libraries(${name} PRIVATE ream_flags Eigen3::Eigen nlohmann_json::nlohmann_json)
  target_precompile_headers(${name} PRIVATE ${ARGN})
endfunction()

function(ream_use_precompiled target name)
  if(REAM_PRECOMPILED)
    target_precompile_headers(${target} REUSE_FROM ${name})
  endif()
endfunction()

# Indices of the standard library's containers are checked in the program, but for rooms that are UNCHECKED.
if(NOT REAM_FUZZ)
  set(REAM_CHECKED_CONTAINERS _GLIBCXX_ASSERTIONS)
endif()

set(REAM_COMMON_HEADERS
  <algorithm> <array> <atomic> <chrono> <cmath> <condition_variable> <cstdint> <deque> <filesystem> <fstream> <functional>
  <map> <memory> <mutex> <numeric> <optional> <set> <span> <sstream> <string> <string_view> <thread> <unordered_map>
  <utility> <variant> <vector> <Eigen/Core> <nlohmann/json.hpp>)
if(REAM_PRECOMPILED)
  ream_precompiled(ream_precompiled_server ${REAM_COMMON_HEADERS})
  target_compile_definitions(ream_precompiled_server PRIVATE ${REAM_CHECKED_CONTAINERS})
endif()

# ream_room(<folder> SOURCES <files...> [ROOMS <folders...>] [LIBRARIES <public...>] [PRIVATE_LIBRARIES <...>] [UNCHECKED])
# One static library per folder of server/, named ream_<folder>, include root server/.
function(ream_room name)
  cmake_parse_arguments(ROOM "UNCHECKED" "" "SOURCES;ROOMS;LIBRARIES;PRIVATE_LIBRARIES" ${ARGN})
  add_library(ream_${name} STATIC ${ROOM_SOURCES})
  target_include_directories(ream_${name} PUBLIC ${CMAKE_SOURCE_DIR}/server)
  target_link_libraries(ream_${name} PRIVATE ream_flags)
  if(NOT ROOM_UNCHECKED)
    target_compile_definitions(ream_${name} PRIVATE ${REAM_CHECKED_CONTAINERS})
    ream_use_precompiled(ream_${name} ream_precompiled_server)
  endif()
  target_link_libraries(ream_${name} PUBLIC ${ROOM_LIBRARIES})
  target_link_libraries(ream_${name} PRIVATE ${ROOM_PRIVATE_LIBRARIES})
  foreach(room ${ROOM_ROOMS})
    target_link_libraries(ream_${name} PUBLIC ream_${room})
  endforeach()
endfunction()

# Writes ${OUT}.hpp and ${OUT}.cpp holding the bytes of ${FILES}; see embed.cmake.
file(WRITE ${OUT}.hpp.tmp "#pragma once\n#include <string_view>\n\nnamespace ream::embedded::${TARGET} {\n\n\
/// The embedded file of that name (without folder); empty when there is none.\n\
std::string_view find(std::string_view file_name);\n\n}  // namespace ream::embedded::${TARGET}\n")
file(COPY_FILE ${OUT}.hpp.tmp ${OUT}.hpp ONLY_IF_DIFFERENT)
set(body "#include \"${TARGET}.hpp\"\n\nnamespace ream::embedded::${TARGET} {\nnamespace {\n")
set(table "")
set(n 0)
foreach(file ${FILES})
  get_filename_component(name ${file} NAME)
  file(READ ${file} hex HEX)
  string(LENGTH "${hex}" digits)
  math(EXPR size "${digits} / 2")
  string(REGEX REPLACE "([0-9a-f][0-9a-f])" "0x\\1," bytes "${hex}")
  string(APPEND body "constexpr unsigned char file_${n}[] = {${bytes}0};\n")
  string(APPEND table
    "  if (file_name == \"${name}\") return {reinterpret_cast<const char*>(file_${n}), ${size}};\n")
  math(EXPR n "${n} + 1")
endforeach()
string(APPEND body "}  // namespace\n\nstd::string_view find(std::string_view file_name) {\n${table}  return {};\n}\n\n}  // namespace\n")
file(WRITE ${OUT}.cpp "${body}")

#pragma once
// Debian's ITK refuses to be compiled by anything but gcc, and by an old one. Its macros for gcc fit clang, too.
#pragma push_macro("__clang__")
#pragma push_macro("__GNUC__")
#undef __clang__
#undef __GNUC__
#define __GNUC__ 10
#include <itk_compiler_detection.h>
#pragma pop_macro("__GNUC__")
#pragma pop_macro("__clang__")

#pragma once
// Debian's ITK refuses to be compiled by anything but gcc. Its macros for gcc fit clang, too.
#pragma push_macro("__clang__")
#undef __clang__
#include <itk_compiler_detection.h>
#pragma pop_macro("__clang__")

#include "unit/layering/source_shape.hpp"

#include <gtest/gtest.h>

namespace ream::layering {
namespace {

std::vector<std::string> functions_of(const std::string& text) {
  std::vector<std::string> found;
  for (const FunctionLines& function : function_lines("a.cpp", text))
    found.push_back(function.place + " " + std::to_string(function.lines));
  return found;
}
using Found = std::vector<std::string>;

TEST(SourceShape, CodeIsWithoutCommentsLiteralsAndDirectives) {
  EXPECT_EQ(bare_code("#define A(x) \\\n  {\nint a = 1'000;  // {\n/* {\n */ char b = '{';\n"),
            "\n\nint a = 1'000;  \n\n char b = \"\";\n");
  EXPECT_EQ(bare_code("auto a = R\"x({\n)\" )x\" + \"\\\"{\";\n"), "auto a = \"\"\n + \"\";\n");
}

TEST(SourceShape, FunctionsAreCountedFromTheirHeadToTheirEnd) {
  EXPECT_EQ(
      functions_of("namespace a {\n\nint f() { return 1; }\n\nint g(int x,\n      int y) {\n  if (x) {\n"
                   "    return y;\n  }\n  return 2;\n}\n\n}  // namespace a\n"),
      (Found{"a.cpp:3 1", "a.cpp:5 7"}));
}

TEST(SourceShape, MembersConstructorsAndOperatorsAreFunctionsToo) {
  EXPECT_EQ(functions_of(
                "class A final : public B {\n public:\n  A(int a) : a_{a}, b_(a) {}\n"
                "  bool operator==(const A& other) const {\n    return a_ == other.a_;\n  }\n"
                "  int c() const noexcept override { return a_; }\n\n private:\n  int a_{0}, b_ = 2;\n};\n"),
            (Found{"a.cpp:3 1", "a.cpp:4 3", "a.cpp:7 1"}));
}

TEST(SourceShape, ATemplateAndATryBlockAreFunctions) {
  EXPECT_EQ(
      functions_of("template <typename T, size_t n = (1 << 3)>\nstd::array<T, n> f(T x) {\n  return {x};\n}\n"
                   "int main() try {\n  return f();\n} catch (...) {\n  return 1;\n}\n"),
      (Found{"a.cpp:1 4", "a.cpp:5 3"}));
}

TEST(SourceShape, ValuesTypesAndLambdasInThemAreNone) {
  EXPECT_EQ(functions_of("const std::map<int, int> table{\n    {1, f(2)},\n    {2, 3}};\n"
                         "constexpr int a[] = {1, 2};\nstruct alignas(64) S {\n  int b = 0;\n};\n"
                         "enum class E { a, b };\n"),
            Found{});
  EXPECT_EQ(functions_of("int f() {\n  struct L {\n    int g() { return 1; }\n  };\n  return [] { return "
                         "L().g(); }();\n}\n"),
            Found{"a.cpp:1 6"});
}

TEST(SourceShape, DeclarationsAreFunctionsAndTypesOfTheNamespace) {
  const Declarations header = declarations(
      "#pragma once\n#include <a>\nnamespace ream {\nclass B;\nusing C = std::vector<int>;\nconstexpr double "
      "d = f(1);\n"
      "struct E {\n  int g();\n  struct H {};\n};\nenum class I : int { a };\n[[nodiscard]] bool j(B& b) "
      "noexcept;\n"
      "inline int k() { return 1; }\ntemplate <typename T>\nvoid l(T t);\nstatic_assert(sizeof(E) == "
      "1);\n}\n");
  EXPECT_EQ(header.functions, 3);
  EXPECT_EQ(header.types, 3);
}

}  // namespace
}  // namespace ream::layering

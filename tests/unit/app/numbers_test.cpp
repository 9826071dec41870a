#include "app/numbers.hpp"

#include "support/expect_error.hpp"

namespace ream::app {
namespace {

using Numbers = std::vector<double>;

TEST(ParseNumbers, TakesExactlyThatMany) {
  EXPECT_EQ(parse_numbers("1", 1, "--a"), Numbers{1});
  EXPECT_EQ(parse_numbers("1,-2.5,3e2", 3, "--a"), (Numbers{1, -2.5, 300}));
}

TEST(ParseNumbers, RefusesEverythingElseByOption) {
  for (const char* text : {"", "1", "1,2", "1,2,3,4", "1,2,x", "1,2,3x", "1,,3", ",1,2", "1,2,", "1,2,3,",
                           "1 2 3", "1,2,nan", "1,inf,3", "1, 2,3", "1,2,1e999"})
    test::expect_error(ErrorKind::usage, "--grow-from", [&] { parse_numbers(text, 3, "--grow-from"); });
}

}  // namespace
}  // namespace ream::app

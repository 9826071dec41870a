#include "wire/access/personas.hpp"

namespace ream::test {
namespace {

TEST(Placeholder, Builds) {}

}  // namespace
}  // namespace ream::test

#include <cstring>
#include <random>

#include "every_device.hpp"
#include "gpu/program.hpp"

namespace ream {
namespace {

struct Numbers {
  std::vector<float> a, b, c;
};

Numbers random_numbers(size_t count, unsigned seed) {
  std::cout << "seed " << seed << '\n';
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> number(-10.0f, 10.0f);
  Numbers n;
  for (size_t i = 0; i < count; ++i) {
    n.a.push_back(number(random));
    n.b.push_back(number(random));
    n.c.push_back(number(random));
  }
  return n;
}

std::vector<float> on_device(const gpu::Queue& queue, const char* kernel_name, Numbers& n) {
  const gpu::Program program(queue, "arithmetic_check.cl");
  gpu::Kernel kernel(program, kernel_name);
  std::vector<float> sums(n.a.size());
  const gpu::Buffer a = gpu::Buffer::over(queue, std::span(n.a)),
                    b = gpu::Buffer::over(queue, std::span(n.b)),
                    c = gpu::Buffer::over(queue, std::span(n.c)), out(queue, sums.size() * sizeof(float));
  kernel.set_all(a, b, c, out, static_cast<uint32_t>(sums.size()));
  kernel.enqueue(queue, sums.size(), 64);
  queue.finish();
  out.read(queue, sums.data(), sums.size() * sizeof(float));
  return sums;
}

size_t different_bits(const std::vector<float>& x, const std::vector<float>& y) {
  size_t different = 0;
  for (size_t i = 0; i < x.size(); ++i) different += std::memcmp(&x[i], &y[i], sizeof(float)) != 0;
  return different;
}

TEST(Arithmetic, MultiplyThenAddRoundsTwiceLikeCpp) {
  Numbers n = random_numbers(65536, 1);
  std::vector<float> expected, fused;
  for (size_t i = 0; i < n.a.size(); ++i) {
    expected.push_back(n.a[i] * n.b[i] + n.c[i]);
    fused.push_back(std::fma(n.a[i], n.b[i], n.c[i]));
  }
  EXPECT_GT(different_bits(expected, fused), n.a.size() / 20) << "the numbers cannot tell fused from not";
  test::on_every_device([&](const gpu::Device& device) {
    const gpu::Queue queue(device);
    EXPECT_EQ(different_bits(on_device(queue, "multiply_then_add", n), expected), 0u);
  });
}

TEST(Arithmetic, SumsKeepTheirOrder) {
  Numbers n = random_numbers(65536, 2);
  std::vector<float> expected;
  for (size_t i = 0; i < n.a.size(); ++i)
    expected.push_back(n.a[i] * n.b[i] - (n.a[i] - n.c[i]) * (n.b[i] + n.c[i]) + n.c[i] * 0.1f);
  test::on_every_device([&](const gpu::Device& device) {
    const gpu::Queue queue(device);
    EXPECT_EQ(different_bits(on_device(queue, "sum_in_order", n), expected), 0u);
  });
}

}  // namespace
}  // namespace ream

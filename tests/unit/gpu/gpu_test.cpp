#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <numeric>

#include "core/error.hpp"
#include "gpu/binary_cache.hpp"
#include "gpu/program.hpp"
#include "support/temporary_folder.hpp"

namespace ream::gpu {
namespace {

// OpenCL (PoCL) is a requirement of the project: without a device these tests fail, they do not skip.

constexpr const char* doubling =
    "kernel void twice(global int* x, int n) { int i = get_global_id(0); if (i < n) x[i] *= 2; }";

std::string message_of(const std::function<void()>& action) {
  try {
    action();
  } catch (const Error& e) {
    return e.what();
  }
  return "no error";
}

TEST(Device, PoclGivesTheTickItsOwnThreadAndBulkWorkAllCores) {
  ASSERT_FALSE(list_devices().empty());
  EXPECT_TRUE(choose_device("auto", Use::tick).name.starts_with("basic"));
  EXPECT_TRUE(choose_device("opencl", Use::bulk).name.starts_with("pthread"));
}

TEST(Device, IsChosenByNumberAndName) {
  for (const Device& device : list_devices()) {
    EXPECT_EQ(choose_device("opencl:" + std::to_string(device.index), Use::tick).id, device.id);
    EXPECT_EQ(choose_device(device.name, Use::bulk).id, device.id);
  }
  EXPECT_TRUE(choose_device("BASIC", Use::bulk).name.starts_with("basic"));
}

TEST(Device, UnknownWishesAreUsageErrorsThatListTheDevices) {
  for (const char* name : {"opencl:99", "opencl:", "opencl:-1", "opencl:0x", "no such device", ""}) {
    try {
      choose_device(name, Use::tick);
      FAIL() << name;
    } catch (const Error& e) {
      EXPECT_EQ(e.kind(), ErrorKind::usage);
      EXPECT_NE(std::string(e.what()).find("opencl:0 is "), std::string::npos) << e.what();
    }
  }
}

TEST(Buffer, SharedArraysAreSeenByBothSidesWithoutCopies) {
  for (const Device& device : list_devices()) {
    const Queue queue(device);
    std::vector<int> host(1000);
    std::iota(host.begin(), host.end(), 0);
    Buffer buffer = Buffer::over(queue, std::span(host));
    EXPECT_EQ(buffer.shared(), queue.shares_host_memory());
    EXPECT_TRUE(buffer.shared() || !device.is_pocl);
    Kernel kernel(Program::from_source(queue, "doubling", doubling), "twice");
    kernel.set_all(buffer, 1000);
    kernel.enqueue(queue, 1000, 8);
    queue.finish();
    if (!buffer.shared()) buffer.read(queue, host.data(), buffer.bytes());
    for (int i = 0; i < 1000; ++i) ASSERT_EQ(host[static_cast<size_t>(i)], 2 * i);
  }
}

TEST(Buffer, ReadsWhatWasWrittenAndFilled) {
  const Queue queue(choose_device("auto", Use::bulk));
  Buffer buffer(queue, 64);
  buffer.fill(queue, 7);
  const uint8_t some[3] = {1, 2, 3};
  buffer.write(queue, some, 3, 10);
  std::vector<uint8_t> all(64);
  buffer.read(queue, all.data(), 64);
  EXPECT_EQ(all[9], 7);
  EXPECT_EQ(all[10], 1);
  EXPECT_EQ(all[12], 3);
  EXPECT_EQ(all[63], 7);
  EXPECT_NE(message_of([&] { buffer.write(queue, some, 3, 62); }).find("clEnqueueWriteBuffer"),
            std::string::npos);
  EXPECT_NE(message_of([&] { Buffer(queue, size_t{1} << 60); }).find("bytes is more than"),
            std::string::npos);
}

TEST(Program, ErrorsNameTheCallAndThePlace) {
  const Queue queue(choose_device("auto", Use::tick));
  const std::string bad =
      message_of([&] { Program::from_source(queue, "bad.cl", "kernel void f() { wrong; }"); });
  EXPECT_NE(bad.find("clBuildProgram"), std::string::npos) << bad;
  EXPECT_NE(bad.find("bad.cl"), std::string::npos) << bad;
  EXPECT_EQ(bad.find('\n'), std::string::npos) << bad;
  const Program program = Program::from_source(queue, "doubling", doubling);
  EXPECT_NE(message_of([&] { Kernel(program, "thrice"); }).find("thrice"), std::string::npos);
  Kernel kernel(program, "twice");
  EXPECT_NE(message_of([&] { kernel.set(1, 1.0); }).find("twice, argument 1"), std::string::npos);
  EXPECT_NE(message_of([&] { Program(queue, "nowhere.cl"); }).find("nowhere.cl"), std::string::npos);
}

TEST(KernelSource, IncludesAreResolvedOnce) {
  const std::string source = kernel_source("voxelizer.cl");
  EXPECT_EQ(source.find("#include \""), std::string::npos);
  const size_t first = source.find("#pragma OPENCL FP_CONTRACT OFF");
  ASSERT_NE(first, std::string::npos);
  EXPECT_EQ(source.find("#pragma OPENCL FP_CONTRACT OFF", first + 1), std::string::npos);
}

class BinaryCache : public ::testing::Test {
 protected:
  void SetUp() override { ::setenv("REAM_CACHE", folder_.path().c_str(), 1); }
  void TearDown() override { ::unsetenv("REAM_CACHE"); }
  std::filesystem::path only_file() const {
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder_.path()))
      if (entry.is_regular_file()) return entry.path();
    return {};
  }
  test::TemporaryFolder folder_;
};

TEST_F(BinaryCache, KeepsAProgramForTheNextRun) {
  const Queue queue(choose_device("auto", Use::tick));
  EXPECT_FALSE(Program::from_source(queue, "doubling", doubling).came_from_cache());
  const Program again = Program::from_source(queue, "doubling", doubling);
  EXPECT_TRUE(again.came_from_cache());
  EXPECT_FALSE(Program::from_source(queue, "doubling", doubling, "-D OTHER").came_from_cache());
  std::vector<int> host = {3, 4};
  Buffer buffer = Buffer::over(queue, std::span(host));
  Kernel kernel(again, "twice");
  kernel.set_all(buffer, 2);
  kernel.enqueue(queue, 2, 8);
  queue.finish();
  if (!buffer.shared()) buffer.read(queue, host.data(), buffer.bytes());
  EXPECT_EQ(host, (std::vector<int>{6, 8}));
}

TEST_F(BinaryCache, DamagedFilesAreBuiltAgain) {
  const std::vector<std::byte> binary(100, std::byte{5});
  store_binary("key", binary);
  ASSERT_EQ(load_binary("key"), binary);
  EXPECT_EQ(load_binary("another key"), std::nullopt);
  const auto path = only_file();
  std::filesystem::resize_file(path, std::filesystem::file_size(path) - 1);
  EXPECT_EQ(load_binary("key"), std::nullopt);
  store_binary("key", binary);
  std::fstream(path, std::ios::in | std::ios::out | std::ios::binary).seekp(60).put('x');
  EXPECT_EQ(load_binary("key"), std::nullopt);
  std::filesystem::resize_file(path, 3);
  EXPECT_EQ(load_binary("key"), std::nullopt);
}

TEST_F(BinaryCache, AFolderThatCannotBeWrittenIsNoError) {
  ::setenv("REAM_CACHE", "/dev/null/nowhere", 1);
  store_binary("key", {});
  EXPECT_EQ(load_binary("key"), std::nullopt);
}

}  // namespace
}  // namespace ream::gpu

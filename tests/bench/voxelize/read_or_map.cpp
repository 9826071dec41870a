#include "bench/voxelize/read_or_map.hpp"

#define CL_TARGET_OPENCL_VERSION 120
#include <CL/cl.h>

#include <algorithm>

#include "bench/text_table.hpp"
#include "core/clock.hpp"
#include "core/error.hpp"
#include "gpu/buffer.hpp"

namespace ream::bench {
namespace {

constexpr int read_rounds = 9;
constexpr double megabytes[] = {0.1, 1.0, 4.0, 10.0, 50.0, 190.0};

double median(std::vector<double> values) {
  std::nth_element(values.begin(), values.begin() + static_cast<ptrdiff_t>(values.size() / 2), values.end());
  return values[values.size() / 2];
}

double read_ms(const gpu::Queue& queue, const gpu::Buffer& buffer, std::vector<uint8_t>& host) {
  const auto start = SteadyClock::now();
  buffer.read(queue, host.data(), host.size());
  return elapsed_us(start) / 1000.0;
}

/// Mapped, and given back.
double map_ms(const gpu::Queue& queue, const gpu::Buffer& buffer) {
  const auto start = SteadyClock::now();
  cl_int status = CL_SUCCESS;
  void* mapped = clEnqueueMapBuffer(queue.handle(), buffer.handle(), CL_TRUE, CL_MAP_READ, 0, buffer.bytes(),
                                    0, nullptr, nullptr, &status);
  if (status != CL_SUCCESS) throw Error(ErrorKind::unavailable, "clEnqueueMapBuffer failed");
  clEnqueueUnmapMemObject(queue.handle(), buffer.handle(), mapped, 0, nullptr, nullptr);
  queue.finish();
  return elapsed_us(start) / 1000.0;
}

}  // namespace

std::vector<Row> read_or_map(const gpu::Queue& queue, std::ostream* tables) {
  TextTable table{
      "Figure 3.5: bringing voxels to the host (ms); in the thesis mapping always was the faster, the more "
      "so the more there was (plot without numbers)",
      "MB",
      {"read", "map", "read / map"},
      {}};
  std::vector<Row> rows;
  for (const double mb : megabytes) {
    const auto bytes = static_cast<size_t>(mb * 1e6);
    gpu::Buffer buffer(queue, bytes);
    buffer.fill(queue, 1);
    queue.finish();
    std::vector<uint8_t> host(bytes, 0);
    std::vector<double> read, map;
    for (int i = 0; i < read_rounds; ++i) {
      read.push_back(read_ms(queue, buffer, host));
      map.push_back(map_ms(queue, buffer));
    }
    const double r = median(read), m = median(map);
    char label[32];
    std::snprintf(label, sizeof label, "%.1f", mb);
    table.lines.push_back({label, {r, m, r / m}});
    rows.push_back({"voxelize", std::string("fig. 3.5, ") + label + " MB: map", m, r, "ms", 0.0});
  }
  table.print(tables, 4);
  return rows;
}

}  // namespace ream::bench

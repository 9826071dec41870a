#include "gpu/device.hpp"

#include <charconv>
#include <cstdlib>
#include <mutex>

#include "core/error.hpp"
#include "core/signal_handlers.hpp"
#include "core/text.hpp"
#include "gpu/check.hpp"

namespace ream::gpu {
namespace {

void ask_pocl_for_both_devices() {
  static std::once_flag once;
  std::call_once(once, [] { ::setenv("POCL_DEVICES", "basic pthread", 0); });
}

std::string text_of(cl_device_id id, cl_device_info what) {
  size_t size = 0;
  check(clGetDeviceInfo(id, what, 0, nullptr, &size), "clGetDeviceInfo");
  std::string text(size, '\0');
  check(clGetDeviceInfo(id, what, size, text.data(), nullptr), "clGetDeviceInfo");
  text.resize(text.find_last_not_of(std::string_view("\0 ", 2)) + 1);
  return text;
}

std::string text_of(cl_platform_id id, cl_platform_info what) {
  size_t size = 0;
  check(clGetPlatformInfo(id, what, 0, nullptr, &size), "clGetPlatformInfo");
  std::string text(size, '\0');
  check(clGetPlatformInfo(id, what, size, text.data(), nullptr), "clGetPlatformInfo");
  text.resize(text.find_last_not_of(std::string_view("\0 ", 2)) + 1);
  return text;
}

template <class Value>
Value value_of(cl_device_id id, cl_device_info what) {
  Value value{};
  check(clGetDeviceInfo(id, what, sizeof value, &value, nullptr), "clGetDeviceInfo");
  return value;
}

void append_devices(cl_platform_id platform, std::vector<Device>& devices) {
  cl_uint count = 0;
  if (clGetDeviceIDs(platform, CL_DEVICE_TYPE_ALL, 0, nullptr, &count) != CL_SUCCESS || count == 0) return;
  std::vector<cl_device_id> ids(count);
  check(clGetDeviceIDs(platform, CL_DEVICE_TYPE_ALL, count, ids.data(), nullptr), "clGetDeviceIDs");
  const std::string platform_name = text_of(platform, CL_PLATFORM_NAME);
  for (const cl_device_id id : ids) {
    if (!value_of<cl_bool>(id, CL_DEVICE_AVAILABLE) || !value_of<cl_bool>(id, CL_DEVICE_COMPILER_AVAILABLE))
      continue;
    Device device;
    device.id = id;
    device.index = static_cast<int>(devices.size());
    device.name = text_of(id, CL_DEVICE_NAME);
    device.platform = platform_name;
    device.driver = text_of(id, CL_DEVICE_VERSION) + " " + text_of(id, CL_DRIVER_VERSION);
    device.is_cpu = (value_of<cl_device_type>(id, CL_DEVICE_TYPE) & CL_DEVICE_TYPE_CPU) != 0;
    device.may_share_host_memory = device.is_cpu;
    device.is_pocl = platform_name == "Portable Computing Language";
    device.knows_doubles = value_of<cl_device_fp_config>(id, CL_DEVICE_DOUBLE_FP_CONFIG) != 0;
    device.keeps_small_floats =
        (value_of<cl_device_fp_config>(id, CL_DEVICE_SINGLE_FP_CONFIG) & CL_FP_DENORM) != 0;
    device.memory_bytes = value_of<cl_ulong>(id, CL_DEVICE_GLOBAL_MEM_SIZE);
    device.max_buffer_bytes = value_of<cl_ulong>(id, CL_DEVICE_MAX_MEM_ALLOC_SIZE);
    device.max_local_size = value_of<size_t>(id, CL_DEVICE_MAX_WORK_GROUP_SIZE);
    devices.push_back(std::move(device));
  }
}

std::string listing(const std::vector<Device>& devices) {
  std::string text;
  for (const Device& d : devices)
    text += (text.empty() ? "" : ", ") + ("opencl:" + std::to_string(d.index)) + " is " + d.name;
  return text;
}

const Device& preferred(const std::vector<Device>& devices, Use use) {
  const std::string_view prefix = use == Use::tick ? "basic" : "pthread";
  const Device* best = &devices.front();
  for (const Device& d : devices) {
    if (d.is_pocl && d.name.starts_with(prefix)) return d;
    if (d.is_pocl && !best->is_pocl) best = &d;
  }
  return *best;
}

}  // namespace

std::vector<Device> list_devices() {
  ask_pocl_for_both_devices();
  cl_uint count = 0;
  if (clGetPlatformIDs(0, nullptr, &count) != CL_SUCCESS || count == 0) return {};
  std::vector<cl_platform_id> platforms(count);
  check(clGetPlatformIDs(count, platforms.data(), nullptr), "clGetPlatformIDs");
  std::vector<Device> devices;
  for (const cl_platform_id platform : platforms) append_devices(platform, devices);
  restore_handlers();  // PoCL has put one of its own in the place of ours
  return devices;
}

Device choose_device(std::string_view name, Use use) {
  const std::vector<Device> devices = list_devices();
  if (devices.empty())
    throw Error(ErrorKind::unavailable,
                "no OpenCL device: install pocl-opencl-icd or a GPU's driver, or use --backend cpu");
  if (name == "auto" || name == "opencl") return preferred(devices, use);
  if (name.starts_with("opencl:")) {
    const std::string_view number = name.substr(7);
    size_t index = 0;
    const auto [end, failed] = std::from_chars(number.data(), number.data() + number.size(), index);
    if (failed == std::errc{} && end == number.data() + number.size() && index < devices.size())
      return devices[index];
  } else if (!name.empty()) {
    for (const Device& d : devices)
      if (lower(d.name + " " + d.platform).find(lower(name)) != std::string::npos) return d;
  }
  throw Error(ErrorKind::usage, "no OpenCL device '" + std::string(name) + "'; " + listing(devices));
}

}  // namespace ream::gpu

#include "gpu/program.hpp"

#include <set>
#include <vector>

#include "core/error.hpp"
#include "core/signal_handlers.hpp"
#include "gpu/binary_cache.hpp"
#include "gpu/check.hpp"
#include "ream_embedded_kernels.hpp"

namespace ream::gpu {
namespace {

void append_file(std::string_view name, std::set<std::string, std::less<>>& done, std::string& source) {
  if (!done.emplace(name).second) return;
  std::string_view text = embedded::ream_embedded_kernels::find(name);
  if (text.empty())
    throw Error(ErrorKind::not_found, "no kernel file '" + std::string(name) + "' in this program");
  constexpr std::string_view include = "#include \"";
  while (!text.empty()) {
    const size_t end = text.find('\n');
    const std::string_view line = text.substr(0, end);
    if (line.starts_with(include))
      append_file(line.substr(include.size(), line.rfind('"') - include.size()), done, source);
    else
      source.append(line).append("\n");
    text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
  }
}

}  // namespace

std::string kernel_source(std::string_view file_name) {
  std::set<std::string, std::less<>> done;
  std::string source;
  append_file(file_name, done, source);
  return source;
}

namespace {

std::string first_complaint(cl_program program, cl_device_id device) {
  size_t size = 0;
  clGetProgramBuildInfo(program, device, CL_PROGRAM_BUILD_LOG, 0, nullptr, &size);
  std::string log(size, '\0');
  clGetProgramBuildInfo(program, device, CL_PROGRAM_BUILD_LOG, size, log.data(), nullptr);
  const size_t error = log.find("error");
  const size_t start = error == std::string::npos ? 0 : log.rfind('\n', error) + 1;
  std::string line = log.substr(start, log.find('\n', start) - start);
  line.resize(line.find_last_not_of(std::string_view("\0 \r", 3)) + 1);
  return line;
}

std::vector<std::byte> binary_of(cl_program program) {
  size_t size = 0;
  if (clGetProgramInfo(program, CL_PROGRAM_BINARY_SIZES, sizeof size, &size, nullptr) != CL_SUCCESS)
    return {};
  std::vector<std::byte> binary(size);
  unsigned char* pointer = reinterpret_cast<unsigned char*>(binary.data());
  if (clGetProgramInfo(program, CL_PROGRAM_BINARIES, sizeof pointer, &pointer, nullptr) != CL_SUCCESS)
    return {};
  return binary;
}

/// A program from a cached binary, or null when the driver does not take it any more.
Handle<_cl_program> from_binary(const Queue& queue, const std::vector<std::byte>& binary,
                                const std::string& options) {
  const cl_device_id device = queue.device().id;
  const size_t size = binary.size();
  const unsigned char* pointer = reinterpret_cast<const unsigned char*>(binary.data());
  cl_int binary_status = CL_SUCCESS, status = CL_SUCCESS;
  Handle<_cl_program> program(
      clCreateProgramWithBinary(queue.context(), 1, &device, &size, &pointer, &binary_status, &status));
  if (status != CL_SUCCESS || binary_status != CL_SUCCESS) return nullptr;
  if (clBuildProgram(program.get(), 1, &device, options.c_str(), nullptr, nullptr) != CL_SUCCESS)
    return nullptr;
  return program;
}

/// A driver's compiler may put signal handlers of its own in the place of ours.
struct HandlersBack {
  ~HandlersBack() { restore_handlers(); }
};

}  // namespace

Program::Program(const Queue& queue, std::string_view file_name, const std::string& options) {
  build(queue, std::string(file_name), kernel_source(file_name), options);
}

Program Program::from_source(const Queue& queue, const std::string& name, const std::string& source,
                             const std::string& options) {
  Program program;
  program.build(queue, name, source, options);
  return program;
}

void Program::build(const Queue& queue, const std::string& name, const std::string& source,
                    const std::string& extra_options) {
  const HandlersBack handlers_back;
  const Device& device = queue.device();
  const std::string options = "-cl-std=CL1.2" + (extra_options.empty() ? "" : " " + extra_options);
  const std::string key =
      device.platform + '\n' + device.name + '\n' + device.driver + '\n' + options + '\n' + source;
  if (const auto binary = load_binary(key)) {
    program_ = from_binary(queue, *binary, options);
    came_from_cache_ = program_ != nullptr;
    if (came_from_cache_) return;
  }
  const char* text = source.c_str();
  const size_t length = source.size();
  cl_int status = CL_SUCCESS;
  program_.reset(clCreateProgramWithSource(queue.context(), 1, &text, &length, &status));
  check(status, "clCreateProgramWithSource", name);
  status = clBuildProgram(program_.get(), 1, &device.id, options.c_str(), nullptr, nullptr);
  if (status == CL_BUILD_PROGRAM_FAILURE)
    check(status, "clBuildProgram",
          name + " on " + device.name + ": " + first_complaint(program_.get(), device.id));
  check(status, "clBuildProgram", name + " on " + device.name);
  if (const std::vector<std::byte> binary = binary_of(program_.get()); !binary.empty())
    store_binary(key, binary);
}

Kernel::Kernel(const Program& program, const std::string& name) : name_(name) {
  cl_int status = CL_SUCCESS;
  kernel_.reset(clCreateKernel(program.handle(), name.c_str(), &status));
  check(status, "clCreateKernel", name);
}

void Kernel::set(unsigned index, const Buffer& buffer) {
  cl_mem memory = buffer.handle();
  set_bytes(index, &memory, sizeof memory);
}

void Kernel::set_bytes(unsigned index, const void* value, size_t bytes) {
  const cl_int status = clSetKernelArg(kernel_.get(), index, bytes, value);
  if (status != CL_SUCCESS) check(status, "clSetKernelArg", name_ + ", argument " + std::to_string(index));
}

void Kernel::enqueue(const Queue& queue, size_t global, size_t local, size_t rows) const {
  if (global == 0 || rows == 0) return;
  ++queue.traffic().launches;
  const size_t whole[2] = {(global + local - 1) / local * local, rows}, groups_of[2] = {local, 1};
  const cl_uint dimensions = rows == 1 ? 1 : 2;
  const cl_int status = clEnqueueNDRangeKernel(queue.handle(), kernel_.get(), dimensions, nullptr, whole,
                                               groups_of, 0, nullptr, nullptr);
  if (status != CL_SUCCESS) check(status, "clEnqueueNDRangeKernel", name_);
}

}  // namespace ream::gpu

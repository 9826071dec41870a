#pragma once
#include <cstddef>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "gpu/buffer.hpp"

namespace ream::gpu {

/// A kernel file of kernels/ built for a queue's device, taken from the binary cache when it was built
/// before. Built without any unsafe arithmetic option, so that results are the same bits on every device.
/// Signal handlers that the driver's compiler has installed meanwhile have gone again (restore_handlers).
class Program {
 public:
  /// `file_name` as in kernels/, `options` e.g. "-D RADIUS=3". Throws Error not_found for an unknown file and
  /// unavailable, with the compiler's first complaint, for a build that fails.
  Program(const Queue& queue, std::string_view file_name, const std::string& options = {});
  /// The same from source text; `name` is for error messages.
  static Program from_source(const Queue& queue, const std::string& name, const std::string& source,
                             const std::string& options = {});

  bool came_from_cache() const { return came_from_cache_; }
  _cl_program* handle() const { return program_.get(); }

 private:
  Program() = default;
  void build(const Queue& queue, const std::string& name, const std::string& source,
             const std::string& options);

  Handle<_cl_program> program_;
  bool came_from_cache_ = false;
};

/// One kernel with its arguments. PoCL compiles a kernel once more at the first enqueue of every local size
/// (tens of ms): enqueue each shape once, with arguments that do nothing, before the loop starts.
class Kernel {
 public:
  /// Throws Error unavailable when the program has no such kernel.
  Kernel(const Program& program, const std::string& name);

  /// Arguments 0, 1, 2, ...: buffers, vectors of buffers (an argument each), or plain values of exactly the
  /// kernel's types.
  template <class... Arguments>
  void set_all(const Arguments&... arguments) {
    unsigned index = 0;
    (set_next(index, arguments), ...);
  }
  void set(unsigned index, const Buffer& buffer);
  template <class Value>
  void set(unsigned index, const Value& value) {
    static_assert(std::is_trivially_copyable_v<Value>);
    set_bytes(index, &value, sizeof value);
  }

  /// Enqueues ceil(global / local) work-groups, `rows` times along the second dimension; the kernel itself
  /// ignores items beyond its count.
  void enqueue(const Queue& queue, size_t global, size_t local, size_t rows = 1) const;

  const std::string& name() const { return name_; }

 private:
  template <class Argument>
  void set_next(unsigned& index, const Argument& argument) {
    set(index++, argument);
  }
  void set_next(unsigned& index, const std::vector<Buffer>& buffers) {
    for (const Buffer& buffer : buffers) set(index++, buffer);
  }
  void set_bytes(unsigned index, const void* value, size_t bytes);

  std::string name_;
  Handle<_cl_kernel> kernel_;
};

/// Source of an embedded kernel file of kernels/, its #include "..." lines replaced by the embedded files
/// they name, each once. Throws Error not_found naming the file that is not embedded.
std::string kernel_source(std::string_view file_name);

}  // namespace ream::gpu

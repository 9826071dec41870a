#include "tables/hdf5_file.hpp"

#include <dlfcn.h>
#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <exception>
#include <new>

#include "core/atomic_file.hpp"
#include "core/error.hpp"
#include "core/file_descriptor.hpp"
#include "isolation/isolated_job.hpp"

namespace ream::tables {
namespace {

/// Stays loaded: what HDF5 has set up is not taken back.
MakeHdf5Writer* load_maker() {
  const std::filesystem::path library = isolation::helper_program(hdf5_library_name);
  void* const loaded = ::dlopen(library.c_str(), RTLD_NOW | RTLD_LOCAL);
  void* const maker = loaded == nullptr ? nullptr : ::dlsym(loaded, hdf5_maker_name);
  if (maker == nullptr) {
    const char* const why = ::dlerror();
    throw Error(ErrorKind::unavailable,
                "HDF5 files cannot be written: " + std::string(why == nullptr ? "unknown" : why) +
                    "; install ream again, with libhdf5");
  }
  return reinterpret_cast<MakeHdf5Writer*>(maker);
}

MakeHdf5Writer* maker() {
  static MakeHdf5Writer* const loaded = load_maker();
  return loaded;
}

}  // namespace

class Hdf5File::Storage final : public Hdf5Storage {
 public:
  explicit Storage(const std::filesystem::path& path) : file_(path), path_(path) {
    reading_ = FileDescriptor(::open(file_.path().c_str(), O_RDONLY | O_CLOEXEC));
    if (!reading_) throw cannot("write");
  }

  /// After a failure HDF5 goes on as if all were well, and is closed in order; check() then tells.
  void write_at(uint64_t offset, std::span<const std::byte> bytes) noexcept override {
    attempt([&] { file_.write_at(offset, bytes); });
  }
  void read_at(uint64_t offset, std::span<std::byte> bytes) noexcept override {
    std::fill(bytes.begin(), bytes.end(), std::byte{0});  // where nothing has been written
    attempt([&] {
      if (reading_.read_at(offset, bytes) < 0) throw cannot("read");
    });
  }
  void resize(uint64_t bytes) noexcept override {
    attempt([&] {
      if (::truncate(file_.path().c_str(), static_cast<off_t>(bytes)) != 0) throw cannot("write");
    });
  }

  void check() const {
    if (failure_) std::rethrow_exception(failure_);
  }
  void commit() { file_.commit(); }

 private:
  Error cannot(const char* act) const {
    return {ErrorKind::io, std::string("cannot ") + act + " " + path_.string() + ": " + std::strerror(errno)};
  }
  template <typename Work>
  void attempt(Work&& work) noexcept {
    if (failure_) return;
    try {
      work();
    } catch (...) {
      failure_ = std::current_exception();
    }
  }

  AtomicFile file_;
  const std::filesystem::path path_;
  FileDescriptor reading_;
  std::exception_ptr failure_;
};

/// The disk's own failure before what HDF5 makes of it.
template <typename Work>
void Hdf5File::checked(Work&& work) {
  try {
    work();
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& e) {
    storage_->check();
    throw Error(ErrorKind::io, "cannot write " + path_.string() + ": " + e.what());
  }
  storage_->check();
}

Hdf5File::Hdf5File(const std::filesystem::path& path) : path_(path) {
  MakeHdf5Writer* const make = maker();
  storage_ = std::make_unique<Storage>(path);
  checked([&] { writer_.reset(make(*storage_)); });
}

Hdf5File::~Hdf5File() = default;

void Hdf5File::add_group(const std::string& path) {
  checked([&] { writer_->add_group(path); });
}

void Hdf5File::set(const std::string& path, const std::string& name, const Hdf5Value& value) {
  checked([&] { writer_->set(path, name, value); });
}

void Hdf5File::add_number(const std::string& path, double value) {
  checked([&] { writer_->add_number(path, value); });
}

size_t Hdf5File::add(const std::string& path, const Hdf5Shape& shape) {
  size_t made = 0;
  checked([&] { made = writer_->add(path, shape); });
  return made;
}

void Hdf5File::write(size_t data_set, std::span<const uint64_t> at, std::span<const uint64_t> sizes,
                     std::span<const std::byte> values) {
  checked([&] { writer_->write(data_set, at, sizes, values); });
}

void Hdf5File::close() {
  checked([&] { writer_->close(); });
}

void Hdf5File::commit() {
  close();
  storage_->commit();
}

}  // namespace ream::tables

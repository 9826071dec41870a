#pragma once
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <variant>
#include <vector>

namespace ream::tables {

/// Numbers with a shape, the last index fastest.
struct Hdf5Array {
  std::vector<double> values;
  std::vector<uint64_t> shape;  ///< empty: a single one
};
/// Of an attribute. Text is UTF-8.
using Hdf5Value = std::variant<std::string, double, int64_t, uint64_t, Hdf5Array>;

enum class Hdf5Type { f64, i64, u8 };

/// Shape of a data set that is cut into chunks, which are compressed (shuffle and deflate).
struct Hdf5Shape {
  Hdf5Type type;
  std::vector<uint64_t> sizes, chunk;  ///< one for each index, the last one fastest
};

/// Where the bytes of an HDF5 file go. No function throws: what fails is remembered by who made it.
class Hdf5Storage {
 public:
  virtual ~Hdf5Storage() = default;
  virtual void write_at(uint64_t offset, std::span<const std::byte> bytes) noexcept = 0;
  virtual void read_at(uint64_t offset, std::span<std::byte> bytes) noexcept = 0;
  virtual void resize(uint64_t bytes) noexcept = 0;
};

/// What the library ream-hdf5 does. Every function throws std::runtime_error with the words of HDF5.
/// Different objects may be used by different threads.
class Hdf5Writer {
 public:
  virtual ~Hdf5Writer() = default;
  /// Groups on the way to `path` ("/a/b") are made.
  virtual void add_group(const std::string& path) = 0;
  /// Of a group or data set; "/" is the file's.
  virtual void set(const std::string& path, const std::string& name, const Hdf5Value& value) = 0;
  /// A single number.
  virtual void add_number(const std::string& path, double value) = 0;
  /// Returns what write() knows it by.
  virtual size_t add(const std::string& path, const Hdf5Shape& shape) = 0;
  /// A block that begins at `at`, of `sizes`; whole chunks are quickest. `values` in the type of the data
  /// set.
  virtual void write(size_t data_set, std::span<const uint64_t> at, std::span<const uint64_t> sizes,
                     std::span<const std::byte> values) = 0;
  virtual void close() = 0;
};

/// Of the library ream-hdf5; `storage` outlives what it makes.
using MakeHdf5Writer = Hdf5Writer*(Hdf5Storage& storage);
inline constexpr const char *hdf5_library_name = "libream-hdf5.so",
                            *hdf5_maker_name = "ream_make_hdf5_writer";

/// An HDF5 file (HDF5 1.8 and later read it) under a temporary name, which commit() gives its own; the same
/// content makes the same bytes. HDF5 does not see that a disk is full: that is told as for other files. It
/// may end the process where it lacks a small piece of memory. Functions throw Error io.
class Hdf5File final : public Hdf5Writer {
 public:
  /// Errors: io; unavailable where the library ream-hdf5 cannot be loaded.
  explicit Hdf5File(const std::filesystem::path& path);
  ~Hdf5File() override;

  void add_group(const std::string& path) override;
  void set(const std::string& path, const std::string& name, const Hdf5Value& value) override;
  void add_number(const std::string& path, double value) override;
  size_t add(const std::string& path, const Hdf5Shape& shape) override;
  void write(size_t data_set, std::span<const uint64_t> at, std::span<const uint64_t> sizes,
             std::span<const std::byte> values) override;
  void close() override;
  /// close(), and the final name.
  void commit();

 private:
  class Storage;
  template <typename Work>
  void checked(Work&& work);

  const std::filesystem::path path_;
  std::unique_ptr<Storage> storage_;
  std::unique_ptr<Hdf5Writer> writer_;
};

}  // namespace ream::tables

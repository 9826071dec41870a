// The library ream-hdf5: the only file that knows HDF5 (its C API, 1.10). hdf5_file.cpp loads it.
#include <hdf5.h>

#include <algorithm>
#include <mutex>
#include <new>
#include <optional>
#include <stdexcept>
#include <utility>

#include "tables/hdf5_file.hpp"

namespace ream::tables {
namespace {

constexpr unsigned deflate_level = 1;  // higher ones save a tenth and take three times as long
constexpr hsize_t metadata_block_bytes = 65536;

/// Debian's HDF5 is for one thread at a time.
std::mutex one_at_a_time;

/// What HDF5 says of the innermost failure.
std::string last_words() {
  std::string words;
  const auto take = [](unsigned number, const H5E_error2_t* error, void* to) -> herr_t {
    if (number == 0 && error->desc != nullptr) *static_cast<std::string*>(to) = error->desc;
    return 0;
  };
  H5Ewalk2(H5E_DEFAULT, H5E_WALK_UPWARD, take, &words);
  return "HDF5: " + (words.empty() ? "failed" : words);
}

/// Whatever HDF5 returns, where it is no failure.
template <typename Result>
Result checked(Result result) {
  if (result < 0) throw std::runtime_error(last_words());
  return result;
}

/// A thing of HDF5's that is released with its owner.
class Handle {
 public:
  explicit Handle(hid_t id) : id_(checked(id)) {}
  Handle(Handle&& other) noexcept : id_(std::exchange(other.id_, H5I_INVALID_HID)) {}
  Handle& operator=(Handle&&) = delete;
  ~Handle() {
    if (id_ >= 0) H5Idec_ref(id_);
  }
  operator hid_t() const { return id_; }  // NOLINT: goes where HDF5 wants one

 private:
  hid_t id_;
};

/// HDF5's driver for an Hdf5Storage: an open file.
struct OpenStorage {
  H5FD_t common;  ///< first, as HDF5 wants it
  Hdf5Storage* storage;
  haddr_t allocated, written;
};

/// What a file's access properties say of it.
struct ChosenStorage {
  Hdf5Storage* storage;
};

OpenStorage* storage_of(H5FD_t* file) { return reinterpret_cast<OpenStorage*>(file); }
const OpenStorage* storage_of(const H5FD_t* file) { return reinterpret_cast<const OpenStorage*>(file); }

H5FD_t* open_storage(const char*, unsigned, hid_t access, haddr_t) {
  const void* const chosen = H5Pget_driver_info(access);
  auto* const file = chosen == nullptr ? nullptr : new (std::nothrow) OpenStorage{};
  if (file == nullptr) return nullptr;
  file->storage = static_cast<const ChosenStorage*>(chosen)->storage;
  return &file->common;
}

herr_t close_storage(H5FD_t* file) {
  delete storage_of(file);
  return 0;
}

/// No two files of this driver are the same: HDF5 is asked for new ones only.
int compare_storages(const H5FD_t* one, const H5FD_t* other) { return one < other ? -1 : one > other; }

herr_t storage_features(const H5FD_t*, unsigned long* features) {
  *features = H5FD_FEAT_AGGREGATE_METADATA | H5FD_FEAT_ACCUMULATE_METADATA | H5FD_FEAT_AGGREGATE_SMALLDATA;
  return 0;
}

haddr_t allocated_bytes(const H5FD_t* file, H5FD_mem_t) { return storage_of(file)->allocated; }

herr_t set_allocated_bytes(H5FD_t* file, H5FD_mem_t, haddr_t bytes) {
  storage_of(file)->allocated = bytes;
  return 0;
}

haddr_t written_bytes(const H5FD_t* file, H5FD_mem_t) { return storage_of(file)->written; }

herr_t read_storage(H5FD_t* file, H5FD_mem_t, hid_t, haddr_t at, size_t size, void* into) {
  storage_of(file)->storage->read_at(at, {static_cast<std::byte*>(into), size});
  return 0;
}

herr_t write_storage(H5FD_t* file, H5FD_mem_t, hid_t, haddr_t at, size_t size, const void* from) {
  OpenStorage& open = *storage_of(file);
  open.storage->write_at(at, {static_cast<const std::byte*>(from), size});
  open.written = std::max<haddr_t>(open.written, at + size);
  return 0;
}

/// What is allocated at the end and never written belongs to the file, too.
herr_t truncate_storage(H5FD_t* file, hid_t, hbool_t) {
  OpenStorage& open = *storage_of(file);
  if (open.written != open.allocated) open.storage->resize(open.allocated);
  open.written = open.allocated;
  return 0;
}

hid_t storage_driver() {
  static const hid_t registered = [] {
    static H5FD_class_t driver{};
    driver.name = "ream";
    driver.maxaddr = HADDR_MAX >> 1;
    driver.fc_degree = H5F_CLOSE_STRONG;
    driver.fapl_size = sizeof(ChosenStorage);
    driver.open = open_storage;
    driver.close = close_storage;
    driver.cmp = compare_storages;
    driver.query = storage_features;
    driver.get_eoa = allocated_bytes;
    driver.set_eoa = set_allocated_bytes;
    driver.get_eof = written_bytes;
    driver.read = read_storage;
    driver.write = write_storage;
    driver.truncate = truncate_storage;
    const H5FD_mem_t places[] = H5FD_FLMAP_DICHOTOMY;
    std::copy(std::begin(places), std::end(places), driver.fl_map);
    return checked(H5FDregister(&driver));
  }();
  return registered;
}

hid_t number_type(Hdf5Type type) {
  switch (type) {
    case Hdf5Type::f64: return H5T_IEEE_F64LE;
    case Hdf5Type::i64: return H5T_STD_I64LE;
    case Hdf5Type::u8: break;
  }
  return H5T_STD_U8LE;
}

std::vector<hsize_t> sizes_of(std::span<const uint64_t> sizes) { return {sizes.begin(), sizes.end()}; }

/// `chunk`: of a data set in chunks, which may not be larger than that can become.
Handle space_of(std::span<const uint64_t> sizes, std::span<const uint64_t> chunk = {}) {
  if (sizes.empty()) return Handle(H5Screate(H5S_SCALAR));
  std::vector<hsize_t> most = sizes_of(sizes);
  for (size_t i = 0; i < chunk.size(); ++i) most[i] = std::max<hsize_t>(most[i], chunk[i]);
  return Handle(H5Screate_simple(static_cast<int>(sizes.size()), sizes_of(sizes).data(), most.data()));
}

/// Of objects: without the time at which they were made.
Handle creation_of(hid_t kind) {
  Handle creation(H5Pcreate(kind));
  checked(H5Pset_obj_track_times(creation, false));
  return creation;
}

Handle making_groups_on_the_way() {
  Handle links(H5Pcreate(H5P_LINK_CREATE));
  checked(H5Pset_create_intermediate_group(links, 1));
  return links;
}

class Writer final : public Hdf5Writer {
 public:
  explicit Writer(Hdf5Storage& storage) {
    const std::scoped_lock lock(one_at_a_time);
    const Handle access(H5Pcreate(H5P_FILE_ACCESS)), creation = creation_of(H5P_FILE_CREATE);
    const ChosenStorage chosen{&storage};
    checked(H5Pset_driver(access, storage_driver(), &chosen));
    checked(H5Pset_meta_block_size(access, metadata_block_bytes));
    file_ = checked(H5Fcreate("ream", H5F_ACC_TRUNC, creation, access));
  }
  ~Writer() override {
    const std::scoped_lock lock(one_at_a_time);
    data_sets_.clear();
    if (file_ >= 0) H5Fclose(file_);
  }

  void add_group(const std::string& path) override {
    const std::scoped_lock lock(one_at_a_time);
    const Handle links = making_groups_on_the_way(), creation = creation_of(H5P_GROUP_CREATE);
    const Handle group(H5Gcreate2(file_, path.c_str(), links, creation, H5P_DEFAULT));
  }

  void set(const std::string& path, const std::string& name, const Hdf5Value& value) override {
    const std::scoped_lock lock(one_at_a_time);
    const Handle owner(H5Oopen(file_, path.c_str(), H5P_DEFAULT));
    std::visit([&](const auto& one) { set_value(owner, name, one); }, value);
  }

  void add_number(const std::string& path, double value) override {
    const std::scoped_lock lock(one_at_a_time);
    const Handle data_set = made(path, H5T_IEEE_F64LE, space_of({}), creation_of(H5P_DATASET_CREATE), {});
    checked(H5Dwrite(data_set, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, &value));
  }

  size_t add(const std::string& path, const Hdf5Shape& shape) override {
    const std::scoped_lock lock(one_at_a_time);
    const Handle creation = creation_of(H5P_DATASET_CREATE);
    checked(H5Pset_chunk(creation, static_cast<int>(shape.chunk.size()), sizes_of(shape.chunk).data()));
    // Mandatory: for want of memory a chunk would else be left as it is, and the file have other bytes.
    if (shape.type != Hdf5Type::u8)
      checked(H5Pset_filter(creation, H5Z_FILTER_SHUFFLE, H5Z_FLAG_MANDATORY, 0, nullptr));
    checked(H5Pset_filter(creation, H5Z_FILTER_DEFLATE, H5Z_FLAG_MANDATORY, 1, &deflate_level));
    const Handle access(H5Pcreate(H5P_DATASET_ACCESS));
    // Whole chunks are written as they come; none waits for more.
    checked(H5Pset_chunk_cache(access, 0, 0, 1.0));
    data_sets_.push_back(
        made(path, number_type(shape.type), space_of(shape.sizes, shape.chunk), creation, access));
    types_.push_back(number_type(shape.type));
    return data_sets_.size() - 1;
  }

  void write(size_t data_set, std::span<const uint64_t> at, std::span<const uint64_t> sizes,
             std::span<const std::byte> values) override {
    const std::scoped_lock lock(one_at_a_time);
    const Handle in_memory = space_of(sizes), in_file(H5Dget_space(data_sets_.at(data_set)));
    checked(H5Sselect_hyperslab(in_file, H5S_SELECT_SET, sizes_of(at).data(), nullptr, sizes_of(sizes).data(),
                                nullptr));
    checked(H5Dwrite(data_sets_.at(data_set), types_.at(data_set), in_memory, in_file, H5P_DEFAULT,
                     values.data()));
  }

  void close() override {
    const std::scoped_lock lock(one_at_a_time);
    data_sets_.clear();
    checked(H5Fclose(std::exchange(file_, H5I_INVALID_HID)));
  }

 private:
  Handle made(const std::string& path, hid_t type, const Handle& space, const Handle& creation,
              std::optional<hid_t> access) {
    return Handle(H5Dcreate2(file_, path.c_str(), type, space, making_groups_on_the_way(), creation,
                             access.value_or(H5P_DEFAULT)));
  }

  static void put(hid_t owner, const std::string& name, hid_t type, const Handle& space, const void* value) {
    const Handle attribute(H5Acreate2(owner, name.c_str(), type, space, H5P_DEFAULT, H5P_DEFAULT));
    checked(H5Awrite(attribute, type, value));
  }
  /// Of any length: the words lie in the file's heap, as h5py puts them.
  static void set_value(hid_t owner, const std::string& name, const std::string& value) {
    const Handle type(H5Tcopy(H5T_C_S1));
    checked(H5Tset_size(type, H5T_VARIABLE));
    checked(H5Tset_cset(type, H5T_CSET_UTF8));
    const char* const words = value.c_str();
    put(owner, name, type, space_of({}), &words);
  }
  static void set_value(hid_t owner, const std::string& name, double value) {
    put(owner, name, H5T_IEEE_F64LE, space_of({}), &value);
  }
  static void set_value(hid_t owner, const std::string& name, int64_t value) {
    put(owner, name, H5T_STD_I64LE, space_of({}), &value);
  }
  static void set_value(hid_t owner, const std::string& name, uint64_t value) {
    put(owner, name, H5T_STD_U64LE, space_of({}), &value);
  }
  static void set_value(hid_t owner, const std::string& name, const Hdf5Array& value) {
    put(owner, name, H5T_IEEE_F64LE, space_of(value.shape), value.values.data());
  }

  hid_t file_ = H5I_INVALID_HID;
  std::vector<Handle> data_sets_;
  std::vector<hid_t> types_;
};

/// Errors are told by exceptions, not on stderr; and what is open at the end of the process stays so.
void set_up() {
  static const bool done = [] {
    H5dont_atexit();
    checked(H5open());
    checked(H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr));
    return true;
  }();
  static_cast<void>(done);
}

}  // namespace
}  // namespace ream::tables

extern "C" ream::tables::Hdf5Writer* ream_make_hdf5_writer(ream::tables::Hdf5Storage& storage) {
  {
    const std::scoped_lock lock(ream::tables::one_at_a_time);
    ream::tables::set_up();
  }
  return new ream::tables::Writer(storage);
}

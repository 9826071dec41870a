#include "bench/hostile/hostile_files.hpp"

#include <zlib.h>

#include <algorithm>
#include <cstring>
#include <fstream>

#include "core/error.hpp"
#include "core/file.hpp"
#include "ct/read/write_volume.hpp"
#include "store/zip_archive.hpp"

namespace ream::bench {
namespace fs = std::filesystem;
namespace {

constexpr int seed_side = 10, secret_side = 8;
constexpr int16_t secret_value = 1234;
constexpr size_t secret_run = 16;  // as many in a row are no chance
constexpr uint64_t bomb_bytes = uint64_t{600} << 20;

ct::HuVolume small_volume() {
  ct::HuVolume volume;
  volume.dims = {seed_side, seed_side, seed_side};
  volume.spacing_mm = {0.7, 0.8, 1.25};
  for (size_t i = 0; i < volume.voxel_count(); ++i) volume.hu.push_back(static_cast<int16_t>(i % 900) - 300);
  return volume;
}

std::string text_rows() {
  std::string rows;
  for (int i = 0; i < seed_side * seed_side * seed_side; ++i)
    rows += std::to_string(i % seed_side) + ' ' + std::to_string(i / seed_side % seed_side) + ' ' +
            std::to_string(i / seed_side / seed_side) + ' ' + std::to_string(i % 300) + '\n';
  return rows;
}

std::string nrrd_header(const std::string& sizes, const std::string& more) {
  return "NRRD0004\ntype: short\ndimension: 3\nspace: left-posterior-superior\nsizes: " + sizes +
         "\nspace directions: (1,0,0) (0,1,0) (0,0,1)\nspace origin: (0,0,0)\nendian: little\n" + more +
         "\n\n";
}

std::string meta_header(const std::string& sizes, const std::string& more) {
  return "ObjectType = Image\nNDims = 3\nBinaryData = True\nBinaryDataByteOrderMSB = False\n"
         "TransformMatrix = 1 0 0 0 1 0 0 0 1\nOffset = 0 0 0\nElementSpacing = 1 1 1\nDimSize = " +
         sizes + "\nElementType = MET_SHORT\n" + more + "\n";
}

/// A NIfTI-1 header for sides^3 voxels of 16 bits.
std::string nifti_header(int16_t side) {
  std::string header(352, '\0');
  const auto put = [&](size_t at, auto value) { std::memcpy(header.data() + at, &value, sizeof value); };
  put(0, int32_t{348});
  put(40, int16_t{3});
  for (const size_t at : {42, 44, 46}) put(at, side);
  for (const size_t at : {48, 50, 52, 54}) put(at, int16_t{1});
  put(70, int16_t{4});
  put(72, int16_t{16});
  for (const size_t at : {76, 80, 84, 88}) put(at, 1.0F);
  put(108, 352.0F);
  std::memcpy(header.data() + 344, "n+1", 3);
  return header;
}

void write(const fs::path& file, const std::string& bytes) {
  std::ofstream out(file, std::ios::binary);
  out << bytes;
  if (!out) throw Error(ErrorKind::io, "cannot write " + file.string());
}

/// Appends zeros, packed by gzip.
void append_packed(const fs::path& file, const std::string& before, uint64_t zeros) {
  const gzFile packed = ::gzopen(file.c_str(), "ab1");
  const std::string piece(1 << 20, '\0');
  ::gzwrite(packed, before.data(), static_cast<unsigned>(before.size()));
  for (uint64_t left = zeros; left > 0; left -= std::min<uint64_t>(left, piece.size()))
    ::gzwrite(packed, piece.data(), static_cast<unsigned>(std::min<uint64_t>(left, piece.size())));
  ::gzclose(packed);
}

/// The slice's numbers of rows and columns become 65,535.
std::string with_giant_sides(std::string slice) {
  for (const char element : {'\x10', '\x11'}) {
    const size_t at = slice.find(std::string{'\x28', '\0', element, '\0'});
    if (at == std::string::npos) throw Error(ErrorKind::io, "a slice of the bench has no size");
    slice.replace(at + 8, 2, "\xff\xff");
  }
  return slice;
}

}  // namespace

HostileFiles::HostileFiles(fs::path folder) : folder_(std::move(folder)) {
  for (const char* below : {"seeds/dicom", "given", "bombs", "thieves", "private"})
    fs::create_directories(folder_ / below);
  std::string secret;
  for (int i = 0; i < secret_side * secret_side * secret_side; ++i)
    secret.append(reinterpret_cast<const char*>(&secret_value), sizeof secret_value);
  write(forbidden(), secret);
  const fs::path seeds = folder_ / "seeds";
  for (const char* name : {"a.nrrd", "a.nii", "a.nii.gz", "a.mha"}) {
    ct::write_volume_file(small_volume(), seeds / name);
    add_seed(seeds / name);
  }
  ct::write_dicom_folder(small_volume(), seeds / "dicom", 1);
  add_seed(seeds / "dicom/slice_0002.dcm", true);
  write(seeds / "a.txt", text_rows());
  add_seed(seeds / "a.txt");
  store::write_zip(seeds / "b.zip", {{seeds / "a.nrrd", "deep/a.nrrd"}});
  add_seed(seeds / "b.zip");
  store::write_zip(seeds / "c.zip",
                   {{seeds / "dicom/slice_0001.dcm", "1"}, {seeds / "dicom/slice_0002.dcm", "2"}});
  add_seed(seeds / "c.zip");
}

void HostileFiles::add_seed(const fs::path& file, bool folder) {
  seeds_.push_back({file.filename(), read_text_file(file), folder});
}

std::string HostileFiles::damaged(const std::string& bytes) {
  static const std::array<const char*, 8> words{"-1",     "4294967295", "1e309", "nan",
                                                "../../", "\xff\xff",   "%n%s",  "99999999999999999999"};
  std::string text = bytes;
  const size_t header = std::min<size_t>(text.size(), 700);
  for (size_t times = 1 + random_() % 6; times > 0 && !text.empty(); --times) {
    // Most of what a reader decides by stands at the beginning.
    const size_t at = random_() % (random_() % 3 == 0 ? text.size() : std::min(header, text.size()));
    const size_t length = std::min<size_t>(1 + random_() % 24, text.size() - at);
    const auto kind = random_() % 6;
    if (kind == 0) text[at] = static_cast<char>(text[at] ^ (1 << random_() % 8));
    if (kind == 1) text.replace(at, length, words[random_() % words.size()]);
    if (kind == 2) text.insert(at, text.substr(at, length));
    if (kind == 3) text.erase(at, length);
    if (kind == 4)
      std::fill_n(text.begin() + static_cast<ptrdiff_t>(at), length, static_cast<char>(random_()));
    if (kind == 5 && random_() % 4 == 0) text.resize(at);
  }
  return text;
}

fs::path HostileFiles::next_damaged() {
  const fs::path given = folder_ / "given";
  fs::remove_all(given);
  fs::create_directories(given);
  const Seed& seed = seeds_[count_++ % seeds_.size()];
  if (seed.folder)
    for (const auto& slice : fs::directory_iterator(folder_ / "seeds/dicom")) fs::copy(slice.path(), given);
  write(given / seed.name, damaged(seed.bytes));
  return seed.folder ? given : given / seed.name;
}

std::vector<fs::path> HostileFiles::bombs() const {
  const fs::path to = folder_ / "bombs";
  std::vector<fs::path> all;
  const auto next = [&](const std::string& name) { return all.emplace_back(to / name); };
  const std::string megabyte(1'000'000, '\1');
  write(next("claims.nrrd"), nrrd_header("1290 1290 1290", "encoding: raw") + megabyte);
  write(next("claims.mha"), meta_header("1290 1290 1290", "ElementDataFile = LOCAL") + megabyte);
  write(next("claims.nii"), nifti_header(1290) + megabyte);
  write(next("sides.nii"), nifti_header(32767) + megabyte);
  write(next("sides.nrrd"), nrrd_header("4294967295 4294967295 3", "encoding: raw") + megabyte);
  const std::string side = "680 680 680";  // 600 MB of 16 bits
  write(next("packed.nrrd"), nrrd_header(side, "encoding: gzip"));
  append_packed(all.back(), {}, bomb_bytes);
  append_packed(next("packed.nii.gz"), nifti_header(680), bomb_bytes);
  write(next("packed.mha"), meta_header(side, "CompressedData = True\nElementDataFile = LOCAL"));
  append_packed(all.back(), {}, bomb_bytes);
  const fs::path raw = to / "zeros.nrrd";
  write(raw, nrrd_header(side, "encoding: raw"));
  fs::resize_file(raw, bomb_bytes);
  store::write_zip(next("unpacks.zip"), {{raw, "a.nrrd"}});
  fs::remove(raw);
  store::write_zip(next("nested.zip"), {{to / "unpacks.zip", "a.zip"}});
  std::string rows = "0 0 0 1\n0.001 0 0 1\n";
  while (rows.size() < megabyte.size()) rows += "1e9 1e9 " + std::to_string(rows.size()) + " 1\n";
  write(next("far_apart.txt"), rows);
  fs::create_directories(next("giant_slices"));
  for (const char* name : {"slice_0001.dcm", "slice_0002.dcm", "slice_0003.dcm"})
    write(all.back() / name, with_giant_sides(read_text_file(folder_ / "seeds/dicom" / name)));
  return all;
}

std::vector<fs::path> HostileFiles::thieves() const {
  std::vector<fs::path> all;
  const auto next = [&](const std::string& ending) {
    return all.emplace_back(folder_ / "thieves" / (std::to_string(all.size()) + ending));
  };
  for (const std::string& to : {forbidden().string(), std::string("../private/secret.raw"),
                                "/proc/self/root" + forbidden().string()}) {
    for (const char* key : {"data file: ", "Data File: ", "datafile: ", "DATA  FILE:", "data\tfile: "})
      for (const char* ending : {".nrrd", ".nhdr"})
        write(next(ending), nrrd_header("8 8 8", "encoding: raw\n" + (key + to)));
    for (const char* before : {"", "Element DataFile = LOCAL\n", "elementdatafile = LOCAL\n"})
      for (const char* ending : {".mha", ".mhd"})
        write(next(ending), meta_header("8 8 8", before + ("ElementDataFile = " + to)));
  }
  return all;
}

bool HostileFiles::holds_forbidden(std::span<const int16_t> values) {
  return std::search_n(values.begin(), values.end(), secret_run, secret_value) != values.end();
}

bool HostileFiles::forbidden_is_untouched() const {
  const auto entries = fs::directory_iterator(folder_ / "private");
  return std::distance(begin(entries), end(entries)) == 1 &&
         fs::file_size(forbidden()) == secret_side * secret_side * secret_side * sizeof secret_value;
}

}  // namespace ream::bench

#pragma once
#include <zlib.h>

#include <cstring>
#include <filesystem>
#include <stdexcept>
#include <vector>

#include "core/file.hpp"
#include "session/export/cause_export.hpp"
#include "support/recorded_reaming.hpp"
#include "twin/part_file.hpp"

namespace ream::test {

/// The parts of a file of causes, read by zlib's own reader of files; throws where it is not laid out as
/// PartFileWriter says.
inline std::vector<twin::Bytes> parts_of(const std::filesystem::path& path) {
  gzFile in = ::gzopen(path.c_str(), "rb");
  if (!in) throw std::runtime_error("cannot open " + path.string());
  const auto read = [&](size_t count) {
    twin::Bytes bytes(count);
    if (::gzread(in, bytes.data(), static_cast<unsigned>(count)) != static_cast<int>(count))
      throw std::runtime_error(path.string() + " is cut short");
    return bytes;
  };
  const auto u32 = [&] {
    uint32_t value = 0;
    std::memcpy(&value, read(4).data(), 4);
    return value;
  };
  if (std::memcmp(read(8).data(), "reamtwin", 8) != 0 || u32() != 1)
    throw std::runtime_error(path.string() + " has another beginning");
  std::vector<twin::Bytes> parts;
  while (gzgetc(in) >= 0) {
    ::gzseek(in, -1, SEEK_CUR);
    parts.push_back(read(u32()));
  }
  ::gzclose(in);
  return parts;
}

/// What the program exports of a recording of a reaming.
inline std::filesystem::path causes_of(const RecordedReaming& reaming,
                                       const std::filesystem::path& recording) {
  auto out = reaming.folder().path() / "session.causes";
  session::ExportRequest request;
  request.recording = recording;
  request.data = reaming.data();
  session::write_causes(request, out, no_progress);
  return out;
}

/// What a part is, by its first byte.
inline twin::PartCode code_of(const twin::Bytes& part) { return static_cast<twin::PartCode>(part.at(0)); }

}  // namespace ream::test

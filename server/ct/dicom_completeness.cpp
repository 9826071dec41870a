#include "ct/dicom_completeness.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <fstream>
#include <string>
#include <string_view>
#include <vector>

namespace ream::ct {
namespace {

constexpr uint64_t preamble_bytes = 128;
constexpr uint32_t undefined_length = 0xffffffffu;
constexpr uint32_t transfer_syntax = 0x00020010u, pixel_data = 0x7fe00010u;
constexpr uint32_t item = 0xfffee000u, item_end = 0xfffee00du, sequence_end = 0xfffee0ddu;

struct Element {
  uint32_t tag = 0, length = 0;
  std::string vr;  // empty in implicit encoding
};

class Walker {
 public:
  explicit Walker(const std::filesystem::path& file)
      : in_(file, std::ios::binary), size_(std::filesystem::file_size(file)) {}

  DicomState walk();

 private:
  bool read(void* to, uint64_t bytes) {
    if (position_ + bytes > size_) return false;
    in_.read(static_cast<char*>(to), static_cast<std::streamsize>(bytes));
    position_ += bytes;
    return static_cast<bool>(in_);
  }
  bool skip(uint64_t bytes) {
    if (position_ + bytes > size_) return false;
    position_ += bytes;
    in_.seekg(static_cast<std::streamoff>(position_));
    return true;
  }
  bool number(uint32_t& value, int bytes) {
    std::array<unsigned char, 4> raw{};
    if (!read(raw.data(), static_cast<uint64_t>(bytes))) return false;
    if (big_endian_) std::reverse(raw.begin(), raw.begin() + bytes);
    value = raw[0] | (uint32_t{raw[1]} << 8) | (uint32_t{raw[2]} << 16) | (uint32_t{raw[3]} << 24);
    return true;
  }
  bool element(Element& e, bool implicit);
  /// Reads the file meta group; false when it is cut short.
  bool meta_group(std::string& syntax);
  /// Old files begin with the data set itself; true when this one does, telling whether it is implicit.
  bool bare_data_set(bool& implicit);

  std::ifstream in_;
  uint64_t size_ = 0, position_ = 0;
  bool big_endian_ = false;
};

bool Walker::element(Element& e, bool implicit) {
  uint32_t group = 0, number_in_group = 0;
  if (!number(group, 2) || !number(number_in_group, 2)) return false;
  e.tag = (group << 16) | number_in_group;
  e.vr.clear();
  if (implicit || group == 0xfffe) return number(e.length, 4);
  std::array<char, 2> vr{};
  if (!read(vr.data(), 2)) return false;
  e.vr.assign(vr.data(), 2);
  constexpr std::array<std::string_view, 13> long_form = {"OB", "OD", "OF", "OL", "OV", "OW", "SQ",
                                                          "SV", "UC", "UN", "UR", "UT", "UV"};
  if (std::find(long_form.begin(), long_form.end(), e.vr) == long_form.end()) return number(e.length, 2);
  return skip(2) && number(e.length, 4);
}

bool Walker::meta_group(std::string& syntax) {
  while (position_ < size_) {
    const uint64_t start = position_;
    Element e;
    if (!element(e, false)) return false;
    if ((e.tag >> 16) != 2) {
      position_ = start;
      in_.seekg(static_cast<std::streamoff>(start));
      return true;
    }
    if (e.tag != transfer_syntax) {
      if (!skip(e.length)) return false;
      continue;
    }
    if (position_ + e.length > size_) return false;
    syntax.resize(e.length);
    if (!read(syntax.data(), e.length)) return false;
    while (!syntax.empty() && (syntax.back() == '\0' || syntax.back() == ' ')) syntax.pop_back();
  }
  return false;
}

bool Walker::bare_data_set(bool& implicit) {
  position_ = 0;
  in_.clear();
  in_.seekg(0);
  std::array<unsigned char, 8> start{};
  if (!read(start.data(), start.size())) return false;
  // Group 0008 comes first; its first elements are 0000, 0001, 0005, 0008, 0016 and 0018.
  constexpr std::array<unsigned char, 6> first_elements = {0x00, 0x01, 0x05, 0x08, 0x16, 0x18};
  if (start[0] != 0x08 || start[1] != 0 || start[3] != 0 ||
      std::find(first_elements.begin(), first_elements.end(), start[2]) == first_elements.end())
    return false;
  const auto capital = [](unsigned char c) { return c >= 'A' && c <= 'Z'; };
  implicit = !(capital(start[4]) && capital(start[5]));
  position_ = 0;
  in_.seekg(0);
  return true;
}

DicomState Walker::walk() {
  std::array<char, 4> marker{};
  bool implicit = false;
  if (skip(preamble_bytes) && read(marker.data(), 4) && std::string_view(marker.data(), 4) == "DICM") {
    std::string syntax;
    if (!meta_group(syntax)) return DicomState::cut_short;
    if (syntax == "1.2.840.10008.1.2.1.99") return DicomState::whole;
    big_endian_ = syntax == "1.2.840.10008.1.2.2";
    implicit = syntax == "1.2.840.10008.1.2";
  } else if (!bare_data_set(implicit)) {
    return DicomState::not_dicom;
  }

  // One entry per open sequence of undefined length; true where its content is in implicit encoding.
  std::vector<bool> open{implicit};
  bool in_pixels = false;
  while (position_ < size_) {
    Element e;
    if (!element(e, open.back())) return DicomState::cut_short;
    if (e.tag == item_end) continue;
    if (e.tag == sequence_end) {
      if (open.size() > 1) open.pop_back();
      if (in_pixels && open.size() == 1) return DicomState::whole;
      continue;
    }
    const bool top_level_pixels = e.tag == pixel_data && open.size() == 1;
    if (e.length == undefined_length) {
      in_pixels = in_pixels || top_level_pixels;
      // An unknown element of undefined length is a sequence in implicit encoding (PS3.5, 6.2.2).
      if (e.tag != item) open.push_back(open.back() || e.vr == "UN");
      continue;
    }
    if (!skip(e.length)) return DicomState::cut_short;
    if (top_level_pixels) return DicomState::whole;
  }
  return open.size() > 1 ? DicomState::cut_short : DicomState::no_pixels;
}

}  // namespace

DicomState dicom_state(const std::filesystem::path& file) { return Walker(file).walk(); }

}  // namespace ream::ct

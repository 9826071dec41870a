#include "reader/dicom_file.hpp"

#include <zlib.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <memory>
#include <new>
#include <string_view>

#include "core/error.hpp"

namespace ream::reader {
namespace {

constexpr uint64_t preamble_bytes = 128;
constexpr uint32_t undefined_length = 0xffffffffu;
constexpr uint32_t transfer_syntax = 0x00020010u, pixel_data = 0x7fe00010u;
constexpr uint32_t item = 0xfffee000u, item_end = 0xfffee00du, sequence_end = 0xfffee0ddu;
constexpr int max_depth = 16;
constexpr size_t max_items = 100000;
constexpr uint32_t max_value_bytes = 4096;
constexpr size_t max_inflated_bytes = size_t{1} << 30;

constexpr std::array<uint32_t, 18> text_tags = {0x00080005, 0x00080008, 0x00080060, 0x0008103e, 0x00100010,
                                                0x00100020, 0x00180050, 0x0020000e, 0x00200013, 0x00200032,
                                                0x00200037, 0x00280004, 0x00280008, 0x00280030, 0x00280301,
                                                0x00281052, 0x00281053, 0x00281054};
constexpr std::array<uint32_t, 8> number_tags = {0x00280002, 0x00280010, 0x00280011, 0x00280100,
                                                 0x00280101, 0x00280103, 0x00280120, 0x00280121};
constexpr std::array<uint32_t, 6> sequence_tags = {0x52009229, 0x52009230, 0x00209113,
                                                   0x00209116, 0x00289110, 0x00289145};

template <size_t n>
bool among(uint32_t tag, const std::array<uint32_t, n>& tags) {
  return std::find(tags.begin(), tags.end(), tag) != tags.end();
}

struct Element {
  uint32_t tag = 0, length = 0;
  std::string vr;  // empty in implicit encoding
};

/// Every function returns false for what is damaged.
class Parser {
 public:
  explicit Parser(const std::filesystem::path& file)
      : in_(file, std::ios::binary), size_(std::filesystem::file_size(file)) {}

  DicomFile parse();

 private:
  bool read(void* to, uint64_t bytes) {
    if (bytes > size_ - position_) return false;
    const uint64_t at = position_;
    position_ += bytes;
    if (!result_.inflated.empty()) return result_.inflated.copy(static_cast<char*>(to), bytes, at) == bytes;
    in_.read(static_cast<char*>(to), static_cast<std::streamsize>(bytes));
    return static_cast<bool>(in_);
  }
  bool skip(uint64_t bytes) {
    if (bytes > size_ - position_) return false;
    go_to(position_ + bytes);
    return true;
  }
  void go_to(uint64_t position) {
    position_ = position;
    in_.clear();
    in_.seekg(static_cast<std::streamoff>(position_));
  }
  bool number(uint32_t& value, int bytes) {
    std::array<unsigned char, 4> raw{};
    if (!read(raw.data(), static_cast<uint64_t>(bytes))) return false;
    if (result_.big_endian) std::reverse(raw.begin(), raw.begin() + bytes);
    value = raw[0] | (uint32_t{raw[1]} << 8) | (uint32_t{raw[2]} << 16) | (uint32_t{raw[3]} << 24);
    return true;
  }
  bool element(Element& e, bool implicit);
  bool value(const Element& e, DicomSet& set);
  /// Reads the file meta group.
  bool meta_group(std::string& syntax);
  /// Old files begin with the data set itself; true when this one does, telling whether it is implicit.
  bool bare_data_set(bool& implicit);
  /// Elements up to `end`, or up to an item's end when `open`, or up to and with the pixels.
  bool elements(DicomSet& set, bool implicit, uint64_t end, bool open, int depth);
  bool sequence(const Element& e, DicomSet& set, bool implicit, int depth);
  bool fragments();
  /// Goes on in what the rest of the file is packed from.
  bool inflate_rest();

  std::ifstream in_;
  uint64_t size_ = 0, position_ = 0;
  DicomFile result_;
  bool has_pixels_ = false;
};

bool Parser::element(Element& e, bool implicit) {
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

bool Parser::value(const Element& e, DicomSet& set) {
  const bool is_number = among(e.tag, number_tags);
  if ((!is_number && !among(e.tag, text_tags)) || e.length > max_value_bytes) return skip(e.length);
  std::string bytes(e.length, '\0');
  if (!read(bytes.data(), e.length)) return false;
  if (is_number && result_.big_endian && bytes.size() == 2) std::swap(bytes[0], bytes[1]);
  set.values[e.tag] = std::move(bytes);
  return true;
}

bool Parser::meta_group(std::string& syntax) {
  while (position_ < size_) {
    const uint64_t start = position_;
    Element e;
    if (!element(e, false)) return false;
    if ((e.tag >> 16) != 2) {
      go_to(start);
      return true;
    }
    if (e.tag != transfer_syntax) {
      if (!skip(e.length)) return false;
      continue;
    }
    if (e.length > max_value_bytes) return false;
    syntax.resize(e.length);
    if (!read(syntax.data(), e.length)) return false;
    while (!syntax.empty() && (syntax.back() == '\0' || syntax.back() == ' ')) syntax.pop_back();
  }
  return false;
}

bool Parser::bare_data_set(bool& implicit) {
  go_to(0);
  std::array<unsigned char, 8> start{};
  if (!read(start.data(), start.size())) return false;
  // Group 0008 comes first; its first elements are 0000, 0001, 0005, 0008, 0016 and 0018.
  constexpr std::array<unsigned char, 6> first_elements = {0x00, 0x01, 0x05, 0x08, 0x16, 0x18};
  if (start[0] != 0x08 || start[1] != 0 || start[3] != 0 ||
      std::find(first_elements.begin(), first_elements.end(), start[2]) == first_elements.end())
    return false;
  const auto capital = [](unsigned char c) { return c >= 'A' && c <= 'Z'; };
  implicit = !(capital(start[4]) && capital(start[5]));
  go_to(0);
  return true;
}

bool Parser::fragments() {
  result_.packed = true;
  while (result_.pixels.size() < max_items) {
    Element e;
    if (!element(e, true)) return false;
    if (e.tag == sequence_end) {
      has_pixels_ = true;
      return result_.pixels.size() >= 2;
    }
    if (e.tag != item || e.length == undefined_length) return false;
    result_.pixels.push_back({position_, e.length});
    if (!skip(e.length)) return false;
  }
  return false;
}

bool Parser::sequence(const Element& e, DicomSet& set, bool implicit, int depth) {
  const bool open = e.length == undefined_length, is_read = among(e.tag, sequence_tags);
  if (!open && !is_read) return skip(e.length);
  if (depth >= max_depth || (!open && e.length > size_ - position_)) return false;
  const uint64_t end = open ? size_ : position_ + e.length;
  // An unknown element of undefined length is a sequence in implicit encoding (PS3.5, 6.2.2).
  const bool inner_implicit = implicit || e.vr == "UN";
  std::vector<DicomSet> items;
  while (position_ < end) {
    Element next;
    if (!element(next, true)) return false;
    if (next.tag == sequence_end && open) break;
    if (next.tag != item) return false;
    const bool open_item = next.length == undefined_length;
    if (!open_item && next.length > end - position_) return false;
    if (is_read && items.size() >= max_items) return false;
    if (!is_read && !open_item) {
      skip(next.length);
      continue;
    }
    DicomSet inner;
    if (!elements(inner, inner_implicit, open_item ? end : position_ + next.length, open_item, depth + 1))
      return false;
    if (is_read) items.push_back(std::move(inner));
  }
  if (is_read) set.sequences[e.tag] = std::move(items);
  return open || position_ == end;
}

bool Parser::elements(DicomSet& set, bool implicit, uint64_t end, bool open, int depth) {
  while (position_ < end) {
    Element e;
    if (!element(e, implicit)) return false;
    if (e.tag == item_end && open) return true;
    const bool is_sequence = e.vr == "SQ" || (implicit && among(e.tag, sequence_tags));
    if (depth == 0 && e.tag == pixel_data) {
      if (e.length == undefined_length) return fragments();
      result_.pixels.push_back({position_, e.length});
      has_pixels_ = skip(e.length);
      return has_pixels_;
    }
    if (e.length == undefined_length || is_sequence) {
      if (!sequence(e, set, implicit, depth)) return false;
    } else if (!value(e, set)) {
      return false;
    }
  }
  return !open && position_ == end;
}

bool Parser::inflate_rest() {
  std::string packed(size_ - position_, '\0');
  if (!read(packed.data(), packed.size())) return false;
  z_stream stream{};
  constexpr int without_header = -15;
  if (::inflateInit2(&stream, without_header) != Z_OK) throw std::bad_alloc();
  const std::unique_ptr<z_stream, decltype(&::inflateEnd)> ends(&stream, ::inflateEnd);
  stream.next_in = reinterpret_cast<Bytef*>(packed.data());
  stream.avail_in = static_cast<uInt>(std::min<size_t>(packed.size(), UINT32_MAX));
  std::string& to = result_.inflated;
  std::vector<char> piece(1 << 20);
  for (int state = Z_OK; state == Z_OK && to.size() <= max_inflated_bytes;) {
    stream.next_out = reinterpret_cast<Bytef*>(piece.data());
    stream.avail_out = static_cast<uInt>(piece.size());
    state = ::inflate(&stream, Z_NO_FLUSH);
    to.append(piece.data(), piece.size() - stream.avail_out);
    if (state != Z_STREAM_END) continue;
    size_ = to.size();
    position_ = 0;
    return size_ > 0;
  }
  return false;
}

DicomFile Parser::parse() {
  std::array<char, 4> marker{};
  bool implicit = false;
  result_.state = DicomState::damaged;
  if (skip(preamble_bytes) && read(marker.data(), 4) && std::string_view(marker.data(), 4) == "DICM") {
    std::string syntax;
    if (!meta_group(syntax)) return result_;
    result_.big_endian = syntax == "1.2.840.10008.1.2.2";
    implicit = syntax == "1.2.840.10008.1.2";
    result_.transfer_syntax = syntax;
    if (syntax == "1.2.840.10008.1.2.1.99" && !inflate_rest()) return result_;
  } else if (bare_data_set(implicit)) {
    result_.transfer_syntax = implicit ? "1.2.840.10008.1.2" : "1.2.840.10008.1.2.1";
  } else {
    result_.state = DicomState::not_dicom;
    return result_;
  }
  if (elements(result_.set, implicit, size_, false, 0))
    result_.state = has_pixels_ ? DicomState::whole : DicomState::no_pixels;
  return result_;
}

}  // namespace

std::string DicomFile::bytes_at(const std::filesystem::path& file, const Piece& piece) const {
  std::string bytes(piece.bytes, '\0');
  if (!inflated.empty()) {
    inflated.copy(bytes.data(), bytes.size(), piece.at);
    return bytes;
  }
  std::ifstream in(file, std::ios::binary);
  in.seekg(static_cast<std::streamoff>(piece.at));
  in.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  if (!in)
    throw Error(ErrorKind::invalid_input,
                file.string() + ": the pixels cannot be read, the file was changed while it was read");
  return bytes;
}

DicomFile parse_dicom(const std::filesystem::path& file) { return Parser(file).parse(); }

}  // namespace ream::reader

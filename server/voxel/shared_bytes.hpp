#pragma once
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

namespace ream::voxel {

/// Bytes that copies share: a case that several sessions ream keeps its density once. Reading is as of a
/// const vector; who writes asks for writable(), which copies first when others share.
class SharedBytes {
 public:
  SharedBytes() = default;
  SharedBytes(std::vector<uint8_t> bytes)  // NOLINT: a vector is what bytes come from
      : bytes_(std::make_shared<std::vector<uint8_t>>(std::move(bytes))) {}

  size_t size() const { return bytes_ ? bytes_->size() : 0; }
  bool empty() const { return size() == 0; }
  const uint8_t* data() const { return bytes_ ? bytes_->data() : nullptr; }
  uint8_t operator[](size_t i) const { return (*bytes_)[i]; }
  const uint8_t* begin() const { return data(); }
  const uint8_t* end() const { return data() + size(); }

  /// Not while another thread copies or reads this object.
  std::vector<uint8_t>& writable() {
    if (!bytes_) bytes_ = std::make_shared<std::vector<uint8_t>>();
    if (bytes_.use_count() > 1) bytes_ = std::make_shared<std::vector<uint8_t>>(*bytes_);
    return *bytes_;
  }
  /// Whether both are one and the same memory.
  bool shares_with(const SharedBytes& other) const { return bytes_ == other.bytes_; }

  bool operator==(const SharedBytes& other) const {
    return bytes_ == other.bytes_ || (size() == other.size() && std::equal(begin(), end(), other.begin()));
  }

 private:
  friend class WatchedBytes;
  std::shared_ptr<std::vector<uint8_t>> bytes_;
};

/// Bytes that somebody else keeps: get() is empty once nobody does.
class WatchedBytes {
 public:
  WatchedBytes() = default;
  explicit WatchedBytes(const SharedBytes& bytes) : bytes_(bytes.bytes_) {}
  bool gone() const { return bytes_.expired(); }
  SharedBytes get() const {
    SharedBytes bytes;
    bytes.bytes_ = bytes_.lock();
    return bytes;
  }

 private:
  std::weak_ptr<std::vector<uint8_t>> bytes_;
};

}  // namespace ream::voxel

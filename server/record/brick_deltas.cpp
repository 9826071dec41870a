#include "record/brick_deltas.hpp"

#include "core/error.hpp"

namespace ream::record {
namespace {

void put_u32(ops::Bytes& out, uint32_t word) {
  for (int k = 0; k < 4; ++k) out.push_back(static_cast<std::byte>(word >> (8 * k)));
}

uint32_t u32_at(const ops::Bytes& bytes, size_t at) {
  uint32_t word = 0;
  for (size_t k = 0; k < 4; ++k) word |= std::to_integer<uint32_t>(bytes[at + k]) << (8 * k);
  return word;
}

}  // namespace

void BrickDeltaWriter::add(uint32_t brick, const uint8_t* before, const uint8_t* now) {
  indices_.push_back(brick);
  const size_t at = falls_.size();
  falls_.resize(at + voxel::brick_voxels);
  for (size_t i = 0; i < voxel::brick_voxels; ++i)
    falls_[at + i] = static_cast<std::byte>(static_cast<uint8_t>(before[i] - now[i]));
}

ops::Bytes BrickDeltaWriter::take() {
  ops::Bytes out;
  out.reserve(4 * indices_.size() + falls_.size());
  uint32_t last = 0;
  for (const uint32_t brick : indices_) {
    put_u32(out, brick - last);
    last = brick;
  }
  out.insert(out.end(), falls_.begin(), falls_.end());
  indices_.clear();
  falls_.clear();
  return out;
}

void read_brick_deltas(const ops::Bricks& op, size_t brick_count,
                       const std::function<void(uint32_t brick, const uint8_t* falls)>& visit) {
  constexpr size_t bytes_a_brick = 4 + voxel::brick_voxels;
  if (op.images.size() != bytes_a_brick * op.count)
    throw Error(ErrorKind::invalid_input,
                "the bricks after tick " + std::to_string(op.tick) + " do not fill their bytes");
  uint64_t brick = 0;
  for (size_t i = 0; i < op.count; ++i) {
    brick += u32_at(op.images, 4 * i);
    if (brick >= brick_count)
      throw Error(ErrorKind::invalid_input, "the bricks after tick " + std::to_string(op.tick) +
                                                " are not all in the grid; is this the recording's case?");
    visit(static_cast<uint32_t>(brick),
          reinterpret_cast<const uint8_t*>(op.images.data()) + 4 * op.count + voxel::brick_voxels * i);
  }
}

}  // namespace ream::record

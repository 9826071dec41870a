#pragma once
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

namespace ream::voxelizer {

/// Many lists of numbers with their sizes that grow at their ends, in small pieces of memory so that they
/// take little more than they hold.
class TriangleLists {
 public:
  /// Memory for several threads' lists, shared as it is wanted.
  class Budget {
   public:
    explicit Budget(size_t bytes) : blocks_left_(static_cast<long long>(bytes / sizeof(Block))) {}
    bool take_block() { return --blocks_left_ >= 0; }

   private:
    std::atomic<long long> blocks_left_;
  };

  /// `budget` must outlive what is added.
  TriangleLists(size_t lists, Budget& budget) : ends_(lists), budget_(&budget) {}
  /// Of so many lists of each of several threads, every list with something in it.
  static size_t least_bytes(size_t lists, size_t threads) {
    return lists * (threads * sizeof(Ends) + sizeof(Piece));
  }

  /// False when there is no room for it.
  bool add(size_t list, uint32_t number, uint8_t size) {
    Ends& ends = ends_[list];
    if (ends.last == nullptr || ends.last->count == Piece::room) {
      Piece* piece = new_piece();
      if (piece == nullptr) return false;
      (ends.last == nullptr ? ends.first : ends.last->next) = piece;
      ends.last = piece;
    }
    Piece& piece = *ends.last;
    piece.numbers[piece.count] = number;
    piece.sizes[piece.count++] = size;
    return true;
  }

  /// In the order in which they were added: visit(number, size).
  template <class Visit>
  void for_each(size_t list, Visit visit) const {
    for (const Piece* piece = ends_[list].first; piece != nullptr; piece = piece->next)
      for (uint32_t i = 0; i < piece->count; ++i)
        visit(static_cast<size_t>(piece->numbers[i]), int{piece->sizes[i]});
  }

  size_t size(size_t list) const {
    size_t sum = 0;
    for (const Piece* piece = ends_[list].first; piece != nullptr; piece = piece->next) sum += piece->count;
    return sum;
  }

 private:
  struct Piece {
    static constexpr uint32_t room = 48;  // 256 bytes
    Piece* next;
    uint32_t count;
    uint32_t numbers[room];
    uint8_t sizes[room];
  };
  struct Block {
    static constexpr size_t room = 128;
    Piece pieces[room];
  };
  struct Ends {
    Piece* first = nullptr;
    Piece* last = nullptr;
  };

  Piece* new_piece() {
    if (used_ == Block::room) {
      if (!budget_->take_block()) return nullptr;
      blocks_.push_back(std::make_unique_for_overwrite<Block>());
      used_ = 0;
    }
    Piece* piece = &blocks_.back()->pieces[used_++];
    piece->next = nullptr;
    piece->count = 0;
    return piece;
  }

  std::vector<Ends> ends_;
  std::vector<std::unique_ptr<Block>> blocks_;
  Budget* budget_;
  size_t used_ = Block::room;
};

}  // namespace ream::voxelizer

#pragma once
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "core/thread_pool.hpp"
#include "voxelizer/raster_grid.hpp"

namespace ream::voxelizer {

/// Many lists of numbers with their sizes that grow at their ends, in small pieces of memory so that they
/// take little more than they hold.
class TriangleLists {
 public:
  /// Memory for several threads' lists, shared as it is needed.
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
  static size_t min_bytes(size_t lists, size_t threads) {
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

/// Rows of bits of one tile: all u, some (v,w). They may stand in the whole grid or in memory of their own.
struct TileRows {
  RowRange range;
  uint32_t* words = nullptr;  ///< of row (v_begin, w_begin)
  size_t words_per_row = 0;
  size_t rows_per_layer = 0;  ///< between equal v of neighbouring w

  uint32_t* row(int v, int w) const {
    return words + words_per_row * (static_cast<size_t>(v - range.v_begin) +
                                    rows_per_layer * static_cast<size_t>(w - range.w_begin));
  }
};

/// A grid cut into tiles of whole rows, so that each can be worked on by itself, without atomics and in a
/// processor's cache. Tile (i, j) is number i + count_v * j.
struct TilePlan {
  int rows = 0, layers = 0;  ///< of a tile; the last ones have fewer
  int count_v = 0, count_w = 0;
  Vec3i dims = Vec3i::Zero();

  size_t count() const { return static_cast<size_t>(count_v) * static_cast<size_t>(count_w); }
  RowRange range(size_t tile) const;
  /// The tile that row (v, w) is in.
  size_t tile_of(int v, int w) const {
    return static_cast<size_t>(v / rows) + static_cast<size_t>(count_v) * static_cast<size_t>(w / layers);
  }
};

/// Tiles of up to about `tile_bytes` bytes of bits, their sides multiples of 8, and about `min_tiles` or
/// more where the grid has the layers for it. `whole_layers` keeps layers whole, however large they are.
TilePlan plan_tiles(const RasterGrid& grid, size_t tile_bytes, size_t min_tiles, bool whole_layers = false);

/// Boxes of triangles by their rows and layers: about two, three, four, five, more of each.
struct BoxSize {
  static constexpr int sides = 5, count = sides * sides;
};

/// Which triangles may touch which tile. One thread's lists keep the order of the mesh.
class TileBins {
 public:
  /// Where lists would take more than `max_bytes` there are none and every tile looks at all triangles.
  TileBins(const TriangleMesh& mesh, const VoxelMap& map, const TilePlan& plan, ThreadPool& pool,
           size_t max_bytes = size_t{48} << 20);

  /// Calls visit(triangle) for every triangle that may touch the tile.
  template <class Visit>
  void for_each(size_t tile, Visit visit) const {
    for_each_sized(tile, [&](size_t triangle, int) { visit(triangle); });
  }
  /// As for_each, some at a time and, as far as it goes, of one size: visit(triangles, count) for up to `few`
  /// of them; those behind the last repeat it.
  template <int few, class Visit>
  void for_each_few(size_t tile, Visit visit) const {
    uint32_t some[BoxSize::count][few];
    int counts[BoxSize::count] = {};
    for_each_sized(tile, [&](size_t triangle, int size) {
      int& count = counts[size];
      some[size][count++] = static_cast<uint32_t>(triangle);
      if (count < few) return;
      count = 0;
      visit(some[size], few);
    });
    uint32_t rest[few];
    int count = 0;
    for (int size = 0; size < BoxSize::count; ++size)
      for (int i = 0; i < counts[size]; ++i) {
        rest[count++] = some[size][i];
        if (count < few) continue;
        count = 0;
        visit(rest, few);
      }
    if (count == 0) return;
    for (int i = count; i < few; ++i) rest[i] = rest[count - 1];
    visit(rest, count);
  }
  bool listed() const { return listed_; }
  /// All tiles, those with most triangles first, so that threads that share them end at about the same time.
  std::vector<size_t> largest_first(size_t tiles) const;

 private:
  template <class Visit>
  void for_each_sized(size_t tile, Visit visit) const {
    if (!listed_)
      for (size_t triangle = 0; triangle < triangles_; ++triangle) visit(triangle, 0);
    else
      for (const TriangleLists& lists : lists_) lists.for_each(tile, visit);
  }

  size_t triangles_ = 0;
  bool listed_ = false;
  std::vector<TriangleLists> lists_;  ///< a worker's each
};

}  // namespace ream::voxelizer

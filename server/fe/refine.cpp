#include "fe/element_model.hpp"

#include <array>

#include "core/error.hpp"
#include "core/thread_pool.hpp"
#include "voxel/upsample.hpp"

namespace ream::fe {
namespace {

constexpr int none = -1;

/// A layer of voxels with their codes at hand: `none` where there is no element. A border of one around.
class OpenLayer {
 public:
  OpenLayer(const ElementModel& model, const std::vector<uint64_t>& before_layer, int w)
      : stride_(static_cast<size_t>(model.mask.dims().x()) + 2),
        codes_(stride_ * (static_cast<size_t>(model.mask.dims().y()) + 2), none) {
    const VoxelMask& mask = model.mask;
    if (w < 0 || w >= mask.dims().z()) return;
    const auto at = static_cast<size_t>(w);
    std::vector<uint16_t> scratch;
    const auto codes = model.codes.read(before_layer[at], before_layer[at + 1] - before_layer[at], scratch);
    size_t next = 0;
    for (int v = 0; v < mask.dims().y(); ++v)
      for_each_run(mask.row(v, w), mask.words_per_row(), [&](int begin, int end) {
        for (int u = begin; u < end; ++u) row(v)[u] = codes[next++];
      });
  }
  /// Can be read from -1 on.
  int32_t* row(int v) { return codes_.data() + stride_ * (static_cast<size_t>(v) + 1) + 1; }
  const int32_t* row(int v) const { return codes_.data() + stride_ * (static_cast<size_t>(v) + 1) + 1; }

 private:
  size_t stride_;
  std::vector<int32_t> codes_;
};

/// Which neighbour along an axis part `i` of a voxel leans to, and the weights.
struct Lean {
  int towards = 0;  ///< -1 or 1
  int64_t own = 0, other = 0;
};

std::vector<Lean> leans(int factor) {
  std::vector<Lean> result;
  for (int i = 0; i < factor; ++i) {
    // The tap of the middle one of three voxels, whose neighbours both exist.
    const voxel::UpsampleTap tap = voxel::upsample_tap(factor + i, factor, 3);
    if (tap.low == 1)
      result.push_back({1, tap.low_weight, tap.high_weight});
    else
      result.push_back({-1, tap.high_weight, tap.low_weight});
  }
  return result;
}

/// Three layers around the one that is split.
struct Around {
  std::array<const OpenLayer*, 3> layers;

  int64_t code(int u, int v, int dw, int64_t own) const {
    const int32_t code = layers[static_cast<size_t>(dw + 1)]->row(v)[u];
    return code == none ? own : code;
  }
};

uint16_t interpolated(const Around& around, int u, int v, const Lean& x, const Lean& y, const Lean& z,
                      int64_t whole) {
  const int64_t own = around.layers[1]->row(v)[u];
  const auto along_x = [&](int dv, int dw) {
    return x.own * around.code(u, v + dv, dw, own) + x.other * around.code(u + x.towards, v + dv, dw, own);
  };
  const auto along_y = [&](int dw) { return y.own * along_x(0, dw) + y.other * along_x(y.towards, dw); };
  const int64_t sum = z.own * along_y(0) + z.other * along_y(z.towards);
  return static_cast<uint16_t>((sum + whole / 2) / whole);
}

/// Splits the voxels of one layer into `factor` layers of the fine model.
class Splitter {
 public:
  Splitter(const ElementModel& coarse, ElementModel& fine, int factor)
      : coarse_(coarse), fine_(fine), factor_(factor), leans_(leans(factor)) {
    const auto words = coarse.mask.words_per_row() * static_cast<size_t>(coarse.mask.dims().y());
    before_.push_back(0);
    for (int w = 0; w < coarse.mask.dims().z(); ++w)
      before_.push_back(before_.back() + set_bits(coarse.mask.row(0, w), words));
  }

  void split(int w) {
    const OpenLayer below(coarse_, before_, w - 1), own(coarse_, before_, w), above(coarse_, before_, w + 1);
    const Around around{{&below, &own, &above}};
    const uint64_t first = before_[static_cast<size_t>(w)],
                   count = before_[static_cast<size_t>(w) + 1] - first;
    const auto n = static_cast<uint64_t>(factor_);
    std::vector<uint16_t> codes;
    codes.reserve(count * n * n);
    for (int k = 0; k < factor_; ++k) {
      codes.clear();
      for (int v = 0; v < coarse_.mask.dims().y(); ++v)
        for (int j = 0; j < factor_; ++j) split_row(around, v, w, j, k, codes);
      fine_.codes.write((first * n + count * static_cast<uint64_t>(k)) * n * n, codes);
    }
  }

 private:
  void split_row(const Around& around, int v, int w, int j, int k, std::vector<uint16_t>& codes) {
    const auto n = static_cast<int64_t>(factor_);
    const int64_t whole = 8 * n * n * n;
    uint64_t* bits = fine_.mask.row(v * factor_ + j, w * factor_ + k);
    for_each_run(coarse_.mask.row(v, w), coarse_.mask.words_per_row(), [&](int begin, int end) {
      for (int u = begin * factor_; u < end * factor_; ++u) bits[u / 64] |= uint64_t{1} << (u % 64);
      for (int u = begin; u < end; ++u)
        for (int i = 0; i < factor_; ++i)
          codes.push_back(interpolated(around, u, v, leans_[static_cast<size_t>(i)],
                                       leans_[static_cast<size_t>(j)], leans_[static_cast<size_t>(k)],
                                       whole));
    });
  }

  const ElementModel& coarse_;
  ElementModel& fine_;
  const int factor_;
  const std::vector<Lean> leans_;
  std::vector<uint64_t> before_;  ///< elements before each layer
};

}  // namespace

ElementModel refined(ElementModel model, int factor, MemoryBudget& budget, const Progress& progress) {
  if (factor < 1 || factor > voxel::max_upsample_factor)
    throw Error(ErrorKind::invalid_input, "upsampling factor " + std::to_string(factor) +
                                              " must be from 1 to " +
                                              std::to_string(voxel::max_upsample_factor));
  if (factor == 1) return model;
  ElementModel fine;
  fine.gray = model.gray;
  fine.spacing_mm = model.spacing_mm / factor;
  fine.origin_mm = model.origin_mm;
  fine.world_from_mesh = model.world_from_mesh;
  fine.source = model.source;
  fine.remarks = model.remarks;
  fine.gray_is_density_g_cc = model.gray_is_density_g_cc;
  const Vec3i dims = model.mask.dims() * factor;
  budget.take(VoxelMask::bytes_of(dims), "the upsampled grid");
  fine.mask = VoxelMask(dims);
  const auto n = static_cast<uint64_t>(factor);
  fine.codes = ElementCodes(model.codes.size() * n * n * n, budget);
  Splitter splitter(model, fine, factor);
  parallel_for(
      2, static_cast<size_t>(model.mask.dims().z()), [&](size_t w) { splitter.split(static_cast<int>(w)); },
      progress, "upsampling");
  budget.give_back(model.mask.bytes() + model.codes.bytes());
  return fine;
}

}  // namespace ream::fe

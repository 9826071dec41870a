#include "voxelizer/voxel_files.hpp"

#include <Eigen/Geometry>
#include <array>
#include <bit>

#include "geometry/vec.hpp"
#include "voxelizer/marked_rows.hpp"
#include "voxelizer/triangle_marking.hpp"

namespace ream::voxelizer {
namespace {

/// Share of a triangle's area that lies in the unit cube from `low`, 0 for a triangle without area. Corners
/// and cube are in voxels, where shares are what they are in mm.
double share_in_voxel(const Vec3 corners[3], const Vec3& low);

/// A triangle cut by six planes has nine corners at most.
struct Polygon {
  std::array<Vec3, 10> corners;
  size_t count = 0;
};

/// What of the polygon lies where side * (p[axis] - at) >= 0.
Polygon cut(const Polygon& polygon, int axis, double at, double side) {
  Polygon result;
  for (size_t i = 0; i < polygon.count; ++i) {
    const Vec3& p = polygon.corners[i];
    const Vec3& q = polygon.corners[i + 1 == polygon.count ? 0 : i + 1];
    const double dp = side * (p[axis] - at), dq = side * (q[axis] - at);
    if (dp >= 0.0) result.corners[result.count++] = p;
    if ((dp >= 0.0) != (dq >= 0.0)) {
      Vec3 crossing = p + dp / (dp - dq) * (q - p);
      crossing[axis] = at;
      result.corners[result.count++] = crossing;
    }
  }
  return result;
}

Vec3 twice_area(const Vec3* corners, size_t count) {
  Vec3 sum = Vec3::Zero();
  for (size_t i = 2; i < count; ++i) sum += (corners[i - 1] - corners[0]).cross(corners[i] - corners[0]);
  return sum;
}

double share_in_voxel(const Vec3 corners[3], const Vec3& low) {
  Polygon polygon;
  for (size_t i = 0; i < 3; ++i) polygon.corners[i] = corners[i];
  polygon.count = 3;
  const Vec3 whole = twice_area(corners, 3);
  const double scale = whole.squaredNorm();
  if (!(scale > 0.0)) return 0.0;
  for (int axis = 0; axis < 3 && polygon.count > 2; ++axis) {
    polygon = cut(polygon, axis, low[axis], 1.0);
    polygon = cut(polygon, axis, low[axis] + 1.0, -1.0);
  }
  return polygon.count < 3 ? 0.0 : twice_area(polygon.corners.data(), polygon.count).dot(whole) / scale;
}

/// Bits of the tiles that are worked on one by one; a voxel that the surface passes takes 32 bytes meanwhile.
constexpr size_t tile_bytes = 32 << 10;
/// Voxels that a triangle only just touches hold none of it; its normal still is theirs when nothing else is.
constexpr double min_share = 1e-12;

struct SurfacePart {
  Vec3 area_mm2 = Vec3::Zero();  ///< along the normal
  double size_mm2 = 0.0;
};

/// The surface's parts in the voxels of one tile that it passes.
class TileSurface {
 public:
  TileSurface(const RasterGrid& grid, const RowRange& range) : grid_(grid), range_(range) {
    words_.assign(grid.words_per_row() * range.rows(), 0);
    rows_ = {range, words_.data(), grid.words_per_row(), static_cast<size_t>(range.v_end - range.v_begin)};
  }

  const TileRows& rows() const { return rows_; }

  /// After rows() were marked.
  void number_voxels() {
    before_.resize(words_.size());
    size_t count = 0;
    for (size_t i = 0; i < words_.size(); ++i) {
      before_[i] = static_cast<uint32_t>(count);
      count += static_cast<size_t>(std::popcount(words_[i]));
    }
    parts_.assign(count, {});
  }

  /// Of a voxel; null where the surface is not.
  SurfacePart* part(int u, int v, int w) {
    const auto word = static_cast<size_t>(rows_.row(v, w) - words_.data()) + static_cast<size_t>(u / 32);
    const uint32_t bit = 1u << (u % 32);
    if ((words_[word] & bit) == 0) return nullptr;
    return &parts_[before_[word] + static_cast<size_t>(std::popcount(words_[word] & (bit - 1)))];
  }

  void add(const PlacedTriangle& t, const PreparedTriangle& p) {
    Vec3 corners[3];
    for (int i = 0; i < 3; ++i) corners[i] = {t.at[0][i], t.at[1][i], t.at[2][i]};
    const auto mm = [&](const Vec3& voxels) { return (voxels.array() * grid_.size_mm.array()).matrix(); };
    const Vec3 area = 0.5 * mm(corners[1] - corners[0]).cross(mm(corners[2] - corners[0]));
    const double size = area.norm();
    for_each_marked_row(t, p, [&](int v, int w, int from, int to) {
      for (int u = from; u <= to; ++u) {
        SurfacePart* part_here = part(u, v, w);
        if (part_here == nullptr) continue;
        const double share = share_in_voxel(corners, Vec3(u, v, w));
        part_here->area_mm2 += std::max(share, min_share) * area;
        part_here->size_mm2 += share * size;
      }
    });
  }

 private:
  const RasterGrid& grid_;
  const RowRange range_;
  std::vector<uint32_t> words_, before_;
  TileRows rows_;
  std::vector<SurfacePart> parts_;
};

/// What a column of voxels along the normal's main axis cuts from a plane of that normal.
double column_area_mm2(const Vec3& normal, const Vec3& size_mm) {
  int axis = 0;
  const double across = (normal.array() * size_mm.array()).abs().maxCoeff(&axis);
  return across > 0.0 ? size_mm.prod() / across : 0.0;
}

struct Writer {
  const RasterGrid& grid;
  bool by_column;
  AtomicFile& file;

  void write(const Vec3i& voxel, const SurfacePart* part) const {
    const Vec3 centre = grid.centre_mm(voxel.x(), voxel.y(), voxel.z());
    Vec3 normal = Vec3::Zero();
    double area = 0.0;
    if (part != nullptr && part->area_mm2.squaredNorm() > 0.0) normal = part->area_mm2.normalized();
    if (part != nullptr) area = by_column ? column_area_mm2(normal, grid.size_mm) : part->size_mm2;
    const std::array<double, 7> values{centre.x(), centre.y(), centre.z(), normal.x(),
                                       normal.y(), normal.z(), area};
    std::array<float, 7> floats{};
    for (size_t i = 0; i < values.size(); ++i) floats[i] = static_cast<float>(values[i]);
    file.write_value(floats);
  }
};

}  // namespace

void write_points(const TriangleMesh& mesh, const Request& request, const VoxelSet& set, AtomicFile& file,
                  const Progress& progress) {
  const RasterGrid& grid = set.grid();
  file.write("ply\nformat binary_little_endian 1.0\ncomment centres of voxels, millimetres\nelement vertex " +
             std::to_string(set.filled()) +
             "\nproperty float x\nproperty float y\nproperty float z\nproperty float nx\nproperty float ny\n"
             "property float nz\nproperty float area_mm2\nend_header\n");
  const VoxelMap map = voxel_map(grid, request.scale);
  const TilePlan plan = plan_tiles(grid, tile_bytes, 1);
  ThreadPool pool(1);
  const TileBins bins(mesh, map, plan, pool);
  const bool thin = request.surface && request.separability == Separability::six;
  const SurfaceMarker marker{mesh, map, bins, thin ? Separability::six : Separability::twenty_six};
  const Writer writer{grid, thin, file};
  std::vector<uint32_t> row(grid.words_per_row());
  for (size_t tile = 0; tile < plan.count(); ++tile) {
    progress(static_cast<double>(tile) / static_cast<double>(plan.count()), "writing points");
    const RowRange range = plan.range(tile);
    TileSurface surface(grid, range);
    marker.mark(tile, grid.dims.x(), surface.rows());
    surface.number_voxels();
    bins.for_each(tile, [&](size_t triangle) {
      PlacedTriangle placed;
      PreparedTriangle prepared;
      if (!placed.place(mesh, triangle, map, grid.dims.x(), range) || placed.low[0] > placed.high[0]) return;
      prepared.prepare(placed, thin);
      surface.add(placed, prepared);
    });
    for (int w = range.w_begin; w < range.w_end; ++w)
      for (int v = range.v_begin; v < range.v_end; ++v) {
        if (!set.read_row(v, w, row)) continue;
        for (size_t i = 0; i < row.size(); ++i)
          for (uint32_t bits = row[i]; bits != 0; bits &= bits - 1) {
            const int u = static_cast<int>(32 * i) + std::countr_zero(bits);
            writer.write({u, v, w}, surface.part(u, v, w));
          }
      }
  }
}

}  // namespace ream::voxelizer

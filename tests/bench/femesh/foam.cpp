#include "bench/femesh/foam.hpp"

#include <charconv>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <numbers>

#include "core/error.hpp"

namespace ream::bench {
namespace {

constexpr double wall_voxels = 3.0;  // thick enough to hang together by faces
constexpr double gyroid_area = 3.1;  // of one wave's cube, in waves squared
constexpr int histogram_bins = 1 << 16;
constexpr float field_limit = 1.6f;  // the gyroid's function stays below 1.5

/// Fixed-point decimals, as CT programs write them.
char* coordinate(double mm, char* at) {
  const auto result = std::to_chars(at, at + 32, mm, std::chars_format::fixed, 9);
  return result.ptr;
}

}  // namespace

const std::vector<ThesisModel>& thesis_models() {
  static const std::vector<ThesisModel> models{{"scapula",
                                                {0.472, 0.472, 1.0},
                                                {311, 284, 169},
                                                558e3,
                                                548.79,
                                                213,
                                                {17.36, 69.36, 343.33, 9.34, 0, 109.24},
                                                false},
                                               {"cancellous core",
                                                {0.032, 0.032, 0.032},
                                                {281, 372, 353},
                                                1.7e6,
                                                1979.0,
                                                359,
                                                {25.06, 196.09, 1354.80, 15.74, 0, 387.31},
                                                false},
                                               {"cellular foam",
                                                {0.032, 0.032, 0.032},
                                                {422, 629, 652},
                                                12.4e6,
                                                17945.14,
                                                3650,
                                                {189.14, 1383.37, 12888.20, 147.41, 35.41, 3301.62},
                                                true},
                                               {"glenoid",
                                                {0.064, 0.064, 0.064},
                                                {1021, 548, 742},
                                                36.2e6,
                                                55163.56,
                                                10830,
                                                {641.88, 4631.19, 37013.26, 500.39, 97.42, 12279.43},
                                                true}};
  return models;
}

Foam::Foam(const Vec3i& dims, const Vec3& spacing_mm, double voxels) : dims_(dims), spacing_mm_(spacing_mm) {
  const double fill = voxels / dims.cast<double>().prod(), wave_voxels = gyroid_area * wall_voxels / fill;
  for (int k = 0; k < 3; ++k)
    for (int i = 0; i < dims[k]; ++i) {
      const double angle = 2.0 * std::numbers::pi * (i + 0.5) / wave_voxels;
      sin_[k].push_back(static_cast<float>(std::sin(angle)));
      cos_[k].push_back(static_cast<float>(std::cos(angle)));
    }
  std::vector<uint64_t> histogram(histogram_bins);
  for (int w = 0; w < dims.z(); ++w)
    for (int v = 0; v < dims.y(); ++v)
      for (int u = 0; u < dims.x(); ++u)
        ++histogram[static_cast<size_t>(std::abs(field(u, v, w)) / field_limit * histogram_bins)];
  size_t bin = 0;
  while (bin < histogram.size() && static_cast<double>(voxels_) < voxels) voxels_ += histogram[bin++];
  wall_ = static_cast<float>(bin) * field_limit / histogram_bins;
  uint64_t counted = 0;
  each([&](int, int, int, uint16_t) { ++counted; });
  voxels_ = counted;
}

float Foam::field(int u, int v, int w) const {
  const auto x = static_cast<size_t>(u), y = static_cast<size_t>(v), z = static_cast<size_t>(w);
  return sin_[0][x] * cos_[1][y] + sin_[1][y] * cos_[2][z] + sin_[2][z] * cos_[0][x];
}

uint16_t Foam::gray(int u, int v, int w) const {
  if (!(std::abs(field(u, v, w)) < wall_)) return 0;
  const auto x = static_cast<size_t>(u), y = static_cast<size_t>(v), z = static_cast<size_t>(w);
  return static_cast<uint16_t>(900.0f + 600.0f * cos_[0][x] * cos_[1][y] * cos_[2][z]);
}

std::vector<VoxelRow> Foam::rows() const {
  std::vector<VoxelRow> rows;
  rows.reserve(voxels_);
  each([&](int u, int v, int w, uint16_t g) {
    const Vec3 c = ((Vec3(u, v, w).array() + 0.5) * spacing_mm_.array()).matrix();
    rows.push_back({{static_cast<float>(c.x()), static_cast<float>(c.y()), static_cast<float>(c.z())},
                    static_cast<float>(g)});
  });
  return rows;
}

void Foam::write_rows(const std::filesystem::path& path) const {
  std::ofstream out(path, std::ios::binary);
  std::string text;
  each([&](int u, int v, int w, uint16_t g) {
    char line[160];
    char* at = line;
    const int voxel[3] = {u, v, w};
    for (int k = 0; k < 3; ++k) {
      at = coordinate((voxel[k] + 0.5) * spacing_mm_[k] + 100.0, at);
      *at++ = ' ';
    }
    at = std::to_chars(at, line + sizeof line, g).ptr;
    *at++ = '\n';
    text.append(line, at);
    if (text.size() < (1 << 22)) return;
    out << text;
    text.clear();
  });
  out << text;
  if (!out.flush()) throw Error(ErrorKind::io, "cannot write " + path.string());
}

void Foam::write_nrrd(const std::filesystem::path& path) const {
  std::ofstream out(path, std::ios::binary);
  const Vec3 &s = spacing_mm_, first = 0.5 * spacing_mm_;
  char head[512];
  std::snprintf(head, sizeof head,
                "NRRD0004\ntype: uint16\ndimension: 3\nspace: left-posterior-superior\nsizes: %d %d %d\n"
                "space directions: (%.9g,0,0) (0,%.9g,0) (0,0,%.9g)\nendian: little\nencoding: raw\n"
                "space origin: (%.9g,%.9g,%.9g)\n\n",
                dims_.x(), dims_.y(), dims_.z(), s.x(), s.y(), s.z(), first.x(), first.y(), first.z());
  out << head;
  std::vector<uint16_t> row(static_cast<size_t>(dims_.x()));
  for (int w = 0; w < dims_.z(); ++w)
    for (int v = 0; v < dims_.y(); ++v) {
      for (int u = 0; u < dims_.x(); ++u) row[static_cast<size_t>(u)] = gray(u, v, w);
      out.write(reinterpret_cast<const char*>(row.data()), static_cast<std::streamsize>(2 * row.size()));
    }
  if (!out.flush()) throw Error(ErrorKind::io, "cannot write " + path.string());
}

}  // namespace ream::bench

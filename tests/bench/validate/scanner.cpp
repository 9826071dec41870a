#include "bench/validate/scanner.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <string>

#include "bench/validate/normal_noise.hpp"
#include "bench/validate/parallel.hpp"
#include "core/error.hpp"

namespace ream::bench {
namespace {

constexpr double finest_mm = 0.2;
constexpr double blur_reach = 3.5;  // standard deviations

/// A finer grid than the CT's, whole numbers of its cells to a voxel.
struct FineGrid {
  std::array<size_t, 3> parts, dims;
  std::vector<float> hu;

  size_t stride(size_t axis) const { return axis == 0 ? 1 : axis == 1 ? dims[0] : dims[0] * dims[1]; }
};

std::vector<double> gaussian(double deviation_cells) {
  const int reach = static_cast<int>(std::ceil(blur_reach * deviation_cells));
  std::vector<double> weights;
  double sum = 0.0;
  for (int i = -reach; i <= reach; ++i) {
    weights.push_back(std::exp(-0.5 * i * i / (deviation_cells * deviation_cells)));
    sum += weights.back();
  }
  for (double& weight : weights) weight /= sum;
  return weights;
}

/// Along one axis; beyond the border lies what lies on it.
void blur_along(FineGrid& fine, size_t axis, const std::vector<double>& weights) {
  const size_t length = fine.dims[axis], stride = fine.stride(axis), inner = stride, both = stride * length;
  const auto reach = static_cast<std::ptrdiff_t>(weights.size() / 2);
  in_parallel(fine.hu.size() / both, [&](size_t block) {
    std::vector<float> line(length);
    for (size_t i = 0; i < inner; ++i) {
      float* first = fine.hu.data() + block * both + i;
      for (size_t k = 0; k < length; ++k) line[k] = first[k * stride];
      for (size_t k = 0; k < length; ++k) {
        double sum = 0.0;
        for (size_t j = 0; j < weights.size(); ++j) {
          const auto at = static_cast<std::ptrdiff_t>(k + j) - reach;
          sum += weights[j] * line[static_cast<size_t>(std::clamp<std::ptrdiff_t>(
                                  at, 0, static_cast<std::ptrdiff_t>(length) - 1))];
        }
        first[k * stride] = static_cast<float>(sum);
      }
    }
  });
}

double mean_of_voxel(const FineGrid& fine, const std::array<size_t, 3>& voxel) {
  double sum = 0.0;
  for (size_t w = 0; w < fine.parts[2]; ++w)
    for (size_t v = 0; v < fine.parts[1]; ++v)
      for (size_t u = 0; u < fine.parts[0]; ++u)
        sum += fine.hu[voxel[0] * fine.parts[0] + u + (voxel[1] * fine.parts[1] + v) * fine.stride(1) +
                       (voxel[2] * fine.parts[2] + w) * fine.stride(2)];
  return sum / static_cast<double>(fine.parts[0] * fine.parts[1] * fine.parts[2]);
}

}  // namespace

Scan take_scan(const std::function<double(const Vec3&)>& true_hu, const Aabb& field_mm,
               const ScanProtocol& protocol, uint64_t seed) {
  Scan scan;
  scan.spacing_mm = {protocol.pixel_mm, protocol.pixel_mm, protocol.slice_mm};
  scan.corner_mm = field_mm.min;
  const Vec3 size = field_mm.max - field_mm.min;
  FineGrid fine;
  Vec3 step_mm;
  for (int axis = 0; axis < 3; ++axis) {
    const auto a = static_cast<size_t>(axis);
    scan.dims[axis] = static_cast<int>(std::ceil(size[axis] / scan.spacing_mm[axis]));
    fine.parts[a] = static_cast<size_t>(std::ceil(scan.spacing_mm[axis] / finest_mm - 1e-9));
    fine.dims[a] = fine.parts[a] * static_cast<size_t>(scan.dims[axis]);
    step_mm[axis] = scan.spacing_mm[axis] / static_cast<double>(fine.parts[a]);
  }
  fine.hu.resize(fine.dims[0] * fine.dims[1] * fine.dims[2]);
  in_parallel(fine.dims[2], [&](size_t w) {
    float* out = fine.hu.data() + w * fine.stride(2);
    for (size_t v = 0; v < fine.dims[1]; ++v)
      for (size_t u = 0; u < fine.dims[0]; ++u) {
        const Vec3 cell(static_cast<double>(u) + 0.5, static_cast<double>(v) + 0.5,
                        static_cast<double>(w) + 0.5);
        *out++ = static_cast<float>(true_hu(scan.corner_mm + cell.cwiseProduct(step_mm)));
      }
  });
  if (protocol.blur_mm > 0.0)
    for (size_t axis = 0; axis < 3; ++axis)
      blur_along(fine, axis, gaussian(protocol.blur_mm / step_mm[static_cast<int>(axis)]));
  NormalNoise noise(seed);
  for (size_t w = 0; w < static_cast<size_t>(scan.dims.z()); ++w)
    for (size_t v = 0; v < static_cast<size_t>(scan.dims.y()); ++v)
      for (size_t u = 0; u < static_cast<size_t>(scan.dims.x()); ++u) {
        const double hu = mean_of_voxel(fine, {u, v, w}) + protocol.noise_hu * noise.normal();
        scan.hu.push_back(static_cast<int16_t>(std::clamp(std::round(hu), -1024.0, 3071.0)));
      }
  return scan;
}

void write_nrrd(const Scan& scan, const std::filesystem::path& path) {
  const Vec3 &d = scan.spacing_mm, first = scan.corner_mm + 0.5 * d;  // of a NRRD: the first voxel's centre
  const auto text = [](double number) { return std::to_string(number); };
  std::ofstream file(path, std::ios::binary);
  file << "NRRD0004\ntype: int16\ndimension: 3\nspace: left-posterior-superior\nsizes: " << scan.dims.x()
       << ' ' << scan.dims.y() << ' ' << scan.dims.z() << "\nspace directions: (" << text(d.x())
       << ",0,0) (0," << text(d.y()) << ",0) (0,0," << text(d.z()) << ")\nspace origin: (" << text(first.x())
       << ',' << text(first.y()) << ',' << text(first.z())
       << ")\nkinds: domain domain domain\nendian: little\nencoding: raw\n\n";
  for (const int16_t hu : scan.hu) {
    const auto bits = static_cast<uint16_t>(hu);
    file.put(static_cast<char>(bits & 0xff));
    file.put(static_cast<char>(bits >> 8));
  }
  file.close();
  if (!file) throw Error(ErrorKind::io, "cannot write " + path.string());
}

}  // namespace ream::bench

#include "score/depth_gauge.hpp"

#include <algorithm>
#include <unordered_map>

namespace ream::score {
namespace {

constexpr int stride = 4;              // rays between those that are looked at first
constexpr size_t deepest_places = 12;  // around so many of them all rays are looked at
constexpr double near_deepest_mm =
    0.1;  // rays that are this much less deep may have a deeper one beside them

/// Whether a ray and all four beside it meet what is left of the face, more than a voxel of it: along the
/// edge that a cut leaves where it comes out through the wall, the surface is rounded off, and of a wedge
/// thinner than a voxel the coverage tells nothing.
template <typename SurfaceOf>
bool is_over_bone(const NativeGlenoid& native, size_t ray, double voxel_mm, SurfaceOf surface_of) {
  const auto meets = [&](int beside) {
    if (beside < 0) return false;
    const auto i = static_cast<size_t>(beside);
    return native.face()[i] && surface_of(i) + voxel_mm < native.exit_mm()[i];
  };
  const RayLattice& rays = native.rays();
  return meets(static_cast<int>(ray)) && meets(rays.neighbour(ray, 1, 0)) &&
         meets(rays.neighbour(ray, -1, 0)) && meets(rays.neighbour(ray, 0, 1)) &&
         meets(rays.neighbour(ray, 0, -1));
}

/// Rays of one bone, each looked at once.
class RayProbe {
 public:
  RayProbe(const NativeGlenoid& native, const CoverageView& left) : native_(native), finder_(left) {}

  /// Whether bone is left where a ray would be that deep: then it is not.
  bool has_bone_at(size_t ray, double depth_mm) const {
    return finder_.coverage_at(native_.rays().world(ray, native_.surface_mm()[ray] + depth_mm)) > 127.5;
  }
  const AchievedRay& at(size_t ray) {
    const auto known = known_.find(ray);
    return known != known_.end() ? known->second
                                 : known_.emplace(ray, achieved_ray(native_, finder_, ray)).first->second;
  }

 private:
  const NativeGlenoid& native_;
  const SurfaceFinder finder_;
  std::unordered_map<size_t, AchievedRay> known_;
};

}  // namespace

GreatestDepth greatest_depth(const NativeGlenoid& native, const AchievedFace& face) {
  GreatestDepth over_bone, anywhere;
  const auto surface_of = [&](size_t ray) { return face.surface_mm[ray]; };
  for (size_t ray = 0; ray < native.rays().size(); ++ray) {
    const double removed = face.removed_mm[ray];
    if (removed < reamed_mm) continue;
    const double past = native.surface_mm()[ray] + removed - native.subchondral_mm()[ray];
    const auto take = [&](GreatestDepth& greatest) {
      greatest.removed_mm = std::max(greatest.removed_mm, removed);
      greatest.past_subchondral_mm = std::max(greatest.past_subchondral_mm, past);
    };
    take(anywhere);
    if (is_over_bone(native, ray, face.voxel_mm, surface_of)) take(over_bone);
  }
  return over_bone.removed_mm > 0.0 ? over_bone : anywhere;
}

DepthGauge::DepthGauge(std::shared_ptr<const NativeGlenoid> native) : native_(std::move(native)) {
  native_->rays().thinned(stride, coarse_);
  std::erase_if(coarse_, [this](size_t ray) { return !native_->face()[ray]; });
}

double DepthGauge::measure(const CoverageView& left) {
  if (coarse_.empty()) return 0.0;
  RayProbe probe(*native_, left);
  const double voxel_mm = left.grid.spacing_mm.maxCoeff();
  const auto surface_of = [&](size_t ray) { return probe.at(ray).surface_mm; };
  std::vector<size_t> reamed;
  double deepest_mm = 0.0;
  const auto take = [&](size_t ray) {
    if (probe.has_bone_at(ray, std::max(reamed_mm, deepest_mm - near_deepest_mm))) return;
    const double removed_mm = probe.at(ray).removed_mm;
    if (removed_mm < reamed_mm) return;
    reamed.push_back(ray);
    if (removed_mm <= deepest_mm || !is_over_bone(*native_, ray, voxel_mm, surface_of)) return;
    deepest_mm = removed_mm;
    deepest_ = ray;
  };
  const size_t first =
      std::find(coarse_.begin(), coarse_.end(), deepest_) == coarse_.end() ? coarse_[0] : deepest_;
  take(first);
  for (const size_t ray : coarse_)
    if (ray != first) take(ray);
  const auto deeper = [&](size_t a, size_t b) { return probe.at(a).removed_mm > probe.at(b).removed_mm; };
  const size_t places = std::min(deepest_places, reamed.size());
  std::partial_sort(reamed.begin(), reamed.begin() + static_cast<std::ptrdiff_t>(places), reamed.end(),
                    deeper);
  double over_bone = 0.0, anywhere = 0.0;
  const auto look = [&](size_t ray) {
    if (!native_->face()[ray] || probe.at(ray).removed_mm < reamed_mm) return;
    anywhere = std::max(anywhere, probe.at(ray).removed_mm);
    if (probe.at(ray).removed_mm > over_bone && is_over_bone(*native_, ray, voxel_mm, surface_of))
      over_bone = probe.at(ray).removed_mm;
  };
  for (size_t place = 0; place < reamed.size(); ++place) {
    look(reamed[place]);
    for (int i = 0; place < places && i < (2 * stride - 1) * (2 * stride - 1); ++i) {
      const int across = i % (2 * stride - 1) - stride + 1, up = i / (2 * stride - 1) - stride + 1;
      if (const int ray = native_->rays().neighbour(reamed[place], across, up); ray >= 0)
        look(static_cast<size_t>(ray));
    }
  }
  return over_bone > 0.0 ? over_bone : anywhere;
}

}  // namespace ream::score

#pragma once
#include <functional>
#include <random>
#include <string>

#include "core/file.hpp"
#include "fe/element_model.hpp"
#include "fe/make_mesh.hpp"
#include "support/temporary_folder.hpp"

namespace ream::fe::test {

/// A model of the voxels whose gray value is not negative.
inline ElementModel model_of(const Vec3i& dims, const std::function<int(int, int, int)>& gray,
                             double spacing_mm = 0.5, MemoryBudget budget = {}) {
  ElementModel model;
  model.spacing_mm = Vec3::Constant(spacing_mm);
  const auto read = [&](int w, std::span<int32_t> codes) {
    size_t i = 0;
    for (int v = 0; v < dims.y(); ++v)
      for (int u = 0; u < dims.x(); ++u) codes[i++] = gray(u, v, w);
  };
  fill_from_layers(model, dims, read, budget);
  return model;
}

/// Gray value of every voxel of a random volume; -1 where it is empty.
class RandomGray {
 public:
  RandomGray(const Vec3i& dims, double fill, uint64_t seed) : dims_(dims) {
    std::mt19937_64 random(seed);
    for (int i = 0; i < dims.prod(); ++i) {
      const bool filled = static_cast<double>(random() % 1000) < 1000.0 * fill;
      gray_.push_back(filled ? static_cast<int>(100 + random() % 50) : -1);
    }
  }
  int operator()(int u, int v, int w) const {
    const bool inside = u >= 0 && v >= 0 && w >= 0 && u < dims_.x() && v < dims_.y() && w < dims_.z();
    return inside ? gray_[static_cast<size_t>(u + dims_.x() * (v + dims_.y() * w))] : -1;
  }

 private:
  Vec3i dims_;
  std::vector<int> gray_;
};

/// The text of the mesh of a model; everything is kept unless the options say otherwise.
inline std::string inp_of(ElementModel model, MeshOptions options = {}, MemoryBudget budget = {},
                          MeshReport* report = nullptr) {
  const ream::test::TemporaryFolder folder;
  options.check = true;
  const MeshReport made = make_mesh(std::move(model), options, budget, folder.path() / "mesh.inp");
  if (report != nullptr) *report = made;
  return read_text_file(folder.path() / "mesh.inp");
}

}  // namespace ream::fe::test

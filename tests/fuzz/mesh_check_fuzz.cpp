// Files of finite elements (.inp, .vtu) that are checked.
#include "core/error.hpp"
#include "core/memory_budget.hpp"
#include "fe/mesh_check.hpp"
#include "fuzz_file.hpp"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace ream;
  fuzz::Input input(data, size);
  const bool vtu = input.byte() % 2 != 0;
  const auto path = fuzz::folder().write(vtu ? "a.vtu" : "a.inp", input.rest());
  const auto budget = MemoryBudget::with_left(64 << 20, fuzz::folder().path());
  try {
    uint64_t elements = 0;
    const fe::MeshFacts facts =
        fe::check_mesh_file(path, vtu ? fe::MeshFormat::vtu : fe::MeshFormat::inp, budget, no_progress,
                            [&](const fe::HexCorners&) { ++elements; });
    fuzz::require(facts.elements == elements, "elements were counted that were not seen");
    fuzz::require(elements == 0 || facts.min_jacobian_mm3 > 0.0,
                  "a mesh that is turned inside out was taken");
  } catch (const Error&) {
  }
  return 0;
}

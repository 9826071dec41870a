#pragma once
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "fe/element_model.hpp"
#include "voxel/gray_scale.hpp"

namespace ream::fe {

/// Young's modulus of a gray value g: E = a + b g^c, MPa. With c = 1 the linear mapping of thesis section
/// 2.4.
struct ModulusLaw {
  std::string name = "linear";
  double a_mpa = 0.0, b = 1.0, c = 1.0;

  double modulus_mpa(double gray) const;
  /// "linear: E = 0 + 10 g MPa".
  std::string description() const;
};

/// Linear with two numbers A,B, a power law with three A,B,C.
ModulusLaw linear_law(double a_mpa, double b);
ModulusLaw power_law(double a_mpa, double b, double c);

/// A law that was published under a name, and what its gray value is.
struct NamedLaw {
  ModulusLaw law;
  bool of_density = true;  ///< of apparent density, g/cc; else of 8-bit gray
  const char* source = "";
};
std::span<const NamedLaw> named_laws();
/// Error usage names all that there are.
const NamedLaw& law_of_name(const std::string& name);
/// For bone whose density is known.
const NamedLaw& default_density_law();

inline constexpr size_t code_count = 65536;
using CodeHistogram = std::vector<uint64_t>;  ///< elements of each gray code, code_count entries

/// What stands for all moduli of a bin.
enum class BinValue { centre, mean };

struct MaterialRule {
  ModulusLaw law;
  double poisson = 0.3;
  /// Moduli in [k, k + 1) * width become one material; without it each different modulus is one.
  std::optional<double> bin_width_mpa = {};
  BinValue bin_value = BinValue::centre;
};

struct Material {
  double modulus_mpa = 0.0;
  uint64_t elements = 0;
};

/// The materials that elements have, by rising modulus, and which one a gray code has.
struct Materials {
  std::vector<Material> list;
  std::vector<uint32_t> of_code;  ///< code_count entries; those that no element has are 0
};

/// On two threads.
CodeHistogram histogram_of(const ElementCodes& codes);
/// Throws Error invalid_input when an element's modulus is not a positive number, naming its gray value;
/// usage for a Poisson's ratio outside ]-1, 0.5[ or a bin width that is not positive.
Materials make_materials(const CodeHistogram& histogram, const voxel::GrayScale& gray,
                         const MaterialRule& rule);

/// Ids of the elements of some materials, rising for each.
struct SetsPart {
  size_t first_material = 0, end_material = 0;
  std::vector<uint32_t> ids;
  std::vector<uint64_t> begins;  ///< in ids, of each material, and the end

  std::span<const uint32_t> ids_of(size_t material) const {
    const size_t i = material - first_material;
    return std::span(ids).subspan(begins[i], begins[i + 1] - begins[i]);
  }
};

/// Groups the elements by material, counting, for as many materials at a time as the budget has room for.
/// Calls use for each part, by rising material.
void for_each_part_of_sets(const ElementCodes& codes, const Materials& materials, MemoryBudget& budget,
                           const std::function<void(const SetsPart&)>& use);

}  // namespace ream::fe

#pragma once
#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "fe/element_codes.hpp"
#include "fe/modulus_law.hpp"
#include "voxel/gray_scale.hpp"

namespace ream::fe {

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

}  // namespace ream::fe

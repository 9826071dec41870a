#pragma once
#include <span>
#include <string>

namespace ream::fe {

/// Young's modulus of a gray value g: E = a + b g^c, MPa. With c = 1 the linear mapping of thesis section
/// 2.4.
struct ModulusLaw {
  std::string name = "linear";
  double a_mpa = 0.0, b = 1.0, c = 1.0;

  double modulus_mpa(double gray) const;
  /// "linear: E = 0 + 10 g MPa".
  std::string words() const;
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

}  // namespace ream::fe

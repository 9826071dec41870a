#include "fe/modulus_law.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/error.hpp"
#include "fe/number_text.hpp"

namespace ream::fe {

double ModulusLaw::modulus_mpa(double gray) const {
  return a_mpa + b * (c == 1.0 ? gray : std::pow(gray, c));
}

std::string ModulusLaw::words() const {
  return name + ": E = " + real_text(a_mpa) + " + " + real_text(b) + " g" +
         (c == 1.0 ? "" : "^" + real_text(c)) + " MPa";
}

ModulusLaw linear_law(double a_mpa, double b) { return {"linear", a_mpa, b, 1.0}; }
ModulusLaw power_law(double a_mpa, double b, double c) { return {"power", a_mpa, b, c}; }

std::span<const NamedLaw> named_laws() {
  static const std::array<NamedLaw, 4> laws{{
      {{"morgan-2003", 0.0, 8920.0, 1.83}, true, "Morgan, Bayraktar, Keaveny 2003, sites pooled"},
      {{"morgan-2003-femoral-neck", 0.0, 6850.0, 1.49}, true, "Morgan, Bayraktar, Keaveny 2003"},
      {{"buechler-2002", 0.0, 15000.0 / (1.8 * 1.8), 2.0},
       true,
       "Buechler et al. 2002, scapula: 15 GPa (rho / 1.8)^2"},
      {{"ciclope", 0.0, 18000.0 / std::pow(250.0, 2.5), 2.5},
       false,
       "ciclope's example for 8-bit micro-CT: 18 GPa (g / 250)^2.5"},
  }};
  return laws;
}

const NamedLaw& law_of_name(const std::string& name) {
  const auto laws = named_laws();
  const auto found =
      std::find_if(laws.begin(), laws.end(), [&](const NamedLaw& l) { return l.law.name == name; });
  if (found != laws.end()) return *found;
  std::string names;
  for (const NamedLaw& law : laws) names += (names.empty() ? "" : ", ") + law.law.name;
  throw Error(ErrorKind::usage, "--law '" + name + "' is none of " + names);
}

const NamedLaw& default_density_law() { return named_laws()[0]; }

}  // namespace ream::fe

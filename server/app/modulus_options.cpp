#include "app/modulus_options.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>

#include "app/numbers.hpp"
#include "core/error.hpp"

namespace ream::app {
namespace {

fe::ModulusLaw given_law(const std::string& modulus) {
  const auto commas = std::count(modulus.begin(), modulus.end(), ',');
  const auto n = parse_numbers(modulus, commas == 2 ? 3 : 2, "--modulus");
  return n.size() == 3 ? fe::power_law(n[0], n[1], n[2]) : fe::linear_law(n[0], n[1]);
}

std::string names_of_laws() {
  std::string names;
  for (const fe::NamedLaw& named : fe::named_laws())
    names += (names.empty() ? "" : "; ") + named.law.description();
  return names;
}

}  // namespace

void ModulusOptions::add_to(CLI::App& command) {
  command.add_option("--modulus", modulus, "A,B: E = A + B g; A,B,C: E = A + B g^C, MPa, of gray value g");
  command.add_option("--law", law, "A law by its name: " + names_of_laws());
}

fe::ModulusLaw ModulusOptions::law_for(fe::ElementModel& model) const {
  if (!modulus.empty() && !law.empty())
    throw Error(ErrorKind::usage, "--modulus and --law exclude each other");
  if (!modulus.empty()) return given_law(modulus);
  if (!law.empty()) {
    const fe::NamedLaw& named = fe::law_of_name(law);
    if (named.of_density && !model.gray_is_density_g_cc)
      model.remarks.push_back("law " + named.law.name +
                              " is of apparent density in g/cc; gray values were taken as such");
    return named.law;
  }
  if (model.gray_is_density_g_cc) return fe::default_density_law().law;
  model.remarks.push_back("no --modulus was given, so gray values were taken as moduli in MPa");
  return fe::linear_law(0.0, 1.0);
}

}  // namespace ream::app

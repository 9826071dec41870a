#pragma once
#include <string>

#include "fe/materials.hpp"

namespace CLI {
class App;
}

namespace ream::app {

/// How commands are told what modulus a voxel has: --modulus and --law.
struct ModulusOptions {
  std::string modulus, law;

  /// `this` must live as long as the command.
  void add_to(CLI::App& command);
  /// What was asked for, else Morgan's law for densities; gray values of an unknown scale are taken as MPa.
  /// Adds to the model's remarks what was taken for granted. Error usage.
  fe::ModulusLaw law_for(fe::ElementModel& model) const;
};

}  // namespace ream::app

#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "app/server_address.hpp"

namespace ream::app {

/// What a server on this machine would need.
struct DoctorRequest {
  std::filesystem::path data;  ///< of data_folder()
  std::string db;              ///< as for open_database()
  std::filesystem::path web;   ///< as for page_folder()
  ServerAddress address;
};

/// One thing that was looked at.
struct Finding {
  enum class State {
    good,
    remark,  ///< it works, but not as well as it could
    fault    ///< the server cannot start or work so
  };
  std::string subject;  ///< one or two words
  State state = State::good;
  std::string text;    ///< one sentence
  std::string remedy;  ///< what to do; empty for what is good, and where the text says it
};

/// Looks at everything that a server needs on this machine, as the user who calls. Takes about a second, for
/// the timer. Changes nothing in data folder and database. Throws nothing of its own.
std::vector<Finding> examine_machine(const DoctorRequest& request);

}  // namespace ream::app

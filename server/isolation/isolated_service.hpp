#pragma once
#include <filesystem>
#include <functional>
#include <map>
#include <nlohmann/json.hpp>
#include <span>
#include <string>

#include "core/progress.hpp"

namespace ream::isolation {

/// Works on `input` (a path inside the sandbox) and writes into the working folder. Returns the answer.
using IsolatedTask = std::function<nlohmann::json(const std::filesystem::path& input,
                                                  const nlohmann::json& options, const Progress& progress)>;

/// The other side of run_isolated(): takes one job from the descriptors that it was started with, enters
/// the sandbox, does it, answers, and ends the process. Exit code 2 when it was not started by that function.
[[noreturn]] void serve_one_job(const std::map<std::string, IsolatedTask>& tasks);

/// Writes a file into the output folder, for IsolatedResult::values. Throws Error io.
void write_values(const std::string& name, std::span<const std::byte> values);

/// Descriptors that the process is started with.
enum IsolatedDescriptor : int {
  input_descriptor = 3,
  output_descriptor,
  request_descriptor,
  answer_descriptor
};

}  // namespace ream::isolation

#pragma once
#include <filesystem>
#include <functional>
#include <iosfwd>
#include <string>
#include <vector>

namespace ream::bench {

/// Which side of its goal a figure must be on.
enum class Goal { at_most, at_least };

/// One measured figure.
struct Row {
  std::string suite, name;
  double ours = 0.0;
  double baseline = 0.0;  ///< 0: none
  std::string unit;
  double goal = 0.0;  ///< 0: none
  Goal goal_is = Goal::at_most;
};

struct Options {
  bool baselines = false;
  std::filesystem::path plots = "ream-validate";  ///< folder for the pictures of the suite `validate`
  std::ostream* tables = nullptr;  ///< where a suite prints tables for people as it measures; null: nowhere
};

/// From a CT to a bone in memory.
std::vector<Row> case_suite(const Options& options);
std::vector<Row> collide_suite(const Options& options);
/// Whether files that wish a server ill get at the haptic loop, at memory, or at other files.
std::vector<Row> hostile_suite(const Options& options);
/// Whether the haptic loop is on time in a served session.
std::vector<Row> loop_suite(const Options& options);
/// The package for Python beside the program.
std::vector<Row> python_suite(const Options& options);
/// What recording costs, and how soon any moment of a recording opens.
std::vector<Row> record_suite(const Options& options);
/// Whether requests disturb the haptic loop of a served session.
std::vector<Row> rest_suite(const Options& options);
/// What scores cost, while a session goes on, when it has ended, and of many sessions anew.
std::vector<Row> score_suite(const Options& options);
/// What it takes to solve bone of millions of voxels.
std::vector<Row> solve_suite(const Options& options);
/// How soon many sessions are listed and filtered, on both kinds of database.
std::vector<Row> store_suite(const Options& options);
std::vector<Row> surface_suite(const Options& options);
/// Whether what is felt and said is what happens to the bone, by formulas that share nothing with the
/// product.
std::vector<Row> truth_suite(const Options& options);
/// Force against the thesis' chapter 5.
std::vector<Row> validate_suite(const Options& options);
/// What the page is like to those who watch and steer, in a real browser.
std::vector<Row> web_suite(const Options& options);
/// Surface and solid voxelization of the meshes of the thesis' chapter 3.
std::vector<Row> voxelize_suite(const Options& options);

}  // namespace ream::bench
